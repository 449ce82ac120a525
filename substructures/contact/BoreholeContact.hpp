// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact and friction between string nodes and the wall of the hole in motion, as a batch of
/// points with the coordinates u, v, theta_z or u, v, w, theta_z in nodal frames. Nguyen et al.
/// 2020, eqs. (6)-(9).
///
///     r = sqrt(u^2 + v^2 + e^2),  n = (u, v)/r,  t = (-v, u)/r,  G = r - j0,  G' = n.(u', v')
///     force  -F_n n - mu(v_g) F_n t,  torque  -mu(v_g) F_n R_c
///     v_g = t.(u', v') + (Omega + theta_z') R_c
///
/// with F_n(G, G') of the contact law. e = 1e-9 m keeps forces and tangents finite on the axis,
/// where n has no direction. With axial friction the same coefficient acts against the whole
/// sliding velocity. U is the speed of the frame in which displacements are measured:
///
///     v_a = U + w',  v = sqrt(v_g^2 + v_a^2),  force  -F_n n - mu(v) F_n (v_g/v t + v_a/v e_w)
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "model/laws/PointLaw.hpp"
#include "substructures/contact/ContactPoints.hpp"

namespace tooljoint::contact {

/// Nodes are skipped in the contact loop if the force of the law on a distant node is below this
/// [N].
inline constexpr double negligibleForce = 1e-3;

/// Components of a node (0-based, of u, v, w, theta_x, theta_y, theta_z) that a contact law of this
/// width acts on: u, v, theta_z, or u, v, w, theta_z.
inline std::vector<int> contactComponents(int width) {
  if (width == 4) return {0, 1, 2, 5};
  return {0, 1, 5};
}

/// Rotary speed of the string [rad/s] at time t [s].
using RotarySpeed = std::function<double(double)>;

/// How the string slides along the hole.
struct AxialSliding {
  double feed = 0.0;      ///< U of the frame in which w is measured, down positive [m/s]
  bool friction = false;  ///< of the laws of the normal force; point laws have their own friction
};

/// width() = 3: u [m], v [m], theta_z [rad]; forces F_u [N], F_v [N], T_z [N m]. With axial
/// friction width() = 4: w and F_w come between them.
///
/// Channels: normal_force [N] (F_n, positive pushes the string away from the wall) and gap [m] (j0
/// - r, negative in contact); with friction tangential_force [N] (component along t) and
/// friction_torque [N m]; with axial friction axial_friction [N]. Power: stored energy relative to
/// G = 0; losses are F_n G' without the elastic part, and mu F_n v; drive
/// mu F_n (v_g/v Omega R_c + v_a/v U), so that
/// d(stored)/dt + damping + friction - drive = -(force . velocity). A batch without friction has
/// neither friction channels nor friction arithmetic.
class BoreholeContact : public model::PointLaw {
 public:
  explicit BoreholeContact(ContactPoints points) : points_(std::move(points)) {}
  int size() const final { return points_.size(); }
  const ContactPoints& points() const { return points_; }

 protected:
  ContactPoints points_;
};

}  // namespace tooljoint::contact
