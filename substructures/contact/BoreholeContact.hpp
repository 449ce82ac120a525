// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact and friction between string nodes and the wall of the hole in motion, as a batch of
/// points with the coordinates u, v, theta_z in nodal frames. Nguyen et al. 2020, eqs. (6)-(9).
///
///     r = sqrt(u^2 + v^2 + e^2),  n = (u, v)/r,  t = (-v, u)/r,  G = r - j0,  G' = n.(u', v')
///     force  -F_n n - mu(v_g) F_n t,  torque  -mu(v_g) F_n R_c,  v_g = t.(u', v') + (Omega +
///     theta_z') R_c
///
/// with F_n(G, G') of the contact law. e = 1e-9 m keeps forces and tangents finite on the axis,
/// where n has no direction.
#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "model/laws/PointLaw.hpp"
#include "substructures/contact/ContactPoints.hpp"

namespace tooljoint::contact {

/// A law whose tail (the force on a node far from the wall) is below this [N] lets nodes be
/// skipped.
inline constexpr double negligibleForce = 1e-3;

/// Components of a node (0-based, of u, v, w, theta_x, theta_y, theta_z) that a contact law of this
/// width acts on: u, v, theta_z, or u, v, w, theta_z.
inline std::vector<int> contactComponents(int width) {
  if (width == 4) return {0, 1, 2, 5};
  return {0, 1, 5};
}

/// Rotary speed of the string [rad/s] at time t [s].
using RotarySpeed = std::function<double(double)>;

/// width() = 3: u [m], v [m], theta_z [rad]; forces F_u [N], F_v [N], T_z [N m].
///
/// Channels: normal_force [N] (F_n, positive pushes the string away from the wall), gap [m] (j0 -
/// r, negative in contact), and with friction tangential_force [N] (component along t) and
/// friction_torque [N m]. Power: stored energy relative to G = 0, losses F_n G' beyond the elastic
/// part and mu F_n v_g, drive mu F_n Omega R_c, so that d(stored)/dt + damping + friction - drive =
/// -(force . velocity). A batch without friction has neither the friction channels nor any friction
/// arithmetic.
class BoreholeContact : public model::PointLaw {
 public:
  explicit BoreholeContact(ContactPoints points) : points_(std::move(points)) {}
  int size() const final { return points_.size(); }
  int width() const final { return 3; }
  const ContactPoints& points() const { return points_; }

 protected:
  ContactPoints points_;
};

}  // namespace tooljoint::contact
