// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cmath>

namespace tooljoint::transient {

/// s (i + frac(g j)), g the golden ratio: steps about a stride s apart, so that no vibration is
/// always sampled in the same phase.
inline long spreadStep(long stride, double i, double j) {
  constexpr double golden = 0.6180339887498949;
  const double spread = golden * j;
  return static_cast<long>(static_cast<double>(stride) * (i + spread - std::floor(spread)));
}

}  // namespace tooljoint::transient
