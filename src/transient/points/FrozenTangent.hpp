// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tangents P = cd df/dd + cv df/dv of the points of a batch, kept as long as a factored matrix
/// contains them.
#pragma once

#include <vector>

#include "transient/points/PointRows.hpp"

namespace tooljoint::transient {

/// P and its part cd df/dd are width x width per point, row-major, and zero at points that are not
/// frozen. The rows R of the points are given in each call.
class FrozenTangent {
 public:
  FrozenTangent(int points, int width);

  /// Freezes the tangents of these points. \param dfdd, dfdv of all points
  void freeze(const std::vector<int>& points, const double* dfdd, const double* dfdv, double cd,
              double cv);
  /// Removes from P the part that acts in the direction of motion (friction that decreases with
  /// speed), at points where at least one diagonal entry is positive, because an effective matrix
  /// with this part may be indefinite. The part of P from df/dd alone keeps only its symmetric,
  /// restoring part.
  void takeOutPush();
  /// Leaves out of the part from df/dd alone the points whose df/dd turns by more than `most` [rad]
  /// to the given ones: the angle of two tangents is that of the normals of a wall. Before
  /// takeOutPush(). \param then  df/dd of all points a moment later
  void leaveOutTurning(const double* then, double most);
  void forget();
  /// Removes the tangent of a point.
  void drop(int point);

  const std::vector<int>& points() const { return points_; }
  const double* values() const { return P_.data(); }

  /// Matrix -= R' P R on the pattern.
  void subtract(const PointRows& rows, double* values) const;
  /// The same with the part of P from df/dd alone.
  void subtractOfPosition(const PointRows& rows, double* values) const;
  /// y += R' P R x.
  void addTimes(const PointRows& rows, const double* x, double* y) const;
  /// Row of P R x; 0 if the point is not frozen.
  double times(const PointRows& rows, int row, const double* x) const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  int width_;
  std::vector<int> points_;
  std::vector<double> P_, ofPosition_;
  mutable std::vector<double> Rx_;  ///< of one point
};

}  // namespace tooljoint::transient
