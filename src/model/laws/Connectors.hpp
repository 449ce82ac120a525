// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Springs, stops and sliders: point laws between two dofs of one or two parts. The coordinate d is
/// their separation (coupling::separation). The force f acts along it, and -f on the other side by
/// the same row.
#pragma once

#include <memory>
#include <vector>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// f = -k d - k3 d^3 - c d'.
struct SpringParameters {
  double stiffness = 0;       ///< k [N/m, N m/rad], >= 0
  double cubicStiffness = 0;  ///< k3 [N/m^3], >= 0
  double damping = 0;         ///< c [N s/m], >= 0
};
/// Width 1. Channel spring_force. Throws ModelError for parameters out of range, like the functions
/// below.
std::unique_ptr<PointLaw> springs(const std::vector<SpringParameters>& points);

/// A stop that closes when the separation falls to -gap: HuntCrossley of the penetration -(d + gap)
/// with exponent 1.
struct StopParameters {
  double gap = 0;              ///< [m]; separation left at rest
  double stiffness = 0;        ///< k [N/m], > 0
  double damping = 0;          ///< chi [s/m], >= 0
  double smoothing = 0;        ///< s [m], >= 0
  double friction = 0;         ///< mu of slidingStops
  double slipVelocity = 1e-3;  ///< v_r of slidingStops [m/s], > 0
};
/// Width 1. Channels stop_force, stop_gap.
std::unique_ptr<PointLaw> stops(const std::vector<StopParameters>& points);
/// Stops with Coulomb friction: coordinates are the separation and one (width 2) or two (width 3)
/// tangential displacements, friction -mu f w / sqrt(|w|^2 + v_r^2) with the tangential velocity w.
/// Channels stop_force, stop_gap, friction_force.
std::unique_ptr<PointLaw> slidingStops(const std::vector<StopParameters>& points, int tangents);

/// f = -F d' / sqrt(d'^2 + v_r^2): Coulomb friction of constant size, regularised.
struct FrictionParameters {
  double force = 0;            ///< F [N, N m], >= 0
  double slipVelocity = 1e-3;  ///< v_r [m/s, rad/s], > 0
};
/// Width 1. Channel friction_force.
std::unique_ptr<PointLaw> frictions(const std::vector<FrictionParameters>& points);

}  // namespace tooljoint::model
