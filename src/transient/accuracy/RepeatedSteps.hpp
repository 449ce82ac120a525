// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Accuracy of the equal steps of any integrator that can take a step again (Integrator::repeat()):
/// R from the displacement and D from the velocity (StepAccuracy.hpp) of steps and their halves,
/// which a second object of the integrator takes.
#pragma once

#include <memory>
#include <vector>

#include "transient/accuracy/StepAccuracy.hpp"
#include "transient/accuracy/StepDoublingError.hpp"

namespace tooljoint::transient {

class RepeatedSteps {
 public:
  /// \param second  a second object of the integrator, made from the same parameters
  RepeatedSteps(CompiledModel& model, std::unique_ptr<Integrator> second, const Window& window,
                const State& state, double h);
  /// The step that the run has just taken, after so many.
  void look(long steps, const State& from, const State& to);
  StepErrors errors() const { return {local_.ratio(), doubling_.ratio(local_.change() / h_)}; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  StepDoublingError doubling_;
  StepAccuracy local_;
  MassNorm size_;
  Vector difference_;
  double h_;
};

}  // namespace tooljoint::transient
