// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/NewtonIteration.hpp"

#include <algorithm>
#include <cmath>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void NewtonIteration::bind(const StepParts& parts) {
  parts_ = parts;
  nodal_.bind(*parts.model, *parts.strategies);
  for (Vector* x : {&delta_, &change_, &base_, &otherDelta_, &otherChange_, &start_.q, &start_.v,
                    &start_.a, &start_.linear})
    x->setZero(parts.model->size());
}

bool NewtonIteration::solve(State& to, const StepScheme& scheme, Counters& counters) {
  scheme_ = &scheme;
  counters_ = &counters;
  StepEquations& equations = *parts_.equations;
  equations.measure(to);
  fresh_ = false;
  rescues_ = 0;
  int stalled = 0;
  for (int iteration = 0;; ++iteration) {
    if (equations.converged()) {
      if (!parts_.model->addMissed(to.q.data(), to.t)) return true;
      equations.measure(to);
      if (equations.converged()) return true;
    }
    if (!std::isfinite(equations.merit()) || iteration >= parts_.maxIterations) return false;
    if (!parts_.factor->isOf(scheme) || (parts_.factor->isWanted() && !fresh_)) {
      fresh_ = true;
      if (!parts_.factor->renew(scheme, to, counters)) return false;
    }
    delta_ = -equations.residual();
    parts_.factor->factor().solve(delta_.data());
    ++counters.newtonIterations;
    const double before = equations.merit();
    if (!backtrack(to)) {
      if (fresh_) return false;  // the exact Newton direction does not help
      parts_.factor->want();
      continue;
    }
    stalled = equations.merit() > Tuned::progress * before ? stalled + 1 : 0;
    if (stalled > Tuned::mostIdle) return false;
    if (isSlow(equations.merit() / before)) parts_.factor->want();
    fresh_ = false;
  }
}

/// Whether a new factor is cheaper than continuing at this rate of convergence.
bool NewtonIteration::isSlow(double rate) const {
  if (rate >= Tuned::slowestRate) return true;
  const double left = parts_.equations->error() / parts_.equations->tolerance();
  return left > 1 && std::log(left) > -std::log(rate) * Tuned::patience;
}

/// change_ = (ca M + cv C + K) delta for the solution of S delta = -R + force: -R + force + R'P R
/// delta, corrected for changes of C and K by the laws since S was built.
void NewtonIteration::findChange() {
  change_ -= parts_.equations->residual();
  for (const auto& batch : parts_.model->points())
    batch.addTangentTimes(delta_.data(), change_.data());
  if (parts_.factor->matrix().hasDrifted())
    parts_.factor->matrix().addDrift(*scheme_, delta_, change_);
}

/// Takes the step delta_, halved until the scaled residual decreases. False if it does not.
bool NewtonIteration::backtrack(State& to) {
  change_.setZero();
  findChange();
  start_.q = to.q, start_.v = to.v, start_.a = to.a, start_.linear = parts_.equations->linear();
  const double before = parts_.equations->merit();
  double fraction = 1;
  for (int cut = 0; cut < Tuned::mostTries; ++cut, fraction *= 0.5) {
    place(to, fraction);
    if (parts_.equations->converged() ||
        parts_.equations->merit() <= (1 - Tuned::decrease * fraction) * before)
      return true;
  }
  // each rank knows only its own points
  if (fresh_ && !parts_.model->cut().isDivided() && rescues_++ < Tuned::patience &&
      parts_.strategies->use(Strategy::TroubledPoints) && solveTroubledPoints(to, before))
    return true;
  place(to, 0);
  return false;
}

/// Solves the points that spoil the Newton step with their nonlinear laws. False, with the iterate
/// and its step restored, if that does not help.
bool NewtonIteration::solveTroubledPoints(State& to, double before) {
  otherDelta_ = delta_, otherChange_ = change_;
  place(to, 0);
  base_ = parts_.equations->residual();
  nodal_.begin();
  place(to, 1);
  bool good = false;
  for (int attempt = 0; attempt < Tuned::patience && !good &&
                        nodal_.addTroubled(delta_.data(), parts_.equations->weight().data());
       ++attempt) {
    if (!parts_.factor->rebuild(*counters_) ||
        !nodal_.solve(to.t, scheme_->velocity, parts_.factor->factor(), base_, delta_, change_))
      break;
    ++counters_->newtonIterations;
    parts_.equations->residual() = base_;
    findChange();
    place(to, 1);
    good = parts_.equations->converged() || parts_.equations->merit() <= Tuned::progress * before;
  }
  parts_.factor->spoil();
  if (!good) delta_ = otherDelta_, change_ = otherChange_;
  return good;
}

/// Sets and evaluates the iterate at a fraction of delta from the start of the line search.
void NewtonIteration::place(State& to, double fraction) {
  to.q = start_.q + fraction * delta_;
  to.v = start_.v + fraction * scheme_->velocity * delta_;
  to.a = start_.a + fraction * scheme_->acceleration * delta_;
  parts_.equations->linear() = start_.linear + fraction * change_;
  parts_.equations->measure(to);
}

}  // namespace tooljoint::transient
