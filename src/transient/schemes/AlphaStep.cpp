// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/AlphaStep.hpp"

#include <utility>

#include "common/report/Log.hpp"
#include "transient/schemes/MasslessStart.hpp"

namespace tooljoint::transient {

AlphaStep::AlphaStep(const Parameters& parameters)
    : parameters_(parameters), alpha_(parameters.radius, parameters.phaseCorrection) {}

StepScheme AlphaStep::scheme(double h) const {
  return alpha_.scheme(
      h, mass_->regular() && !holds(parameters_.equations.without, Strategy::RestingImpacts));
}

/// M q''_0 = F + R'f - C v - K q; massless dofs start in balance and without acceleration.
void AlphaStep::start(CompiledModel& model, double h, State& state, Counters& counters) {
  model_ = &model;
  const int n = model.size();
  model.timed().setStart(state.t, h);
  mass_ = std::make_shared<MassFactor>(model);
  ++counters.factorisations;
  model.states().bind(state.x.data());
  balanceMassless(model, *mass_, h, state);
  for (auto& batch : model.points()) batch.look(state.t, 0.0, state.q.data());
  state.a.setZero();
  model.addStiffness(state.q.data(), state.a.data());
  model.addDamping(state.v.data(), state.a.data());
  state.a = -state.a;
  for (int i = 0; i < n; ++i) state.a[i] += model.timed().load()[i];
  model.addPointForces(state.t, state.q.data(), state.v.data(), state.a.data());
  if (mass_->regular()) {
    mass_->solve(state.a);
  } else if (!solveSingularMass(model, *mass_, state)) {
    log::warn("The mass matrix is singular at " + model.pivotName(mass_->singularAt()) +
              " although there is mass on it: the motion starts in balance, but without "
              "acceleration, with an error of first order in the step.");
    state.a.setZero();
  }
  equation_.bind(model, parameters_.equations);
  model.states().rates(state.xDot.data());
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
  impacts_.bind(*model_);
  lastImpacts_.bind(*model_);
}

/// v from constant algorithmic acceleration; q and a for v = 0. Contributions of impacts to q'' are
/// excluded.
void AlphaStep::predict(const State& from, State& to, double h) {
  for (auto& batch : model_->points()) batch.look(from.t, h, from.q.data());
  const StepScheme s = scheme(h);
  const double half = 0.5 * h * h, c = 1 / (1 - alpha_.f), perVelocity = 1 / s.velocity,
               ofVelocity = s.acceleration / s.velocity;
  for (const auto& run : model_->runs()) {
    const int begin = model_->pattern().start(run.begin),
              length = model_->pattern().start(run.end) - begin;
    const auto part = [begin, length](auto& x) { return x.segment(begin, length); };
    part(to.v) = part(from.v) + h * part(A_);
    part(to.q) = part(from.q) + h * part(from.v) + half * part(A_) - perVelocity * part(to.v);
    part(to.a) = c * (part(A_) - alpha_.f * part(from.a)) - ofVelocity * part(to.v);
  }
  lastImpacts_.add(c * alpha_.f / s.impact, to.a);
  if (model_->states().size() > 0) bindStates(from, h);
}

/// x_{n+1} = x_n + h ((1 - g) X_n + g (af x'_n - am X_n) / (1 - am)) + h g (1 - af) / (1 - am)
/// x'_{n+1}
void AlphaStep::bindStates(const State& from, double h) {
  base_ = from.x + h * ((1 - alpha_.gamma) * X_ +
                        alpha_.gamma / (1 - alpha_.m) * (alpha_.f * from.xDot - alpha_.m * X_));
  model_->states().bind(base_.data(), h * alpha_.gamma * (1 - alpha_.f) / (1 - alpha_.m));
}

/// nextX_ = X_{n+1}, like nextA_ in complete().
void AlphaStep::completeStates(const State& from, State& to) {
  model_->states().complete(to.t, to.q.data(), to.v.data(), to.x.data(), to.xDot.data());
  nextX_ = ((1 - alpha_.f) * to.xDot + alpha_.f * from.xDot - alpha_.m * X_) / (1 - alpha_.m);
}

bool AlphaStep::take(const State& from, State& to, double h, bool anyway, Counters& counters) {
  predict(from, to, h);
  if (!equation_.solve(from.t, to, scheme(h), counters)) {
    if (!anyway || !equation_.isFinite()) return false;
    ++counters.unconvergedSteps;
  }
  complete(from, to, h);
  return true;
}

/// nextA_ = A_{n+1} = ((1 - af) q''_{n+1} + af q''_n - am A_n) / (1 - am), without impacts in q''.
void AlphaStep::complete(const State& from, State& to, double h) {
  const double now = (1 - alpha_.f) / (1 - alpha_.m), before = alpha_.f / (1 - alpha_.m),
               last = alpha_.m / (1 - alpha_.m);
  const double s = scheme(h).impact;
  impacts_.find(*model_, *mass_);
  if (model_->states().size() > 0) completeStates(from, to);
  nextA_ = now * to.a + before * from.a - last * A_;
  impacts_.add(-now, nextA_);
  lastImpacts_.add(-before / s, nextA_);
  impacts_.add(1 / s - 1, to.a);
}

void AlphaStep::keep() {
  A_.swap(nextA_);
  X_.swap(nextX_);
  std::swap(impacts_, lastImpacts_);
}

void AlphaStep::saveHistory(std::vector<double>& history) const {
  for (const Vector* x : {&A_, &X_}) history.insert(history.end(), x->begin(), x->end());
  lastImpacts_.save(history);
}

void AlphaStep::restoreHistory(const double*& history) {
  for (Vector* vector : {&A_, &X_})
    for (double& x : *vector) x = *history++;
  lastImpacts_.restore(history);
}

/// A is q'' at a time that differs by a part of the step. While q rests on a wall, with impacts
/// excluded from A, the scheme has v = (g/(2 b) - 1)/2 h M^-1 R'f, which is zero for r = 1.
void AlphaStep::startAgain(const double*& history, double h, State& from) {
  restoreHistory(history);
  const double s = scheme(h).impact;
  A_ = 0.5 * (A_ + from.a);
  lastImpacts_.add(-0.5 / s, A_);
  X_ = 0.5 * (X_ + from.xDot);
  lastImpacts_.add(-0.5 * (alpha_.gamma / (2 * alpha_.beta) - 1) * h / s, from.v);
}

const Vector& AlphaStep::localError(double h, bool impacts) {
  error_ = alpha_.localError() * h * h * (nextA_ - A_);
  if (impacts)
    impacts_.add(1.0 / scheme(h).acceleration, error_);  // h^2/2 M^-1 R'f, see complete()
  return error_;
}

/// With the mean x and the change Dx of a step, the formulas of Newmark for A give
///
///     D(v'M v/2 + h^2 (b - g/2) A'M A / 2) = Dq'M q'' - e,
///     e = -Dq'M (A - q'' + (g - 1/2) DA) + h^2 (b - g/2) (g - 1/2) DA'M DA
///
/// where the first term on the right is the work of all forces. The product of two vectors is x'M y
/// = ((x + y)'M (x + y) - (x - y)'M (x - y)) / 4.
double AlphaStep::dissipated(const State& from, const State& to, double h) const {
  if (model_->cut().any(!impacts_.none() || !lastImpacts_.none())) return 0.0;
  const Vector &A = A_, &before = nextA_;  // keep() has swapped them
  const double square = h * h;
  const auto lag = 0.5 * (A + before - to.a - from.a) + (alpha_.gamma - 0.5) * (A - before);
  work_ = to.q - from.q + square * lag;
  const double sum = model_->massForm(work_.data());
  work_ = to.q - from.q - square * lag;
  const double difference = model_->massForm(work_.data());
  work_ = A - before;
  return (difference - sum) / (4 * square) + square * (alpha_.beta - 0.5 * alpha_.gamma) *
                                                 (alpha_.gamma - 0.5) *
                                                 model_->massForm(work_.data());
}

void AlphaStep::carry(CarriedMemory& memory) const {
  std::vector<double> impacts;
  lastImpacts_.save(impacts);
  memory.vectors.push_back(A_);
  memory.vectors.emplace_back(Eigen::Map<const Vector>(impacts.data(), A_.size()));
  Vector X = X_;
  model_->states().join(X);
  memory.numbers.insert(memory.numbers.end(), X.begin(), X.end());
}

void AlphaStep::takeUp(const std::vector<Vector>& vectors, const double*& numbers) {
  for (double& x : X_) x = *numbers++;
  model_->states().keepOwn(X_);
  A_ = vectors[0];
  const double* impacts = vectors[1].data();
  lastImpacts_.restore(impacts);
}

void AlphaStep::save(std::vector<double>& memory) const {
  saveHistory(memory);
  equation_.save(memory);
}

void AlphaStep::restore(const double*& memory) {
  restoreHistory(memory);
  equation_.restore(memory);
}

bool AlphaStep::restsOnImpacts() const {
  return model_->cut().any(!impacts_.none() && !lastImpacts_.none());
}

}  // namespace tooljoint::transient
