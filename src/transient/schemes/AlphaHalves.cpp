// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/AlphaHalves.hpp"

namespace tooljoint::transient {
namespace {

/// The halves are solved better than the step, so that what its iterations leave is seen.
constexpr double strictness = 0.1;

AlphaStep::Parameters stricter(AlphaStep::Parameters parameters) {
  parameters.equations.tolerance *= strictness;
  return parameters;
}

}  // namespace

AlphaHalves::AlphaHalves(const AlphaStep& step)
    : step_(step), halves_(stricter(step.parameters())) {}

void AlphaHalves::prepare(CompiledModel&, const State& state, double h) {
  h_ = h;
  start_ = middle_ = state;
  halves_.startLike(step_);
  halves_.prepare(0.5 * h, state.t);
}

bool AlphaHalves::take(const State& from, State& end) {
  halves_.startWhere(step_);
  start_ = from;
  step_.addImpactVelocity(-0.5, h_, true, start_.v);
  middle_.t = from.t + 0.5 * h_;
  if (!halves_.take(start_, middle_, 0.5 * h_, false, unused_)) return false;
  halves_.keep();
  return halves_.take(middle_, end, 0.5 * h_, false, unused_);
}

void AlphaHalves::clean(Vector& start, Vector& run, Vector& halves) const {
  step_.addImpactVelocity(-1.0, h_, true, start);
  step_.addImpactVelocity(-1.0, h_, false, run);
  halves_.addImpactVelocity(-1.0, 0.5 * h_, false, halves);
}

}  // namespace tooljoint::transient
