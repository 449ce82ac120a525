// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Position of a point of a section relative to the round wall of the hole, and the channels that
/// record contact.
#pragma once

#include <cmath>
#include <vector>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::contact {

/// e of the regularised radius [m].
inline constexpr double axisRadius = 1e-9;

/// Position and motion of a point: directions, penetration and its rate, tangential velocity.
struct WallKinematics {
  double nu, nv, inverse, penetration, rate, slip;
  WallKinematics(double u, double v, double uDot, double vDot, double clearance) {
    const double r = std::sqrt(u * u + v * v + axisRadius * axisRadius);
    inverse = 1.0 / r;
    nu = u * inverse;
    nv = v * inverse;
    penetration = r - clearance;
    rate = nu * uDot + nv * vDot;
    slip = nu * vDot - nv * uDot;
  }
};

/// normal_force and gap; tangential_force and friction_torque with friction; axial_friction with
/// friction along the hole.
inline std::vector<model::Channel> contactChannels(bool friction, bool axial = false) {
  std::vector<model::Channel> list = {
      {"normal_force", "N", "Normal contact force; positive pushes the string away from the wall"},
      {"gap", "m", "Radial clearance left; negative is penetration"}};
  if (friction) {
    list.push_back({"tangential_force", "N", "Friction force on the string along (-v, u)/r"});
    list.push_back({"friction_torque", "N m", "Friction torque on the string about its axis"});
  }
  if (friction && axial)
    list.push_back({"axial_friction", "N", "Friction force on the string along the hole"});
  return list;
}

}  // namespace tooljoint::contact
