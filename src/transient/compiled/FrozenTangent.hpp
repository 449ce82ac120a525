// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tangents P = cd df/dd + cv df/dv of the points of a batch, kept while a factored matrix has
/// them.
#pragma once

#include <vector>

#include "transient/compiled/PointRows.hpp"

namespace tooljoint::transient {

/// P and its part cd df/dd are width x width per point, row-major, and zero at points that are not
/// frozen. R: rows of the points, as given to each call.
class FrozenTangent {
 public:
  FrozenTangent(int points, int width);

  /// Those of these points from now on. \param dfdd, dfdv  of all points
  void freeze(const std::vector<int>& points, const double* dfdd, const double* dfdv, double cd,
              double cv);
  /// Take out of P what pushes on as its point moves (friction that falls with speed), at points
  /// where it pushes on in one coordinate at least: an effective matrix with it may be indefinite.
  /// The part of P that is df/dd alone keeps only what resists and is symmetric.
  void takeOutPush();
  void forget();
  /// Take the tangent of a point out.
  void drop(int point);

  const std::vector<int>& points() const { return points_; }
  const double* values() const { return P_.data(); }

  /// Matrix -= R' P R on the pattern.
  void subtract(const PointRows& rows, double* values) const;
  /// The same with the part of P that is df/dd alone.
  void subtractOfPosition(const PointRows& rows, double* values) const;
  /// y += R' P R x.
  void addTimes(const PointRows& rows, const double* x, double* y) const;
  /// Row of P R x; 0 for a point that is not frozen.
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
