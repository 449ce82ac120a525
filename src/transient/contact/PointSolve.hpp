// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One point of a PointSet against the compliance of everything else:
///
///     y = free + G phi(y),   phi(y) = f(d + y, v + c y) - f0 - P y
///
/// for its own few coordinates y. Forces that jump are bracketed, so this converges where Newton
/// for the whole model does not.
#pragma once

#include <Eigen/Core>

#include "transient/Strategies.hpp"
#include "transient/points/PointBatch.hpp"

namespace tooljoint::transient {

struct PointSolve {
  static constexpr int widest = 6;  ///< coordinates a point may have
  using Local = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, widest, 1>;
  using LocalMatrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, widest, widest>;

  Strategies* strategies = nullptr;  ///< must outlive the solution
  int point = 0;
  Local d, v, f0;
  LocalMatrix P, G;
  Local free;

  /// Solves from the guess y; phi(y) is returned in `phi`. False if no finite iterate was found.
  bool solve(PointBatch& batch, double t, double c, Local& y, Local& phi) const;

 private:
  double iterate(PointBatch& batch, double t, double c, const Local& scale, Local& y,
                 Local& phi) const;
  void flow(PointBatch& batch, double t, double c, const Local& scale, double enough, Local& y,
            Local& phi) const;
  void follow(PointBatch& batch, double t, double c, const Local& scale, double enough, Local& y,
              Local& phi) const;
  double rounding(PointBatch& batch, double t, double c, const Local& scale, const Local& y) const;
  Local defect(PointBatch& batch, double t, double c, const Local& y, Local& phi,
               LocalMatrix* slope) const;
};

}  // namespace tooljoint::transient
