// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Base of integrators with steps of one length. A scheme provides the start and the step, from a
/// state alone; this class provides times, restart and the measured accuracy of the steps.
#pragma once

#include <string>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class FixedStepIntegrator : public Integrator {
 public:
  std::string advice() const override { return "Reduce Transient/Step"; }
  void prepare(CompiledModel& model, const Window& window, State& state) final;
  void advance(const State& from, State& to) final;
  double equalStep() const override { return step_; }
  /// A scheme with a history beyond its state overrides this and saveHistory(), and calls this.
  void startAgain(const double* history, State& from) override;
  /// A scheme with memory beyond its factors overrides both and calls these.
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;

 protected:
  /// Binds to the model and completes state.a and state.xDot, as Integrator::prepare().
  virtual void start(CompiledModel& model, State& state) = 0;
  /// Step if the deck gives none [s]; called after start(). By default a thousandth of the motion.
  virtual double usualStep(const Window& window, const State& start);
  /// One step of length to.t - from.t, constant up to rounding and except at the end of the motion.
  /// Writes all of `to` except its time. Throws ConvergenceError.
  virtual void step(const State& from, State& to) = 0;

 private:
  Window window_;
  double step_ = 0;
  long index_ = 0;
};

}  // namespace tooljoint::transient
