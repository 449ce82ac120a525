// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/NewtonIteration.hpp"

#include <algorithm>
#include <cmath>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void NewtonIteration::bind(CompiledModel& model, StepEquations& equations, StepFactor& factor,
                           Strategies& strategies, int maxIterations) {
  model_ = &model;
  equations_ = &equations;
  factor_ = &factor;
  strategies_ = &strategies;
  maxIterations_ = maxIterations;
  nodal_.bind(model, strategies);
  for (Vector* x : {&delta_, &change_, &base_, &otherDelta_, &otherChange_, &start_.q, &start_.v,
                    &start_.a, &start_.linear})
    x->setZero(model.size());
}

bool NewtonIteration::solve(State& to, const StepScheme& scheme, Counters& counters) {
  scheme_ = &scheme;
  counters_ = &counters;
  StepEquations& equations = *equations_;
  equations.measure(to);
  fresh_ = false;
  rescues_ = 0;
  int stalled = 0;
  for (int iteration = 0;; ++iteration) {
    if (equations.converged()) {
      if (!model_->addMissed(to.q.data(), to.t)) return true;
      equations.measure(to);
      if (equations.converged()) return true;
    }
    if (!std::isfinite(equations.merit()) || iteration >= maxIterations_) return false;
    if (!factor_->isOf(scheme) || (factor_->isWanted() && !fresh_)) {
      fresh_ = true;
      if (!factor_->renew(scheme, to, counters)) return false;
    }
    delta_ = -equations.residual();
    factor_->factor().solve(delta_.data());
    ++counters.newtonIterations;
    const double before = equations.merit();
    if (!backtrack(to)) {
      if (fresh_) return false;  // the exact Newton direction does not help
      factor_->want();
      continue;
    }
    stalled = equations.merit() > Tuned::progress * before ? stalled + 1 : 0;
    if (stalled > Tuned::mostIdle) return false;
    if (isSlow(equations.merit() / before)) factor_->want();
    fresh_ = false;
  }
}

/// Whether a new factor is cheaper than going on at this rate of convergence.
bool NewtonIteration::isSlow(double rate) const {
  if (rate >= Tuned::slowestRate) return true;
  const double left = equations_->error() / equations_->tolerance();
  return left > 1 && std::log(left) > -std::log(rate) * Tuned::patience;
}

/// change_ = (c0 M + c1 C + K) delta for the solution of S delta = -R + force:
/// -R + force + R'P R delta, corrected by what the laws have changed in C and K since S was built.
void NewtonIteration::findChange() {
  change_ -= equations_->residual();
  for (const auto& batch : model_->points()) batch.addTangentTimes(delta_.data(), change_.data());
  if (factor_->matrix().hasDrifted()) factor_->matrix().addDrift(*scheme_, delta_, change_);
}

/// Take the step delta_, halving it until the scaled residual falls. False when it does not.
bool NewtonIteration::backtrack(State& to) {
  change_.setZero();
  findChange();
  start_.q = to.q, start_.v = to.v, start_.a = to.a, start_.linear = equations_->linear();
  const double before = equations_->merit();
  double fraction = 1;
  for (int cut = 0; cut < Tuned::mostTries; ++cut, fraction *= 0.5) {
    place(to, fraction);
    if (equations_->converged() || equations_->merit() <= (1 - Tuned::decrease * fraction) * before)
      return true;
  }
  // the points of one rank alone know nothing of those of others
  if (fresh_ && !model_->cut().isDivided() && rescues_++ < Tuned::patience &&
      strategies_->use(Strategy::TroubledPoints) && solveTroubledPoints(to, before))
    return true;
  place(to, 0);
  return false;
}

/// The points that spoil the Newton step are solved as what they are. False, with the iterate and
/// its step restored, when that does not help.
bool NewtonIteration::solveTroubledPoints(State& to, double before) {
  otherDelta_ = delta_, otherChange_ = change_;
  place(to, 0);
  base_ = equations_->residual();
  nodal_.begin();
  place(to, 1);
  bool good = false;
  for (int attempt = 0; attempt < Tuned::patience && !good &&
                        nodal_.addTroubled(delta_.data(), equations_->weight().data());
       ++attempt) {
    if (!factor_->rebuild(*counters_) ||
        !nodal_.solve(to.t, scheme_->velocity, factor_->factor(), base_, delta_, change_))
      break;
    ++counters_->newtonIterations;
    equations_->residual() = base_;
    findChange();
    place(to, 1);
    good = equations_->converged() || equations_->merit() <= Tuned::progress * before;
  }
  factor_->spoil();
  if (!good) delta_ = otherDelta_, change_ = otherChange_;
  return good;
}

/// The iterate at a fraction of delta from where the line search began, measured.
void NewtonIteration::place(State& to, double fraction) {
  to.q = start_.q + fraction * delta_;
  to.v = start_.v + fraction * scheme_->velocity * delta_;
  to.a = start_.a + fraction * scheme_->acceleration * delta_;
  equations_->linear() = start_.linear + fraction * change_;
  equations_->measure(to);
}

}  // namespace tooljoint::transient
