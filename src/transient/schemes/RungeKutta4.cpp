// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `RK4`: classical Runge-Kutta with a fixed step.
#include <string>

#include "transient/schemes/Explicit.hpp"
#include "transient/schemes/FixedStepIntegrator.hpp"

namespace tooljoint::transient {
namespace {

deck::ListSpec specification() {
  return deck::ListSpec("RK4", "Parameters of the fixed-step Runge-Kutta integrator.")
      .real("Safety", "", 0.9, deck::Range{0.0, 1.0, true, false},
            "Fraction of the stability limit 2.78 / omega_max taken as the step when Step is not "
            "given.");
}

class RungeKutta4 final : public FixedStepIntegrator {
 public:
  explicit RungeKutta4(const Teuchos::ParameterList& own) : safety_(own.get<double>("Safety")) {}

  bool isExplicit() const override { return true; }
  bool carriesPointStates() const override { return true; }
  /// The limit of stability is far below what accuracy needs: steps are not measured.
  bool judgesSteps() const override { return true; }
  double repeatedStep() const override { return 0; }
  int ledgerStride() const override { return 4; }
  std::string advice() const override {
    return "Reduce Transient/Step, or use the integrator \"Generalized-alpha\"";
  }

 protected:
  void start(CompiledModel& model, State& state) override {
    rhs_.bind(model, "RK4", counters_);
    ++counters_.factorisations;
    stage_.resize(state);
    rhs_.look(state.t, 0.0, state.q.data());
    rhs_.complete(state);
  }
  double usualStep(const Window& window, const State& start) override {
    const double omega = rhs_.largestFrequency(start);
    return omega > 0 ? safety_ * 2.78 / omega : (window.end - window.begin) / 100;
  }
  void step(const State& from, State& to) override {
    const double h = to.t - from.t;
    rhs_.look(from.t, h, from.q.data());
    do {
      stage_.take(rhs_, from, h, to);
    } while (rhs_.missed(to.q.data()));
    rhs_.accept(to);
  }

 private:
  double safety_;
  ExplicitRightHandSide rhs_;
  RungeKuttaStep stage_;
};

const bool registered = IntegratorRegistry::instance().add(
    "RK4", {"Classical fourth-order Runge-Kutta method with a fixed step (Nguyen et al. 2020, "
            "appendix B).",
            specification(),
            [](const Teuchos::ParameterList& own) { return std::make_unique<RungeKutta4>(own); }});

}  // namespace
}  // namespace tooljoint::transient
