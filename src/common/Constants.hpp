// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Mathematical and physical constants, SI units.
#pragma once

#include <limits>

namespace tooljoint::constants {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double twoPi = 2.0 * pi;
inline constexpr double degree = pi / 180.0;                ///< [rad]
inline constexpr double rpm = twoPi / 60.0;                 ///< revolution per minute [rad/s]
inline constexpr double rpmPerRadianPerSecond = 30.0 / pi;  ///< rad/s -> rpm
inline constexpr double standardGravity = 9.80665;          ///< [m/s2], exact (ISO 80000-3)
inline constexpr double epsilon = std::numeric_limits<double>::epsilon();  ///< rounding of a double

}  // namespace tooljoint::constants
