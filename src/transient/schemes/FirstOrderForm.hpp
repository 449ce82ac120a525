// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A compiled model as y' = f(t, y) with y = (q, v), for solvers of first-order systems, and the
/// Newton matrix of their implicit formulas solved with blocks of the second-order model. With x =
/// (x_q, x_v), r = (r_q, r_v) and J = df/dy,
///
///     (I - g J) x = r   <=>   (M + g C* + g^2 K*) x_v = M r_v - g K* r_q,   x_q = r_q + g x_v,
///
/// where C* = C - R' df/dv R and K* = K - R' df/dd R hold the tangents of the point laws: one
/// factor of the size of q.
#pragma once

#include <string>

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class FirstOrderForm {
 public:
  /// Factors M. The model must outlive this. Throws ModelError naming a dof without mass.
  void bind(CompiledModel& model, const std::string& integrator);

  int dofs() const { return n_; }
  int size() const { return 2 * n_; }

  /// yDot = (v, M^-1 (F(t) + R' f(q, v, t) - C(t) v - K(t) q)); `size()` numbers each. Every point
  /// that touches at y acts.
  void rightHandSide(double t, const double* y, double* yDot);

  /// Factor I - gamma J(t, y) with the tangents at y; false when it is singular.
  bool factor(double t, const double* y, double gamma);
  /// x := (I - gamma J)^-1 x with the last factor.
  void solve(double* x);

  long evaluations() const { return evaluations_; }
  long factorisations() const { return factorisations_; }
  CompiledModel& model() { return *model_; }

 private:
  void touch(double t, const double* q);

  CompiledModel* model_ = nullptr;
  int n_ = 0;
  linalg::BlockFactor mass_, newton_;
  double gamma_ = 0;
  Vector right_, product_;
  long evaluations_ = 0, factorisations_ = 0;
};

}  // namespace tooljoint::transient
