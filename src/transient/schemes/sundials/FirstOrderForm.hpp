// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A compiled model as y' = f(t, y) with y = (q, v, z), z the rated states of point laws, for
/// solvers of first-order systems. The Newton matrix of their implicit formulas is solved with
/// blocks of the second-order model. With x = (x_q, x_v, x_z), r likewise, J = df/dy, f the forces
/// and g the rates of the laws, and S = (I - g dg/dz)^-1,
///
///     (I - g J) x = r   <=>   (M + g C* + g^2 K*) x_v = M r_v - g K* r_q + g R' df/dz S r_z,
///                             x_q = r_q + g x_v,   x_z = S (r_z + g dg/dd R x_q + g dg/dv R x_v),
///
/// where C* = C - R' df/dv R and K* = K - R' df/dd R contain the tangents of the point laws with
/// their states eliminated (PointStates). One factor of the size of q suffices. Held states are no
/// unknowns: they change in accept().
#pragma once

#include <string>

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class FirstOrderForm {
 public:
  /// Factors M. The model must outlive this. Throws ModelError naming a dof without mass.
  void bind(CompiledModel& model, const std::string& integrator);

  int dofs() const { return n_; }
  int size() const { return 2 * n_ + rated_; }

  /// Sets the states of point laws at the start or restart of the motion, in particular held ones.
  void setStates(const Vector& x) { x_ = x; }
  /// y of a state, `size()` numbers, and q, v and x of a y.
  void pack(const State& state, double* y) const;
  void unpack(const double* y, State& state) const;
  /// Updates the held states at the end of a step at `state`, and completes its x. True if this
  /// changes the accelerations or rates there by more than this part of the largest: the history of
  /// the solver then belongs to another system.
  bool accept(State& state, double tolerance);

  /// yDot = (v, M^-1 (F(t) + R' f(q, v, z, t) - C(t) v - K(t) q), g(q, v, z, t)); `size()` numbers
  /// each. Includes every point that touches at y.
  void rightHandSide(double t, const double* y, double* yDot);
  /// The same for a state: a and xDot.
  void complete(State& state);
  /// "theta_z of node 17", "state 1 of point 3 of cutter".
  std::string nameOf(int position) const;

  /// Factor I - gamma J(t, y) with the tangents at y; false if it is singular.
  bool factor(double t, const double* y, double gamma);
  /// x := (I - gamma J)^-1 x with the last factor.
  void solve(double* x);

  long evaluations() const { return evaluations_; }
  long factorisations() const { return factorisations_; }
  CompiledModel& model() { return *model_; }

 private:
  void touch(double t, const double* q);
  void bindStates(const double* y);
  /// act(batch, its PointStates, start of its states in x, start of its rated states in z).
  template <class Act>
  void forStates(const Act& act) const;

  CompiledModel* model_ = nullptr;
  int n_ = 0;
  int rated_ = 0;       ///< length of z
  bool holds_ = false;  ///< some states are held
  linalg::BlockFactor mass_, newton_;
  double gamma_ = 0;
  Vector right_, product_;
  Vector x_;                  ///< states at the last evaluation; held ones of the last accept()
  Vector y_, yDot_, before_;  ///< used in complete() and accept()
  Vector xDot_, rows_, dRows_, vRows_;
  long evaluations_ = 0, factorisations_ = 0;
};

}  // namespace tooljoint::transient
