# SPDX-License-Identifier: BSD-3-Clause
"""Converts results of a run to files of ParaView: polydata (.vtp) and their times (.pvd)."""
