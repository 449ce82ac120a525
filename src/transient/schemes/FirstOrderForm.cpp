// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/FirstOrderForm.hpp"

#include <algorithm>

#include "common/Error.hpp"

namespace tooljoint::transient {

void FirstOrderForm::bind(CompiledModel& model, const std::string& integrator) {
  model_ = &model;
  n_ = model.size();
  mass_ = linalg::BlockFactor(model.pattern());
  newton_ = linalg::BlockFactor(model.pattern());
  model.combine(1.0, 0.0, 0.0, mass_.values());
  ++factorisations_;
  const int bad = mass_.factor();
  if (bad >= 0)
    throw ModelError("The mass matrix is singular at " + model.dofName(bad) +
                     ": the integrator \"" + integrator +
                     "\" solves for accelerations and needs a mass on every degree of freedom. Use "
                     "\"Generalized-alpha\", or give "
                     "that degree of freedom a mass.");
  right_.setZero(n_);
  product_.setZero(n_);
}

/// Solvers evaluate at stages they choose, forwards and backwards in time: no point is left out by
/// what was seen before.
void FirstOrderForm::touch(double t, const double* q) {
  model_->setTime(t);
  for (auto& batch : model_->points()) batch.look(t, 0.0, q);
}

void FirstOrderForm::rightHandSide(double t, const double* y, double* yDot) {
  const double* q = y;
  const double* v = y + n_;
  double* a = yDot + n_;
  touch(t, q);
  std::copy(v, v + n_, yDot);
  // a = -(K q + C v), then the difference to F + R'f, then M^-1
  std::fill(a, a + n_, 0.0);
  model_->addStiffness(q, a);
  model_->addDamping(v, a);
  const double* load = model_->load();
  for (int i = 0; i < n_; ++i) a[i] = load[i] - a[i];
  model_->addPointForces(t, q, v, a);
  mass_.solve(a);
  ++evaluations_;
}

bool FirstOrderForm::factor(double t, const double* y, double gamma) {
  touch(t, y);
  gamma_ = gamma;
  ++factorisations_;
  // M + g (C - R' df/dv R) + g^2 (K - R' df/dd R)
  model_->combine(1.0, gamma, gamma * gamma, newton_.values());
  for (auto& batch : model_->points()) {
    batch.evaluateWithTangent(t, y, y + n_);
    batch.freezeTangent(gamma * gamma, gamma);
    batch.subtractTangent(newton_.values());
    batch.freezeTangent(1.0, 0.0);  // df/dd alone, for K* in solve()
  }
  return newton_.factor() < 0;
}

void FirstOrderForm::solve(double* x) {
  double* q = x;
  double* v = x + n_;
  // product = K* r_q = K r_q - R' df/dd R r_q
  right_.setZero();
  for (auto& batch : model_->points()) batch.addTangentTimes(q, right_.data());
  product_ = -right_;
  model_->addStiffness(q, product_.data());
  // right = M r_v - g K* r_q
  right_ = -gamma_ * product_;
  model_->addMass(v, right_.data());
  newton_.solve(right_.data());
  for (int i = 0; i < n_; ++i) {
    v[i] = right_[i];
    q[i] += gamma_ * v[i];
  }
}

}  // namespace tooljoint::transient
