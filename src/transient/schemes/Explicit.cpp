// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/Explicit.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// A force swings if its mean over a step differs from that of both ends by this part of its
/// largest value so far, in this many consecutive steps.
constexpr double swing = 0.2;
constexpr int stepsOfASwing = 4;

}  // namespace

void ExplicitRightHandSide::bind(CompiledModel& model, const std::string& integrator,
                                 Counters& counters) {
  model_ = &model;
  counters_ = &counters;
  mass_ = linalg::BlockFactor(model.pattern());
  model.combine(1.0, 0.0, 0.0, mass_.values());
  const int bad = mass_.factor();
  if (bad >= 0)
    throw ModelError("The mass matrix is singular at " + model.pivotName(bad) +
                     ": the explicit integrator \"" + integrator +
                     "\" needs a mass on every degree of freedom. Use \"Generalized-alpha\", or "
                     "give that degree of freedom a mass.");
}

void ExplicitRightHandSide::evaluate(double t, const Vector& q, const Vector& v, const Vector& x,
                                     Vector& a, Vector& xDot) {
  ++counters_->rightHandSides;
  const int n = model_->size();
  // a = -(K q + C v), then the difference to F + R'f, then M^-1
  a.setZero();
  model_->addStiffness(q.data(), a.data());
  model_->addDamping(v.data(), a.data());
  const double* load = model_->timed().load();
  for (int i = 0; i < n; ++i) a[i] = load[i] - a[i];
  model_->states().bind(x.data());
  model_->addPointForces(t, q.data(), v.data(), a.data());
  model_->states().rates(xDot.data());
  mass_.solve(a.data());
}

void ExplicitRightHandSide::look(double t, double h, const double* q) {
  for (auto& batch : model_->points()) batch.look(t, h, q);
}

bool ExplicitRightHandSide::missed(const double* q) { return model_->addMissed(q); }

template <class Each>
void ForceSwings::forEach(const CompiledModel& model, const Each& each) {
  std::size_t next = 0;
  for (const auto& batch : model.points())
    if (!batch.law().hasWalls())
      for (int i = 0; i < batch.points() * batch.width(); ++i)
        each(seen_[next++], batch.force()[i]);
}

void ForceSwings::bind(const CompiledModel& model) {
  std::size_t coordinates = 0;
  for (const auto& batch : model.points())
    if (!batch.law().hasWalls()) coordinates += at(batch.points() * batch.width());
  seen_.assign(coordinates, {});
  forEach(model, [](Seen& seen, double force) { seen.atEnd = force; });
}

void ForceSwings::addStage(const CompiledModel& model, int stage) {
  const double weight = stage < 4 ? 1.0 / 3.0 : 1.0 / 6.0;
  forEach(model, [&](Seen& seen, double force) {
    seen.mean = (stage > 2 ? seen.mean : seen.atEnd / 6.0) + weight * force;
  });
}

void ForceSwings::endStep(const CompiledModel& model) {
  bool swings = false;
  forEach(model, [&](Seen& seen, double force) {
    const double away = seen.mean - 0.5 * (seen.atEnd + force);
    seen.largest = std::max(seen.largest, std::abs(force));
    seen.steps = std::abs(away) > swing * seen.largest ? seen.steps + 1 : 0;
    seen.atEnd = force;
    swings = swings || seen.steps >= stepsOfASwing;
  });
  ++steps_;
  if (swings) ++swinging_;
}

double ForceSwings::share(const CompiledModel& model) const {
  return steps_ > 0 ? model.cut().largest(swinging_) / steps_ : 0.0;
}

void ForceSwings::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {steps_, swinging_});
}

void ForceSwings::restore(const double*& memory) {
  steps_ = *memory++;
  swinging_ = *memory++;
}

void RungeKuttaStep::resize(const State& like) {
  for (Vector* each : {&qi_, &vi_, &vj_, &a2_, &a3_, &a4_}) each->setZero(like.q.size());
  for (Vector* each : {&xi_, &x2_, &x3_, &x4_}) each->setZero(like.x.size());
}

void RungeKuttaStep::take(ExplicitRightHandSide& rhs, const State& from, double h, State& to,
                          ForceSwings* swings) {
  const Vector &q0 = from.q, &v0 = from.v, &a0 = from.a, &x0 = from.x, &x1 = from.xDot;
  const double t = from.t;
  // k1 = (v0, a0, x1); q += h/6 (k1 + 2 k2 + 2 k3 + k4), accumulated in q and v stage by stage
  qi_ = q0 + 0.5 * h * v0;
  vi_ = v0 + 0.5 * h * a0;
  xi_ = x0 + 0.5 * h * x1;
  rhs.stage(t + 0.5 * h, t, h, qi_, vi_, xi_, a2_, x2_);
  if (swings != nullptr) swings->addStage(rhs.model(), 2);
  to.q = v0 + 2.0 * vi_;
  qi_ = q0 + 0.5 * h * vi_;
  vj_ = v0 + 0.5 * h * a2_;
  xi_ = x0 + 0.5 * h * x2_;
  rhs.stage(t + 0.5 * h, t, h, qi_, vj_, xi_, a3_, x3_);
  if (swings != nullptr) swings->addStage(rhs.model(), 3);
  to.q += 2.0 * vj_;
  qi_ = q0 + h * vj_;
  vi_ = v0 + h * a3_;
  xi_ = x0 + h * x3_;
  rhs.stage(t + h, t, h, qi_, vi_, xi_, a4_, x4_);
  if (swings != nullptr) swings->addStage(rhs.model(), 4);
  to.q += vi_;
  to.q = q0 + h / 6.0 * to.q;
  to.v = v0 + h / 6.0 * (a0 + 2.0 * a2_ + 2.0 * a3_ + a4_);
  to.x = x0 + h / 6.0 * (x1 + 2.0 * x2_ + 2.0 * x3_ + x4_);
}

}  // namespace tooljoint::transient
