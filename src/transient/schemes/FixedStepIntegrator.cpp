// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/FixedStepIntegrator.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tooljoint::transient {
namespace {

constexpr double usualSteps = 1000;

}  // namespace

double FixedStepIntegrator::usualStep(const Window& window, const State&) {
  return (window.end - window.begin) / usualSteps;
}

void FixedStepIntegrator::prepare(CompiledModel& model, const Window& window, State& state) {
  window_ = window;
  start(model, state);
  step_ = fittedStep(window, window.step > 0 ? window.step : usualStep(window, state));
}

void FixedStepIntegrator::advance(const State& from, State& to) {
  // Times are products, not sums: no drift over many steps.
  const double end = std::min(window_.begin + static_cast<double>(index_ + 1) * step_, window_.end);
  to.t = window_.end - end < 1e-9 * step_ ? window_.end : end;
  step(from, to);
  ++index_;
  counters_.accept(to.t - from.t);
}

void FixedStepIntegrator::startAgain(const double*, State& from) {
  index_ = std::lround((from.t - window_.begin) / step_);
}

void FixedStepIntegrator::save(std::vector<double>& memory) const {
  memory.push_back(static_cast<double>(index_));
}

void FixedStepIntegrator::restore(const double*& memory) { index_ = static_cast<long>(*memory++); }

}  // namespace tooljoint::transient
