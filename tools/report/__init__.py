# SPDX-License-Identifier: BSD-3-Clause
"""`tooljoint report`: one HTML file with the results of a run, a study, a map, or of torque-drag,
bha, buckling, campbell, response or modes."""
