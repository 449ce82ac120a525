// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How a scheme takes a step of a run a second time, as two halves. The model has points of its own
/// meanwhile, and is then as it was.
#pragma once

#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class HalvedStep {
 public:
  virtual ~HalvedStep() = default;
  /// Binds to the model of the run, which starts at `state`; steps of length h become halves.
  virtual void prepare(CompiledModel& model, const State& state, double h) = 0;
  /// The step from `from`, which the run ends at end.t, as two halves that end in `end`. False when
  /// their equations have no solution.
  virtual bool take(const State& from, State& end) = 0;
  /// What is no motion, taken out of the velocities at the start of the step and at its end by the
  /// run and by the halves.
  virtual void clean(Vector& /*start*/, Vector& /*run*/, Vector& /*halves*/) const {}
  virtual void save(std::vector<double>& memory) const = 0;
  virtual void restore(const double*& memory) = 0;
};

}  // namespace tooljoint::transient
