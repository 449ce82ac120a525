// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the friction of the static state acts against, and with which coefficient.
#pragma once

#include <string>

#include "substructures/contact/StaticContact.hpp"
#include "substructures/drillstring/scene/Scene.hpp"

namespace tooljoint::drillstring {

/// Friction of the static state, as Static/Friction and the speeds of drive and block decide it.
struct StaticFriction {
  double direction = 0.0;       ///< sense of the rotation: +1, -1, or 0 without it
  double speed = 0.0;           ///< |Omega| whose coefficient acts [rad/s]; 0: the peak mu_s
  std::string why;              ///< for the log
  contact::Sliding sliding{};   ///< what it acts against; none: no friction
  bool ofSlidingSpeed = false;  ///< the coefficient is that of `sliding`, else the peak
};
StaticFriction staticFriction(const Scene& scene);

}  // namespace tooljoint::drillstring
