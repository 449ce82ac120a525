# SPDX-License-Identifier: BSD-3-Clause
"""`tooljoint report`: one HTML file with the results of a run, a study, torque-drag, bha, buckling
or modes."""
