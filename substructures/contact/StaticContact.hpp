// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact and fully developed sliding friction of a string at rest that turns in its hole. Nguyen
/// et al. 2020, eqs. (21), (22).
#pragma once

#include <utility>

#include "common/Types.hpp"
#include "substructures/contact/ContactPoints.hpp"

namespace tooljoint::contact {

/// force  -F_n n - mu_s F_n t sign(Omega),  torque  -mu_s F_n R_c sign(Omega),  F_n the elastic
/// part of the contact law.
class StaticContact {
 public:
  struct Options {
    double lambda =
        0.0;  ///< stiffness regularisation used for every point [1/m]; 0 = the points' own
    double frictionScale = 1.0;   ///< factor on mu_s: 0 without friction, 1 in full
    double stiffnessScale = 1.0;  ///< softens the wall on the way to the solution
    double pull =
        1.0;  ///< share of what the law pulls open points with: 0 = a wall that only pushes
    double direction = 1.0;  ///< sign of the rotary speed: +1, -1, or 0 without friction
  };

  explicit StaticContact(ContactPoints points) : points_(std::move(points)) {}
  virtual ~StaticContact() = default;
  int size() const { return points_.size(); }
  const ContactPoints& points() const { return points_; }

  /// Forces of all points: uv (2 per point: u, v [m]) -> f (3 per point: F_u, F_v [N], T_z [N m]);
  /// with `tangent` not null also df/d(u,v), 6 per point, row by row (3 x 2).
  virtual void evaluate(const Options& options, const double* uv, double* f,
                        double* tangent = nullptr) const = 0;

  /// Normal force F_n [N] per point, positive when the wall pushes.
  virtual void normalForce(const Options& options, const double* uv, double* force) const = 0;

  /// What the law pulls an open point with at most [N]; 0 where it never does.
  virtual double largestPull() const = 0;

  /// Centre of contact of a point from the axis of the string [m].
  virtual Eigen::Vector2d offset(int /*point*/) const { return Eigen::Vector2d::Zero(); }

 protected:
  ContactPoints points_;
};

}  // namespace tooljoint::contact
