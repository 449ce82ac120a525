// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fallback if Newton stalls on a few points whose force jumps (contact that switches within the
/// step, friction that reverses). These points are solved with their nonlinear laws against the
/// linearised compliance of everything else.
///
///     S delta = -R + sum_i R_i' phi_i,   phi_i = f_i(d_i + y_i, v_i + c y_i) - f_i(d_i, v_i), y_i
///     = R_i delta
///
/// where S contains the tangents of all points except these. With G_ij = R_i S^-1 R_j' this is y_i
/// = y_i^0 + sum_j G_ij phi_j, a problem of a few points. It is solved in sweeps over the points;
/// each point is solved by Newton with backtracking and a bracket on its own few coordinates.
#pragma once

#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/contact/PointSolve.hpp"

namespace tooljoint::transient {

class CoupledPointSolve {
 public:
  void bind(CompiledModel& model, Strategies& strategies);

  /// Stores positions, velocities and forces of the active points at the start iterate, which has
  /// just been evaluated.
  void begin();
  /// The batches have been evaluated at the end of a trial step `delta`. Adds the points whose
  /// force differs from the prediction of their frozen tangent, and removes their tangents from it.
  /// False if there are none to add, or no room. `weight` scales the rows of forces.
  bool addTroubled(const double* delta, const double* weight);
  /// delta and force = sum R_i' phi_i for the points added so far. `residual` belongs to the
  /// iterate of begin(), `factor` to the frozen tangents. False if the sweeps do not converge.
  bool solve(double t, double c, const linalg::BlockFactor& factor, const Vector& residual,
             Vector& delta, Vector& force);

 private:
  using Local = PointSolve::Local;
  struct Point {
    int batch;
    int first;  ///< its first column
    PointSolve problem;
    Local y, phi;
  };
  bool isIn(int batch, int point) const;
  double error(const PointBatch& batch, int b, int p, const double* delta,
               const double* weight) const;

  CompiledModel* model_ = nullptr;
  Strategies* strategies_ = nullptr;
  std::vector<std::vector<double>> d_, v_, f_;  ///< per batch, at begin()
  std::vector<Point> points_;
  Matrix columns_;     ///< S^-1 R_i', one column per coordinate
  Matrix compliance_;  ///< R_i S^-1 R_j'
};

}  // namespace tooljoint::transient
