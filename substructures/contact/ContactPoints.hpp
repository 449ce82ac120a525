// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The nodes that can touch the wall, with their parameters, as a structure of arrays.
#pragma once

#include <vector>

namespace tooljoint::contact {

/// Parameters of one point.
struct ContactPoint {
  int node = 0;                         ///< 1-based
  double clearance = 0.0;               ///< j0 [m]
  double contactRadius = 0.0;           ///< R_c, lever arm of the friction torque [m]
  double stiffness = 0.0;               ///< k_c [N/m]
  double damping = 0.0;                 ///< c_c [N s/m]
  double lambdaK = 1e6;                 ///< regularisation of the stiffness [1/m]
  double lambdaC = 1e6;                 ///< regularisation of the damping [1/m]
  double muStatic = 0.0;                ///< 0 = frictionless
  double muDynamic = 0.0;               ///< not above muStatic
  double regularisationVelocity = 0.1;  ///< v_r [m/s]
};

/// Batch of points, one array per parameter.
struct ContactPoints {
  std::vector<int> node;
  std::vector<double> clearance;
  std::vector<double> contactRadius;
  std::vector<double> stiffness;
  std::vector<double> damping;
  std::vector<double> lambdaK;
  std::vector<double> lambdaC;
  std::vector<double> muStatic;
  std::vector<double> muDynamic;
  std::vector<double> regularisationVelocity;

  int size() const { return static_cast<int>(node.size()); }
  /// Appends a point. Throws DeckError for invalid parameters (muDynamic above muStatic, a negative
  /// stiffness ...).
  void add(const ContactPoint& point);
  ContactPoint at(int i) const;
  /// The points at these 0-based positions.
  ContactPoints subset(const std::vector<int>& positions) const;
  /// True if no point has friction.
  bool frictionless() const;
  /// The same points with mu_s replaced by mu(v) of eq. (9), v = hypot(Omega R_c, v_a): the sliding
  /// speed of a section that turns at Omega [rad/s] and moves along the hole at v_a [m/s], but not
  /// sideways. For StaticContact, which uses mu_s only.
  ContactPoints slidingAt(double omega, double axialSpeed = 0.0) const;
  /// The same points with mu_s replaced by mu_d: the coefficient of fast sliding.
  ContactPoints slidingFast() const;
};

}  // namespace tooljoint::contact
