// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact and fully developed sliding friction in the static state of a string that turns in its
/// hole or moves along it. Nguyen et al. 2020, eqs. (21), (22), with the friction against the
/// direction of sliding.
#pragma once

#include <algorithm>
#include <limits>
#include <utility>

#include "common/Types.hpp"
#include "substructures/contact/ContactPoints.hpp"

namespace tooljoint::contact {

/// Sliding velocity of the string on the wall in the static state; friction acts against it.
struct Sliding {
  double axialSpeed = 0.0;   ///< v_a, down positive [m/s]
  double rotarySpeed = 0.0;  ///< Omega [rad/s]

  bool any() const { return axialSpeed != 0.0 || rotarySpeed != 0.0; }
  /// (v_a, v_c)/v with v_c = Omega R_c, v = sqrt(v_a^2 + v_c^2), of a surface with this radius [m];
  /// zero without sliding. A string that only turns has (0, +-1) at any radius.
  std::pair<double, double> direction(double radius) const;
};

/// With the unit normal n and tangent t of the point, v_c = Omega R_c and the sliding speed v:
///
///     force  -F_n n - mu_s F_n (v_c/v t + v_a/v e_w),   torque  -mu_s F_n R_c v_c/v,
///
/// where F_n is the elastic part of the contact law.
class StaticContact {
 public:
  struct Options {
    double lambda =
        0.0;  ///< stiffness regularisation of all points [1/m]; 0 = each point's own value
    double frictionScale = 1.0;   ///< factor on mu_s: 0 without friction, 1 with full friction
    double stiffnessScale = 1.0;  ///< factor on the wall stiffness in intermediate stages
    double pull =
        1.0;  ///< fraction of the attraction of open points by the law: 0 = a wall that only pushes
    Sliding sliding{0.0, 1.0};
    /// Points to evaluate, first ... last - 1; results of other points are not used.
    int first = 0, last = std::numeric_limits<int>::max();

    int end(int points) const { return std::min(last, points); }
  };

  /// Forces of a point: F_u, F_v, F_w [N], T_z [N m].
  static constexpr int kForces = 4;

  explicit StaticContact(ContactPoints points) : points_(std::move(points)) {}
  virtual ~StaticContact() = default;
  int size() const { return points_.size(); }
  const ContactPoints& points() const { return points_; }

  /// Forces of all points: uv (2 per point: u, v [m]) -> f (kForces per point); with `tangent` not
  /// null also df/d(u, v), row by row (kForces x 2 per point).
  virtual void evaluate(const Options& options, const double* uv, double* f,
                        double* tangent = nullptr) const;

  /// Normal force F_n [N] per point, positive when the wall pushes; with `slope` not null also
  /// dF_n/dG [N/m].
  virtual void normalForce(const Options& options, const double* uv, double* force,
                           double* slope = nullptr) const = 0;

  /// Largest force that pulls an open point to the wall [N]; 0 for laws without attraction.
  virtual double largestPull() const = 0;

  /// Centre of contact of a point relative to the axis of the string [m].
  virtual Eigen::Vector2d offset(int /*point*/) const { return Eigen::Vector2d::Zero(); }

 protected:
  ContactPoints points_;
};

}  // namespace tooljoint::contact
