// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `RK4`: classical Runge-Kutta with a fixed step.
#include <algorithm>
#include <string>
#include <vector>

#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/Percent.hpp"
#include "transient/schemes/Explicit.hpp"
#include "transient/schemes/FixedStepIntegrator.hpp"

namespace tooljoint::transient {
namespace {

/// |lambda| h up to which steps are stable, on both axes (2.83 and 2.785). Between them it is 2.62,
/// where vibration loses half its amplitude per radian.
constexpr double stabilityLimit = 2.78;

deck::ListSpec rungeKutta4Parameters() {
  return deck::ListSpec("RK4", "Parameters of the fixed-step Runge-Kutta integrator.")
      .real("Safety", "", 0.9, deck::Range{0.0, 1.0, true, false},
            "Fraction of the limit taken as the step when Step is not given: of stability, 2.78 / "
            "lambda, where lambda bounds the rates of the model with gyroscopic, Coriolis and skew "
            "terms at their largest, states of point laws and all contact closed, and of impacts, "
            "0.5 over the rate of the stiffest contact. The step is no longer than Sampling "
            "Interval.");
}

class RungeKutta4 final : public FixedStepIntegrator {
 public:
  explicit RungeKutta4(const Teuchos::ParameterList& own) : safety_(own.get<double>("Safety")) {}

  bool isExplicit() const override { return true; }
  bool carriesPointStates() const override { return true; }
  bool dividesAmongRanks() const override { return true; }
  bool followsCorners() const override { return true; }
  bool followsPhase(bool /*gyroscopic*/) const override { return true; }
  std::string advice() const override {
    return "Reduce Transient/Step, or use the integrator \"Generalized-alpha\"";
  }

  void judge() override {
    const double share = swings_.share(rhs_.model());
    if (share > 0)
      log::warn(
          "The time step (" + formatNumber(equalStep()) +
          " s) is too large for RK4 where a point law, such as that of a bit, is steep: in " +
          percent(share) +
          " of the steps its force swings about its value, and what should stick may slide. " +
          advice() + ".");
  }
  void save(std::vector<double>& memory) const override {
    FixedStepIntegrator::save(memory);
    swings_.save(memory);
  }
  void restore(const double*& memory) override {
    FixedStepIntegrator::restore(memory);
    swings_.restore(memory);
  }

 protected:
  void start(CompiledModel& model, State& state) override {
    rhs_.bind(model, "RK4", counters_);
    ++counters_.factorisations;
    stage_.resize(state);
    rhs_.look(state.t, 0.0, state.q.data());
    rhs_.complete(state);
    swings_.bind(model);
  }
  double usualStep(const Window& window, const State& start) override {
    const auto rates = rhs_.largestRates(start, window.end);
    const double least = std::max(rates.all / stabilityLimit, rates.impact / rungeKuttaImpactLimit);
    const double step = least > 0 ? safety_ / least : (window.end - window.begin) / 100;
    // without fast parts the stability limit exceeds what accuracy needs
    return window.sampling > 0 ? std::min(step, window.sampling) : step;
  }
  void step(const State& from, State& to) override {
    const double h = to.t - from.t;
    rhs_.look(from.t, h, from.q.data());
    do {
      stage_.take(rhs_, from, h, to, &swings_);
    } while (rhs_.missed(to.q.data()));
    rhs_.accept(to);
    swings_.endStep(rhs_.model());
  }

 private:
  double safety_;
  ExplicitRightHandSide rhs_;
  ForceSwings swings_;
  RungeKuttaStep stage_;
};

const bool rungeKutta4Registered = IntegratorRegistry::instance().add(
    "RK4", {"Classical fourth-order Runge-Kutta method with a fixed step (Nguyen et al. 2020, "
            "appendix B).",
            rungeKutta4Parameters(),
            [](const Teuchos::ParameterList& own) { return std::make_unique<RungeKutta4>(own); }});

}  // namespace
}  // namespace tooljoint::transient
