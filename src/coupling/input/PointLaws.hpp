// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws between two dofs, of one part or of two: the coordinate d is their separation
/// (coupling::separation), f the force that acts along it, and -f on the other side by the same
/// row.
#pragma once

#include <memory>
#include <vector>

#include "model/PointLaw.hpp"

namespace tooljoint::coupling {

/// f = -k d - k3 d^3 - c d'.
struct SpringParameters {
  double stiffness = 0;       ///< k [N/m, N m/rad], >= 0
  double cubicStiffness = 0;  ///< k3 [N/m^3], >= 0
  double damping = 0;         ///< c [N s/m], >= 0
};
/// Width 1. Channel spring_force.
std::shared_ptr<const model::PointLaw> springs(const std::vector<SpringParameters>& points);

/// A stop that is met when the separation falls to -gap: with the penetration p = -(d + gap),
///
///     f = k g(p) max(0, 1 + chi p'),   g = 0 for p <= -s, (p + s)^2 / 4s in between, p for p >= s
///
/// chi is the damping of K. H. Hunt and F. R. E. Crossley (1975). Never pulls.
struct StopParameters {
  double gap = 0;              ///< [m]; separation left at rest
  double stiffness = 0;        ///< k [N/m], > 0
  double damping = 0;          ///< chi [s/m], >= 0
  double smoothing = 0;        ///< s [m], >= 0
  double friction = 0;         ///< mu of slidingStops
  double slipVelocity = 1e-3;  ///< v_r of slidingStops [m/s], > 0
};
/// Width 1. Channels stop_force, stop_gap.
std::shared_ptr<const model::PointLaw> stops(const std::vector<StopParameters>& points);
/// Stops with Coulomb friction: coordinates are the separation and one (width 2) or two (width 3)
/// tangential displacements, friction -mu f w / sqrt(|w|^2 + v_r^2) with the tangential velocity w.
/// Channels stop_force, stop_gap, friction_force.
std::shared_ptr<const model::PointLaw> slidingStops(const std::vector<StopParameters>& points,
                                                    int tangents);

/// f = -F d' / sqrt(d'^2 + v_r^2): Coulomb friction of constant size, regularised.
struct FrictionParameters {
  double force = 0;            ///< F [N, N m], >= 0
  double slipVelocity = 1e-3;  ///< v_r [m/s, rad/s], > 0
};
/// Width 1. Channel friction_force.
std::shared_ptr<const model::PointLaw> frictions(const std::vector<FrictionParameters>& points);

}  // namespace tooljoint::coupling
