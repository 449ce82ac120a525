// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a scheme that damps vibration says of it: StepError asks integrators with this
/// interface.
#pragma once

#include <string>

namespace tooljoint::transient {

struct State;

class NumericalDamping {
 public:
  virtual ~NumericalDamping() = default;
  /// Energy [J] that the scheme itself has taken in the step just accepted, beside the work of all
  /// forces.
  virtual double dissipated(const State& from, const State& to) const = 0;
  /// What to change for less of it; whole sentences.
  virtual std::string dampingAdvice() const = 0;
};

}  // namespace tooljoint::transient
