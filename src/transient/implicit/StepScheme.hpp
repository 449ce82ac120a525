// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

namespace tooljoint::transient {

/// Derivatives of a scheme's velocity and acceleration with respect to its
/// displacement over a step of length h.
struct StepScheme {
  double h = 0;
  double velocity = 0;      ///< cv
  double acceleration = 0;  ///< ca
  double filter = 0;        ///< s of the phase correction
  double phase = 0;         ///< k of the phase correction, 0 for none
  double impact = 1;        ///< factor of the forces of impacts (PointImpacts)

  /// Append / restore.
  void save(std::vector<double>& memory) const {
    memory.insert(memory.end(), {h, velocity, acceleration, filter, phase, impact});
  }
  void restore(const double*& memory) {
    for (double* value : {&h, &velocity, &acceleration, &filter, &phase, &impact})
      *value = *memory++;
  }
};

}  // namespace tooljoint::transient
