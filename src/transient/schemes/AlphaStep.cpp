// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/AlphaStep.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/report/Log.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
AlphaStep::AlphaStep(const Parameters& parameters) : parameters_(parameters) {
  const double r = parameters.radius;
  alphaM_ = (2 * r - 1) / (r + 1);
  alphaF_ = r / (r + 1);
  gamma_ = 0.5 - alphaM_ + alphaF_;
  beta_ = 0.25 * (1 + alphaF_ - alphaM_) * (1 + alphaF_ - alphaM_);
  if (parameters.phaseCorrection) setPhaseCorrection();
}

/// Vibration of frequency w is too slow by e (w h)^2, where e is the mean of the two local errors
/// of the scheme,
///
///     v: g/2 + g d + k - 1/6,   q: d/2 + b - 1/6,   d = am - af,   k = (af - am)(1/2 - am).
///
/// A mass that is smaller by 2 e (w h)^2 makes up for it: M - k M (I - F), F = s ca (s ca M + K)^-1
/// M, is that for low frequencies, (1 - k) M for high ones, symmetric and positive between, so that
/// the scheme stays unconditionally stable; what is at rest stays where it is. s keeps k at
/// Tuned::mostPhase or below.
void AlphaStep::setPhaseCorrection() {
  const double d = alphaM_ - alphaF_;
  const double ofVelocity =
      gamma_ / 2 + gamma_ * d + (alphaF_ - alphaM_) * (0.5 - alphaM_) - 1.0 / 6;
  const double ofDisplacement = d / 2 + beta_ - 1.0 / 6;
  const double ca = (1 - alphaM_) / ((1 - alphaF_) * beta_);  // times h^2
  const double whole = (ofVelocity + ofDisplacement) * ca;
  filter_ = std::min(1.0, Tuned::mostPhase / whole);
  phase_ = filter_ * whole;
}

StepScheme AlphaStep::scheme(double h) const {
  const double ca = (1 - alphaM_) / ((1 - alphaF_) * beta_ * h * h);
  const bool rests =
      mass_->regular() && !holds(parameters_.equations.without, Strategy::RestingImpacts);
  return {h, gamma_ / (beta_ * h), ca, filter_, phase_, rests ? 0.5 * h * h * ca : 1.0};
}

/// M q''_0 = F + R'f - C v - K q; dofs without mass start without acceleration.
void AlphaStep::start(CompiledModel& model, State& state, Counters& counters) {
  model_ = &model;
  const int n = model.size();
  for (auto& batch : model.points()) batch.look(state.t, 0.0, state.q.data());
  state.a.setZero();
  model.addStiffness(state.q.data(), state.a.data());
  model.addDamping(state.v.data(), state.a.data());
  state.a = -state.a;
  for (int i = 0; i < n; ++i) state.a[i] += model.load()[i];
  model.bindStates(state.x.data());
  model.addPointForces(state.t, state.q.data(), state.v.data(), state.a.data());
  mass_ = std::make_shared<MassFactor>(model);
  ++counters.factorisations;
  if (mass_->regular()) {
    mass_->solve(state.a);
  } else {
    log::warn("The mass matrix is singular at " + model.pivotName(mass_->singularAt()) +
              " although there is mass on it: the motion starts without acceleration, with an "
              "error of first order in the step.");
    state.a.setZero();
  }
  equation_.bind(model, parameters_.equations);
  model.stateRates(state.xDot.data());
  X_ = nextX_ = base_ = state.xDot;
  bind(state.a);
}

void AlphaStep::startLike(const AlphaStep& other) {
  model_ = other.model_;
  mass_ = other.mass_;
  equation_.bind(*model_, parameters_.equations);
  X_ = nextX_ = base_ = other.X_;
  bind(other.A_);
}

void AlphaStep::bind(const Vector& a) {
  A_ = nextA_ = error_ = work_ = a;
  for (Impacts* impacts : {&impacts_, &lastImpacts_}) {
    impacts->a.setZero(a.size());
    impacts->blocks.clear();
    impacts->blocks.reserve(4 * static_cast<std::size_t>(model_->pattern().blocks()));
  }
}

void AlphaStep::clear(Impacts& impacts) const {
  const auto& pattern = model_->pattern();
  for (int b : impacts.blocks) impacts.a.segment(pattern.start(b), pattern.width(b)).setZero();
  impacts.blocks.clear();
}

void AlphaStep::addImpacts(double factor, const Impacts& impacts, Vector& y) const {
  const auto& pattern = model_->pattern();
  for (int b : impacts.blocks)
    y.segment(pattern.start(b), pattern.width(b)) +=
        factor * impacts.a.segment(pattern.start(b), pattern.width(b));
}

/// v from constant algorithmic acceleration; q and a where v is 0. What impacts have added to q''
/// is no part of it.
void AlphaStep::predict(const State& from, State& to, double h) {
  for (auto& batch : model_->points()) batch.look(from.t, h, from.q.data());
  const StepScheme s = scheme(h);
  const double half = 0.5 * h * h, c = 1 / (1 - alphaF_), perVelocity = 1 / s.velocity,
               ofVelocity = s.acceleration / s.velocity;
  for (const auto& run : model_->runs()) {
    const int begin = model_->pattern().start(run.begin),
              length = model_->pattern().start(run.end) - begin;
    const auto part = [begin, length](auto& x) { return x.segment(begin, length); };
    part(to.v) = part(from.v) + h * part(A_);
    part(to.q) = part(from.q) + h * part(from.v) + half * part(A_) - perVelocity * part(to.v);
    part(to.a) = c * (part(A_) - alphaF_ * part(from.a)) - ofVelocity * part(to.v);
  }
  addImpacts(c * alphaF_ / s.impact, lastImpacts_, to.a);
  if (model_->stateSize() > 0) bindStates(from, h);
}

/// x_{n+1} = x_n + h ((1 - g) X_n + g (af x'_n - am X_n) / (1 - am)) + h g (1 - af) / (1 - am)
/// x'_{n+1}
void AlphaStep::bindStates(const State& from, double h) {
  base_ = from.x +
          h * ((1 - gamma_) * X_ + gamma_ / (1 - alphaM_) * (alphaF_ * from.xDot - alphaM_ * X_));
  model_->bindStates(base_.data(), h * gamma_ * (1 - alphaF_) / (1 - alphaM_));
}

/// nextX_ = X_{n+1}, as nextA_ in complete().
void AlphaStep::completeStates(const State& from, State& to) {
  model_->completeStates(to.t, to.q.data(), to.v.data(), to.x.data(), to.xDot.data());
  nextX_ = ((1 - alphaF_) * to.xDot + alphaF_ * from.xDot - alphaM_ * X_) / (1 - alphaM_);
}

bool AlphaStep::take(const State& from, State& to, double h, bool anyway, Counters& counters) {
  predict(from, to, h);
  if (!equation_.solve(to, scheme(h), counters)) {
    if (!anyway || !equation_.isFinite()) return false;
    ++counters.unconvergedSteps;
  }
  complete(from, to, h);
  return true;
}

/// nextA_ = A_{n+1} = ((1 - af) q''_{n+1} + af q''_n - am A_n) / (1 - am), impacts left out of q''.
void AlphaStep::complete(const State& from, State& to, double h) {
  const double now = (1 - alphaF_) / (1 - alphaM_), before = alphaF_ / (1 - alphaM_),
               last = alphaM_ / (1 - alphaM_);
  const double s = scheme(h).impact;
  findImpacts();
  if (model_->stateSize() > 0) completeStates(from, to);
  nextA_ = now * to.a + before * from.a - last * A_;
  addImpacts(-now, impacts_, nextA_);
  addImpacts(-before / s, lastImpacts_, nextA_);
  addImpacts(1 / s - 1, impacts_, to.a);
}

/// From the forces in the batches, which are multiplied by the scheme's factor.
void AlphaStep::findImpacts() {
  clear(impacts_);
  for (const auto& batch : model_->points())
    if (batch.isScaled()) batch.addScaledForce(impacts_.a.data(), impacts_.blocks);
  if (model_->cut().any(!impacts_.blocks.empty()))
    mass_->solveNear(impacts_.a, impacts_.blocks, Tuned::rounding);
}

void AlphaStep::keep() {
  A_.swap(nextA_);
  X_.swap(nextX_);
  std::swap(impacts_, lastImpacts_);
}

void AlphaStep::saveHistory(std::vector<double>& history) const {
  for (const Vector* x : {&A_, &X_, &lastImpacts_.a})
    history.insert(history.end(), x->begin(), x->end());
}

/// A is q'' at another time, which is off by a part of the step. While q rests on a wall, impacts
/// left out of A, the scheme has v = (g/(2 b) - 1)/2 h M^-1 R'f, which vanishes for r = 1.
void AlphaStep::startAgain(const double*& history, double h, State& from) {
  for (Vector* vector : {&A_, &X_, &lastImpacts_.a})
    for (double& x : *vector) x = *history++;
  listBlocks(lastImpacts_);
  const double s = scheme(h).impact;
  A_ = 0.5 * (A_ + from.a);
  addImpacts(-0.5 / s, lastImpacts_, A_);
  X_ = 0.5 * (X_ + from.xDot);
  addImpacts(-0.5 * (gamma_ / (2 * beta_) - 1) * h / s, lastImpacts_, from.v);
}

const Vector& AlphaStep::localError(double h, bool impacts) {
  error_ = ((alphaM_ - alphaF_) / 2 + beta_ - 1.0 / 6) * h * h * (nextA_ - A_);
  if (impacts)
    addImpacts(1.0 / scheme(h).acceleration, impacts_, error_);  // h^2/2 M^-1 R'f, see complete()
  return error_;
}

/// With the mean x and the change Dx of a step, the formulas of Newmark for A give
///
///     D(v'M v/2 + h^2 (b - g/2) A'M A / 2) = Dq'M q'' - e,
///     e = -Dq'M (A - q'' + (g - 1/2) DA) + h^2 (b - g/2) (g - 1/2) DA'M DA
///
/// of which the first term on the right is the work of all forces. A product of two vectors is
/// x'M y = ((x + y)'M (x + y) - (x - y)'M (x - y)) / 4.
double AlphaStep::dissipated(const State& from, const State& to, double h) const {
  if (model_->cut().any(!impacts_.blocks.empty() || !lastImpacts_.blocks.empty())) return 0.0;
  const Vector &A = A_, &before = nextA_;  // swapped by keep()
  const double square = h * h;
  const auto lag = 0.5 * (A + before - to.a - from.a) + (gamma_ - 0.5) * (A - before);
  work_ = to.q - from.q + square * lag;
  const double sum = model_->massForm(work_.data());
  work_ = to.q - from.q - square * lag;
  const double difference = model_->massForm(work_.data());
  work_ = A - before;
  return (difference - sum) / (4 * square) +
         square * (beta_ - 0.5 * gamma_) * (gamma_ - 0.5) * model_->massForm(work_.data());
}

void AlphaStep::save(std::vector<double>& memory) const {
  saveHistory(memory);
  equation_.save(memory);
}

void AlphaStep::restore(const double*& memory) {
  for (Vector* vector : {&A_, &X_, &lastImpacts_.a})
    for (double& x : *vector) x = *memory++;
  listBlocks(lastImpacts_);
  equation_.restore(memory);
}

bool AlphaStep::restsOnImpacts() const {
  return model_->cut().any(!impacts_.blocks.empty() && !lastImpacts_.blocks.empty());
}

void AlphaStep::listBlocks(Impacts& impacts) const {
  impacts.blocks.clear();
  const auto& pattern = model_->pattern();
  for (int b = 0; b < pattern.blocks(); ++b)
    if (!impacts.a.segment(pattern.start(b), pattern.width(b)).isZero(0.0))
      impacts.blocks.push_back(b);
}

}  // namespace tooljoint::transient
