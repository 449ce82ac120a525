// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/ImplicitStep.hpp"

namespace tooljoint::transient {

void ImplicitStep::bind(CompiledModel& model, const Options& options) {
  model_ = &model;
  predicted_.resize(model.size(), model.states().size());
  strategies_.leaveOut(options.without);
  equations_.bind(model, options.tolerance);
  factor_.bind(model);
  const StepParts parts{&model, &equations_, &factor_, &strategies_, options.maxIterations};
  relaxation_.bind(parts);
  newton_.bind(parts);
}

void ImplicitStep::prepare(const StepScheme& scheme, double t) {
  if (scheme_.h == scheme.h) return;
  factor_.reserve(scheme);
  scheme_ = scheme;
  equations_.scale().find(scheme, t);
  relaxation_.prepare(scheme);
  factor_.setWeights(equations_.weight());
}

bool ImplicitStep::solve(double begin, State& to, const StepScheme& scheme, Counters& counters) {
  strategies_.countIn(counters.strategies);
  prepare(scheme, to.t);
  model_->timed().setStepEnd(begin, to.t);
  equations_.begin(to, scheme_);
  return (relaxation_.isPossible() && relax(to, counters)) ||
         (strategies_.use(Strategy::Newton) && finish(to, counters));
}

/// Relaxation of the point forces; false, with `to` unchanged, if it does not converge.
bool ImplicitStep::relax(State& to, Counters& counters) {
  strategies_.count(Strategy::Relaxation);
  if (!factor_.isOf(scheme_) || factor_.isWanted()) {
    predicted_ = to;
    predict(predicted_);
    if (!factor_.renew(scheme_, predicted_, counters)) return false;
  }
  if (relaxation_.solve(to, scheme_, counters)) return true;
  factor_.want();
  return false;
}

/// Newton from the end of the relaxation, which is often wrong only at a few points, then from the
/// predicted state.
bool ImplicitStep::finish(State& to, Counters& counters) {
  predicted_ = to;
  predict(predicted_);
  if (equations_.error() <= equations_.reference()) {  // relaxation has made progress
    relaxation_.complete(to);
    equations_.linearise(to);
    if (factor_.phase().isTaken()) equations_.linear() -= factor_.phase().force();
    if (newton_.solve(to, scheme_, counters)) return true;
    factor_.want();
  }
  to = predicted_;
  equations_.linearise(to);
  return newton_.solve(to, scheme_, counters);
}

/// From q, a for v = 0 to those for the predicted v.
void ImplicitStep::predict(State& to) const {
  to.q += to.v / scheme_.velocity;
  to.a += scheme_.acceleration / scheme_.velocity * to.v;
}

void ImplicitStep::save(std::vector<double>& memory) const {
  scheme_.save(memory);
  equations_.scale().save(memory);
  relaxation_.save(memory);
  factor_.save(memory);
}

void ImplicitStep::restore(const double*& memory) {
  scheme_.restore(memory);
  equations_.scale().restore(memory, scheme_);
  relaxation_.restore(memory, scheme_);
  if (scheme_.h > 0) factor_.setWeights(equations_.weight());
  factor_.restore(memory);
}

}  // namespace tooljoint::transient
