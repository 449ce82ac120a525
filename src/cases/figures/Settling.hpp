// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// When the motion of a bit has settled.
#pragma once

namespace tooljoint::cases {

/// Summary key: the range of the speed of the bit about the rotary speed in the second half of the
/// window of the figures, over that in the first.
inline constexpr const char* bitSpeedGrowthKey = "transient.figures.bit_speed_growth";

/// From this growth on a vibration has not settled; settled motions, chaotic ones too, stay
/// below 2.
inline constexpr double unsettledGrowth = 5.0;

}  // namespace tooljoint::cases
