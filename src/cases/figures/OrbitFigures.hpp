// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Motion of the nodes of a rotor around the axis of their hole: precession, forward and backward
/// whirl, with and without contact.
#pragma once

#include <vector>

#include "cases/figures/SignalFigures.hpp"
#include "common/Types.hpp"

namespace tooljoint::cases {

/// Lateral motion of the nodes at one instant.
struct OrbitSample {
  const Vector& u;                     ///< per node [m]
  const Vector& v;                     ///< [m]
  const Vector& uDot;                  ///< [m/s]
  const Vector& vDot;                  ///< [m/s]
  const std::vector<char>& inContact;  ///< per node
  double rotarySpeed = 0.0;            ///< [rad/s], positive turns u into v
};

/// A node whirls forward or backward if its angle about the axis turns with or against the rotation
/// at more than `whirlFraction` of the rotary speed. Slower nodes rest or rock at the wall.
class OrbitFigures {
 public:
  static constexpr double whirlFraction = 0.1;

  explicit OrbitFigures(Eigen::Index nodes);

  void add(const OrbitSample& sample);

  /// Mean precession rate of each node, sum(u v' - v u')/sum(u^2 + v^2), which weights instants by
  /// the radius squared [rad/s]; positive turns u into v. 0 if a node never leaves the axis.
  Vector rate() const;
  Vector forwardShare() const { return share(forward_); }     ///< of the samples
  Vector backwardShare() const { return share(backward_); }   ///< of the samples
  Vector forwardContact() const { return share(rubbing_); }   ///< forward and in contact
  Vector backwardContact() const { return share(rolling_); }  ///< backward and in contact

  /// The node with the largest of these fractions. Among equal ones, as for nodes that whirl in one
  /// shape, the node with the widest orbit.
  WorstPlace most(const Vector& share) const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  Vector share(const Vector& counts) const;

  long samples_ = 0;
  Vector moment_, radius_;  ///< sums of u v' - v u' and u^2 + v^2
  Vector forward_, backward_, rubbing_, rolling_;
};

}  // namespace tooljoint::cases
