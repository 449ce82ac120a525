// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Torque and drag of a string without bending stiffness that lies on the axis of its hole
/// (Johancsik, Friesen and Dawson, J. Petroleum Technology 36, 1984; Sheppard, Wick and Burgess,
/// SPE Drilling Engineering 2, 1987), in vector form:
///
///     N = |T kappa + w (g - (g.t) t)|
///     dT/ds = -w g.t + mu N v_a/v + d,   dM/ds = mu N r_f v_c/v,   v = sqrt(v_a^2 + v_c^2)
///     T(bit) = -WOB,  M(bit) = -TOB
///
/// s downwards along the hole, T effective tension, M torque, t tangent, kappa = dt/ds, g unit
/// gravity, w buoyed weight per length, v_a axial speed (down positive), v_c = Omega r_f, d =
/// C_f rho R_e U_o |U_o| drag of the mud that goes up the annulus with U_o; with the thrust of the
/// pressure it loses there, R_w/(R_w - R_e) times that (mud/AnnularFlow.hpp).
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "substructures/beam/Section.hpp"
#include "substructures/well/Trajectory.hpp"

namespace tooljoint::softstring {

/// A uniform stretch of the string.
struct Stretch {
  double length = 0.0;  ///< [m]
  beam::Section section;
  double weight = 0.0;          ///< w [N/m]
  double frictionRadius = 0.0;  ///< r_f [m]
  double frictionFactor = 1.0;  ///< on mu of the hole
};

/// Mud that goes down the string and up the annulus.
struct Circulation {
  double density = 0.0;              ///< rho [kg/m3]
  double frictionCoefficient = 0.0;  ///< C_f, with the wall shear C_f rho U^2/(2 pi)
  double flowRate = 0.0;             ///< Q [m3/s]
  bool axialDrag = false;            ///< the flow exerts axial drag on the string
  bool thrust = false;               ///< the pressure loss in the annulus pushes the string up
};

/// The hole, by measured depth [m].
struct Hole {
  std::function<well::WellPoint(double)> at;
  std::function<double(double)> radius;    ///< [m]
  std::function<double(double)> friction;  ///< mu
  std::vector<double> breaks;  ///< depths where curvature, radius or friction jump, in any order
  Circulation mud = {};
};

/// An operation: motion of the string and loads at the bit.
struct Operation {
  std::string name;
  double axialSpeed = 0.0;   ///< v_a [m/s], down positive
  double rotarySpeed = 0.0;  ///< Omega [rad/s]
  double weightOnBit = 0.0;  ///< [N]
  double torqueOnBit = 0.0;  ///< [N m]
};

/// Loads along the string, from the bit up to the surface or to the lock-up depth; vectors of equal
/// length.
struct Loads {
  std::vector<double> depth;      ///< measured depth [m], decreasing
  std::vector<double> tension;    ///< T, effective [N]
  std::vector<double> torque;     ///< M [N m]
  std::vector<double> sideForce;  ///< N [N/m], just above the point
  std::vector<int> stretch;       ///< index of the stretch just above the point; the last point has
                                  ///< the stretch below
  double twist = 0.0;             ///< of the bit ahead of the surface, integral of M/(G J) [rad]
  double stretching = 0.0;        ///< integral of T/(E A) [m]
  /// Depth above which the string is buckled into a helix so tightly that no force from above
  /// reaches the bit [m]; negative if the string does not lock up.
  double lockUpDepth = -1.0;
};

/// Axial strain at which a pushed string counts as locked up; steel yields earlier.
inline constexpr double lockedStrain = 0.01;

/// d, upwards [N/m]; zero if the body fills the hole.
double mudDrag(const beam::Section& section, double holeRadius, const Circulation& mud);

/// Loads of a string whose lower end is at the depth `bit`; the part above the surface is ignored.
/// `string` runs from the surface down and is at least as long as `bit`. Fourth-order Runge-Kutta
/// in steps of at most `step` [m] that end at every discontinuity. With `helix`, the side force of
/// a string buckled into a helix, r T^2/(4 E I), is added where -T exceeds the helical limit
/// (Buckling.hpp). ModelError when the string is too short.
Loads march(const std::vector<Stretch>& string, const Hole& hole, double bit,
            const Operation& operation, bool helix = true, double step = 3.0);

/// N of the equation above [N/m].
double sideForce(const well::WellPoint& point, double tension, double weight);

}  // namespace tooljoint::softstring
