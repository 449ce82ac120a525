// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Criterion for a settled motion of the bit.
#pragma once

namespace tooljoint::cases {

/// Summary key: the range of the speed of the bit about the rotary speed in the second half of the
/// window, divided by that in the first half.
inline constexpr const char* bitSpeedGrowthKey = "transient.figures.bit_speed_growth";

/// A vibration with this growth or more has not settled; settled motions, including chaotic ones,
/// stay below 2.
inline constexpr double unsettledGrowth = 5.0;

}  // namespace tooljoint::cases
