# SPDX-License-Identifier: BSD-3-Clause
"""Results of a run as files of ParaView: polydata (.vtp) and their times (.pvd)."""
