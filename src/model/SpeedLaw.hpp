// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Scalar laws of time that depend on the rotary speed.
#pragma once

#include <complex>
#include <functional>
#include <limits>

#include "model/ScalarLaw.hpp"

namespace tooljoint::model {

/// Value of a ScalarLaw that depends on the rotary speed Omega(t), used like a plain function of
/// time: analyses at a constant speed need no history.
struct SpeedLaw {
  std::function<double(double)> inTime;  ///< value at time t [s]
  /// At a constant speed [rad/s] the law is Re(steady(Omega) exp(i order Omega t)).
  std::function<std::complex<double>(double)> steady;
  int order = 0;  ///< 0: constant (steady() is real); 1: turns with the string (a mass unbalance)
  /// Range of speeds for which it is defined [rad/s]: beyond it a table has its last value.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  double operator()(double t) const { return inTime(t); }
};

/// Null for a law that does not depend on the rotary speed.
inline const SpeedLaw* speedLaw(const ScalarLaw& law) { return law.value.target<SpeedLaw>(); }

}  // namespace tooljoint::model
