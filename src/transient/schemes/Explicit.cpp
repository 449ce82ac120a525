// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/Explicit.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/Error.hpp"

namespace tooljoint::transient {

void ExplicitRightHandSide::bind(CompiledModel& model, const std::string& integrator,
                                 Counters& counters) {
  model_ = &model;
  counters_ = &counters;
  mass_ = linalg::BlockFactor(model.pattern());
  model.combine(1.0, 0.0, 0.0, mass_.values());
  const int bad = mass_.factor();
  if (bad >= 0)
    throw ModelError("The mass matrix is singular at " + model.dofName(bad) +
                     ": the explicit integrator \"" + integrator +
                     "\" needs a mass on every degree of freedom. Use \"Generalized-alpha\", or "
                     "give that degree of freedom a mass.");
}

void ExplicitRightHandSide::acceleration(double t, const Vector& q, const Vector& v,
                                         const Vector& x, Vector& a, Vector& xDot) {
  ++counters_->rightHandSides;
  model_->setTime(t);
  const int n = model_->size();
  // a = -(K q + C v), then the difference to F + R'f, then M^-1
  a.setZero();
  model_->addStiffness(q.data(), a.data());
  model_->addDamping(v.data(), a.data());
  const double* load = model_->load();
  for (int i = 0; i < n; ++i) a[i] = load[i] - a[i];
  model_->bindStates(x.data());
  model_->addPointForces(t, q.data(), v.data(), a.data());
  model_->stateRates(xDot.data());
  mass_.solve(a.data());
}

void ExplicitRightHandSide::look(double t, double h, const double* q) {
  for (auto& batch : model_->points()) batch.look(t, h, q);
}

bool ExplicitRightHandSide::missed(const double* q) {
  bool any = false;
  for (auto& batch : model_->points()) any = batch.addMissed(q) || any;
  return any;
}

double ExplicitRightHandSide::largestFrequency(const State& state) {
  const int n = model_->size();
  CompiledModel& model = *model_;
  model.setTime(state.t);
  model.bindStates(state.x.data());
  for (auto& batch : model.points()) {
    batch.look(state.t, 0.0, state.q.data());
    batch.evaluateWithTangent(state.t, state.q.data(), state.v.data());
    batch.freezeTangent(1.0, 0.0);
  }
  const auto stiffnessTimes = [&](const Vector& x, Vector& y) {
    y.setZero();
    model.addStiffness(x.data(), y.data());
    Vector contact = Vector::Zero(n);
    for (auto& batch : model.points()) batch.addTangentTimes(x.data(), contact.data());
    y -= contact;
  };
  // Lanczos for K x = omega^2 M x: M-orthonormal vectors, full re-orthogonalisation, deterministic
  // start.
  const int steps = std::min(n, 60);
  Matrix V(n, steps + 1);
  Matrix MV(n, steps + 1);
  Vector alpha = Vector::Zero(steps);
  Vector beta = Vector::Zero(steps + 1);
  Vector x(n), y(n);
  for (int i = 0; i < n; ++i) x[i] = std::sin(1.0 + 12.9898 * i) + ((i % 2) == 0 ? 1.0 : -1.0);
  const auto massTimes = [&](const Vector& in, Vector& out) {
    out.setZero();
    model.addMass(in.data(), out.data());
  };
  // The first vector is M^-1 x, so that masses far apart in size do not hide the stiff ones.
  mass_.solve(x.data());
  double largest = 0;
  int used = 0;
  for (int k = 0; k < steps; ++k) {
    massTimes(x, y);
    const double norm = std::sqrt(std::max(0.0, x.dot(y)));
    beta[k] = norm;
    if (!(norm > 1e-12 * std::max(1.0, largest))) break;
    V.col(k) = x / norm;
    MV.col(k) = y / norm;
    x = V.col(k);
    stiffnessTimes(x, y);
    alpha[k] = x.dot(y);
    mass_.solve(y.data());
    x = y;
    for (int pass = 0; pass < 2; ++pass)
      x -= V.leftCols(k + 1) * (MV.leftCols(k + 1).transpose() * x);
    used = k + 1;
    largest = std::max(largest, std::abs(alpha[k]));
  }
  for (auto& batch : model.points()) batch.forgetTangent();
  if (used == 0) return 0;
  massTimes(x, y);
  const double last = std::sqrt(std::max(0.0, x.dot(y)));
  Matrix T = Matrix::Zero(used, used);
  for (int k = 0; k < used; ++k) {
    T(k, k) = alpha[k];
    if (k > 0) T(k, k - 1) = T(k - 1, k) = beta[k];
  }
  const Eigen::SelfAdjointEigenSolver<Matrix> ritz(T);
  const double bound =
      ritz.eigenvalues()[used - 1] + std::abs(last * ritz.eigenvectors()(used - 1, used - 1));
  return std::sqrt(std::max(0.0, bound));
}

void RungeKuttaStep::resize(const State& like) {
  for (Vector* each : {&qi_, &vi_, &vj_, &a2_, &a3_, &a4_}) each->setZero(like.q.size());
  for (Vector* each : {&xi_, &x2_, &x3_, &x4_}) each->setZero(like.x.size());
}

void RungeKuttaStep::take(ExplicitRightHandSide& rhs, const State& from, double h, State& to) {
  const Vector &q0 = from.q, &v0 = from.v, &a0 = from.a, &x0 = from.x, &x1 = from.xDot;
  const double t = from.t;
  // k1 = (v0, a0, x1);  q += h/6 (k1 + 2 k2 + 2 k3 + k4) gathers in q and v as the stages come
  qi_ = q0 + 0.5 * h * v0;
  vi_ = v0 + 0.5 * h * a0;
  xi_ = x0 + 0.5 * h * x1;
  rhs.acceleration(t + 0.5 * h, qi_, vi_, xi_, a2_, x2_);
  to.q = v0 + 2.0 * vi_;
  qi_ = q0 + 0.5 * h * vi_;
  vj_ = v0 + 0.5 * h * a2_;
  xi_ = x0 + 0.5 * h * x2_;
  rhs.acceleration(t + 0.5 * h, qi_, vj_, xi_, a3_, x3_);
  to.q += 2.0 * vj_;
  qi_ = q0 + h * vj_;
  vi_ = v0 + h * a3_;
  xi_ = x0 + h * x3_;
  rhs.acceleration(t + h, qi_, vi_, xi_, a4_, x4_);
  to.q += vi_;
  to.q = q0 + h / 6.0 * to.q;
  to.v = v0 + h / 6.0 * (a0 + 2.0 * a2_ + 2.0 * a3_ + a4_);
  to.x = x0 + h / 6.0 * (x1 + 2.0 * x2_ + 2.0 * x3_ + x4_);
}

}  // namespace tooljoint::transient
