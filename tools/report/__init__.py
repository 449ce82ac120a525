# SPDX-License-Identifier: BSD-3-Clause
"""`tooljoint report`: one HTML file of what a run, a study, torque-drag, bha, buckling or modes
left in a folder."""
