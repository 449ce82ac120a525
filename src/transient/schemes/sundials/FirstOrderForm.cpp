// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/sundials/FirstOrderForm.hpp"

#include <algorithm>

#include "common/Error.hpp"

namespace tooljoint::transient {

template <class Act>
void FirstOrderForm::forStates(const Act& act) const {
  int x = 0, z = 0;
  for (auto& batch : model_->points()) {
    if (batch.states() == nullptr) continue;
    act(batch, *batch.states(), x, z);
    x += batch.states()->size();
    z += batch.states()->points() * batch.states()->rated();
  }
}

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
  x_.setZero(model.states().size());
  xDot_ = x_;
  rated_ = 0;
  int widest = 0;
  forStates([&](const PointBatch& batch, const PointStates& states, int, int) {
    rated_ += states.points() * states.rated();
    widest = std::max(widest, batch.points() * batch.width());
  });
  holds_ = rated_ < model.states().size();
  for (Vector* rows : {&rows_, &dRows_, &vRows_}) rows->setZero(widest);
  for (Vector* each : {&y_, &yDot_, &before_}) each->setZero(size());
}

void FirstOrderForm::pack(const State& state, double* y) const {
  std::copy(state.v.begin(), state.v.end(), std::copy(state.q.begin(), state.q.end(), y));
  forStates([&](auto&, const PointStates& states, int x, int z) {
    for (int p = 0; p < states.points(); ++p)
      std::copy_n(state.x.data() + x + p * states.states(), states.rated(),
                  y + 2 * n_ + z + p * states.rated());
  });
}

void FirstOrderForm::unpack(const double* y, State& state) const {
  std::copy_n(y, n_, state.q.data());
  std::copy_n(y + n_, n_, state.v.data());
  state.x = x_;
  forStates([&](auto&, const PointStates& states, int x, int z) {
    for (int p = 0; p < states.points(); ++p)
      std::copy_n(y + 2 * n_ + z + p * states.rated(), states.rated(),
                  state.x.data() + x + p * states.states());
  });
}

/// Sets the states from y; held ones are unchanged.
void FirstOrderForm::bindStates(const double* y) {
  forStates([&](auto&, const PointStates& states, int x, int z) {
    for (int p = 0; p < states.points(); ++p)
      std::copy_n(y + 2 * n_ + z + p * states.rated(), states.rated(),
                  x_.data() + x + p * states.states());
  });
}

void FirstOrderForm::complete(State& state) {
  pack(state, y_.data());
  rightHandSide(state.t, y_.data(), yDot_.data());
  state.a = yDot_.segment(n_, n_);
  state.xDot = xDot_;
}

bool FirstOrderForm::accept(State& state, double tolerance) {
  if (!holds_) return false;
  complete(state);
  before_ = yDot_;
  model_->states().accept(state.t, state.q.data(), state.v.data(), state.x.data());
  x_ = state.x;
  complete(state);
  const double size = std::max(before_.cwiseAbs().maxCoeff(), yDot_.cwiseAbs().maxCoeff());
  return !((yDot_ - before_).cwiseAbs().maxCoeff() <= tolerance * size);
}

std::string FirstOrderForm::nameOf(int position) const {
  if (position < 2 * n_) return model_->dofName(position % n_);
  std::string name;
  forStates([&](const PointBatch& batch, const PointStates& states, int, int z) {
    const int i = position - 2 * n_ - z;
    if (i < 0 || i >= states.points() * states.rated()) return;
    name = "state " + std::to_string(i % states.rated() + 1) + " of point " +
           std::to_string(i / states.rated() + 1) + " of " + batch.name();
  });
  return name;
}

/// Solvers evaluate at stages of their choice, forwards and backwards in time, so earlier
/// evaluations exclude no point.
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
  const double* load = model_->timed().load();
  for (int i = 0; i < n_; ++i) a[i] = load[i] - a[i];
  bindStates(y);
  model_->states().bind(x_.data());
  model_->addPointForces(t, q, v, a);
  mass_.solve(a);
  model_->states().rates(xDot_.data());
  forStates([&](auto&, const PointStates& states, int x, int z) {
    for (int p = 0; p < states.points(); ++p)
      std::copy_n(xDot_.data() + x + p * states.states(), states.rated(),
                  yDot + 2 * n_ + z + p * states.rated());
  });
  ++evaluations_;
}

bool FirstOrderForm::factor(double t, const double* y, double gamma) {
  touch(t, y);
  bindStates(y);
  model_->states().bindKnown(x_.data(), gamma);
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
  // right = M r_v - g K* r_q + g R' df/dz S r_z
  right_ = -gamma_ * product_;
  model_->addMass(v, right_.data());
  double* z = x + 2 * n_;
  forStates([&](const PointBatch& batch, PointStates& states, int, int begin) {
    rows_.setZero();
    states.forceOf(gamma_, z + begin, rows_.data());
    rows_ *= gamma_;
    batch.scatter(batch.everyPoint(), rows_.data(), right_.data());
  });
  newton_.solve(right_.data());
  for (int i = 0; i < n_; ++i) {
    v[i] = right_[i];
    q[i] += gamma_ * v[i];
  }
  forStates([&](const PointBatch& batch, PointStates& states, int, int begin) {
    batch.gather(batch.everyPoint(), q, dRows_.data());
    batch.gather(batch.everyPoint(), v, vRows_.data());
    states.follow(gamma_, dRows_.data(), vRows_.data(), z + begin);
  });
}

}  // namespace tooljoint::transient
