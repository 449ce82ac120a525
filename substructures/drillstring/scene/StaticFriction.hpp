// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Direction and coefficient of the friction in the static state.
#pragma once

#include <string>

#include "substructures/contact/StaticContact.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// Friction of the static state according to Static/Friction and the speeds of drive and block.
struct StaticFriction {
  double direction = 0.0;       ///< sense of the rotation: +1, -1, or 0 without it
  double speed = 0.0;           ///< |Omega| that determines the coefficient [rad/s]; 0: the peak
                                ///< mu_s
  std::string why;              ///< for the log
  contact::Sliding sliding{};   ///< sliding velocity it acts against; none: no friction
  bool ofSlidingSpeed = false;  ///< coefficient at the speed of `sliding`, otherwise the peak
};
StaticFriction staticFriction(const Scene& scene);

}  // namespace tooljoint::drillstring
