// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Scalar laws of time that follow the rotary speed.
#pragma once

#include <complex>
#include <functional>
#include <limits>

#include "model/ScalarLaw.hpp"

namespace tooljoint::model {

/// The value of a ScalarLaw that follows the rotary speed Omega(t), in the place of a plain
/// function of time: analyses at a constant speed need no history.
struct SpeedLaw {
  std::function<double(double)> inTime;  ///< value at time t [s]
  /// At a constant speed [rad/s] the law is Re(steady(Omega) exp(i order Omega t)).
  std::function<std::complex<double>(double)> steady;
  int order = 0;  ///< 0: constant (steady() is real); 1: turns with the string (a mass unbalance)
  /// Speeds it is given for [rad/s]: a table has its last value beyond.
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();

  double operator()(double t) const { return inTime(t); }
};

/// Null for a law that does not follow the rotary speed.
inline const SpeedLaw* speedLaw(const ScalarLaw& law) { return law.value.target<SpeedLaw>(); }

}  // namespace tooljoint::model
