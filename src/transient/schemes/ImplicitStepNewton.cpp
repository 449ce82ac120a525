// SPDX-License-Identifier: BSD-3-Clause
// The slow and safe way through an implicit step: modified Newton with line
// search.
#include <algorithm>
#include <cmath>

#include "transient/Tuned.hpp"
#include "transient/schemes/ImplicitStep.hpp"

namespace tooljoint::transient {
/// Residual and its scaled size at the iterate.
double ImplicitStep::measure(const State& to) {
  scratch_.setZero();
  for (auto& batch : model_->points()) {
    batch.evaluate(to.t, to.q.data(), to.v.data());
    batch.addForce(1.0, scratch_.data());
  }
  residual_ = linear_ - scratch_;
  const int n = model_->size(), interior = model_->cut().interior(n);
  double largest[2] = {0, linearReference_}, square = 0;
  const auto look = [&](int i, double residual, double force, bool counts) {
    const double scaled = weight_[i] * residual;
    largest[0] = std::max(largest[0], std::abs(scaled));
    largest[1] = std::max(largest[1], std::abs(weight_[i] * force));
    if (counts) square += scaled * scaled;
  };
  for (int i = 0; i < interior; ++i) look(i, residual_[i], scratch_[i], true);
  if (model_->cut().isDivided()) {
    atCut_ = residual_.tail(n - interior);
    model_->cut().completeCut(atCut_.data());
    model_->cut().complete(scratch_.data());
    for (int i = interior; i < n; ++i)
      look(i, atCut_[i - interior], scratch_[i], model_->cut().owns(i));
    model_->cut().reduce(largest, 2, &square, 1);
  }
  error_ = std::isfinite(square) ? largest[0] : square;
  merit_ = std::sqrt(square);
  reference_ = largest[1];
  return merit_;
}

/// Whether a new factor is cheaper than going on at this rate of convergence.
bool ImplicitStep::isSlow(double rate) const {
  if (rate >= Tuned::slowestRate) return true;
  const double left = error_ / tolerance();
  return left > 1 && std::log(left) > -std::log(rate) * Tuned::patience;
}

/// change_ = (c0 M + c1 C + K) delta for the solution of S delta = -R + force:
/// -R + force + R'P R delta, corrected by what the laws have changed in C and K
/// since S was built.
void ImplicitStep::findChange() {
  change_ -= residual_;
  for (const auto& batch : model_->points()) batch.addTangentTimes(delta_.data(), change_.data());
  if (matrix_.hasDrifted()) matrix_.addDrift(scheme_, delta_, change_);
}

/// Take the step delta_, halving it until the scaled residual falls. False when
/// it does not.
bool ImplicitStep::backtrack(State& to) {
  change_.setZero();
  findChange();
  q0_ = to.q, v0_ = to.v, a0_ = to.a, linear0_ = linear_;
  const double before = merit_;
  double fraction = 1;
  for (int cut = 0; cut < Tuned::mostTries; ++cut, fraction *= 0.5) {
    place(to, fraction);
    if (converged() || merit_ <= (1 - Tuned::decrease * fraction) * before) return true;
  }
  // the points of one rank alone know nothing of those of others
  if (fresh_ && !model_->cut().isDivided() && rescues_++ < Tuned::patience &&
      strategies_.use(Strategy::TroubledPoints) && solveTroubledPoints(to, before))
    return true;
  place(to, 0);
  return false;
}

/// The points that spoil the Newton step are solved as what they are. False,
/// with the iterate and its step restored, when that does not help.
bool ImplicitStep::solveTroubledPoints(State& to, double before) {
  saved_ = delta_, savedChange_ = change_;
  place(to, 0);
  base_ = residual_;
  nodal_.begin();
  place(to, 1);
  bool good = false;
  for (int attempt = 0;
       attempt < Tuned::patience && !good && nodal_.addTroubled(delta_.data(), weight_.data());
       ++attempt) {
    matrix_.rebuild();
    finishFactor();
    ++counters_->factorisations;
    if (!matrix_.isFactored() ||
        !nodal_.solve(to.t, scheme_.velocity, matrix_.factor(), base_, delta_, change_))
      break;
    ++counters_->newtonIterations;
    residual_ = base_;
    findChange();
    place(to, 1);
    good = converged() || merit_ <= Tuned::progress * before;
  }
  wanted_ = true;  // the factor lacks tangents now
  matrix_.spoil();
  if (!good) delta_ = saved_, change_ = savedChange_;
  return good;
}

/// The iterate at a fraction of delta from where the line search began,
/// measured.
void ImplicitStep::place(State& to, double fraction) {
  to.q = q0_ + fraction * delta_;
  to.v = v0_ + fraction * scheme_.velocity * delta_;
  to.a = a0_ + fraction * scheme_.acceleration * delta_;
  linear_ = linear0_ + fraction * change_;
  measure(to);
}

/// Newton iterations from the predicted state; false on failure.
bool ImplicitStep::iterate(State& to) {
  measure(to);
  fresh_ = false;
  rescues_ = 0;
  int stalled = 0;
  for (int iteration = 0;; ++iteration) {
    if (converged()) {
      bool missed = false;
      for (auto& batch : model_->points()) missed = batch.addMissed(to.q.data(), to.t) || missed;
      if (!model_->cut().any(missed)) return true;
      measure(to);
      if (converged()) return true;
    }
    if (!std::isfinite(merit_) || iteration >= options_.maxIterations) return false;
    if (!matrix_.isOf(scheme_) || (wanted_ && !fresh_)) {
      refactor(to);
      if (!matrix_.isFactored()) return false;
    }
    delta_ = -residual_;
    matrix_.factor().solve(delta_.data());
    ++counters_->newtonIterations;
    const double before = merit_;
    const bool accepted = backtrack(to);
    if (!accepted) {
      if (fresh_) return false;  // the exact Newton direction does not help
      wanted_ = true;
      continue;
    }
    stalled = merit_ > Tuned::progress * before ? stalled + 1 : 0;
    if (stalled > Tuned::mostIdle) return false;
    wanted_ = wanted_ || isSlow(merit_ / before);
    fresh_ = false;
  }
}

}  // namespace tooljoint::transient
