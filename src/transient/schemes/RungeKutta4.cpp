// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `RK4`: classical Runge-Kutta with a fixed step.
#include <algorithm>
#include <cmath>
#include <string>

#include "transient/schemes/Explicit.hpp"

namespace tooljoint::transient {
namespace {

deck::ListSpec specification() {
  return deck::ListSpec("RK4", "Parameters of the fixed-step Runge-Kutta integrator.")
      .real("Safety", "", 0.9, deck::Range{0.0, 1.0, true, false},
            "Fraction of the stability limit 2.78 / omega_max taken as the step when Step is not "
            "given.");
}

class RungeKutta4 final : public Integrator {
 public:
  explicit RungeKutta4(const Teuchos::ParameterList& own)
      : safety_(withDefaults(own, specification()).get<double>("Safety")) {}

  bool isExplicit() const override { return true; }
  bool carriesPointStates() const override { return true; }
  int ledgerStride() const override { return 4; }
  std::string advice() const override {
    return "Reduce Transient/Step, or use the integrator \"Generalized-alpha\"";
  }

  void prepare(CompiledModel& model, const Window& window, State& state) override {
    rhs_.bind(model, "RK4", counters_);
    ++counters_.factorisations;
    stage_.resize(state);
    window_ = window;
    double asked = window.step;
    if (!(asked > 0)) {
      const double omega = rhs_.largestFrequency(state);
      asked = omega > 0 ? safety_ * 2.78 / omega : (window.end - window.begin) / 100;
    }
    step_ = fittedStep(window, asked);
    rhs_.look(state.t, 0.0, state.q.data());
    rhs_.complete(state);
  }

  void advance(const State& from, State& to) override {
    // Grid times are products, not sums: no drift over many steps.
    const double end =
        std::min(window_.begin + static_cast<double>(index_ + 1) * step_, window_.end);
    to.t = window_.end - end < 1e-9 * step_ ? window_.end : end;
    const double h = to.t - from.t;
    rhs_.look(from.t, h, from.q.data());
    do {
      stage_.take(rhs_, from, h, to);
    } while (rhs_.missed(to.q.data()));
    rhs_.accept(to);
    ++index_;
    counters_.accept(h);
  }

  void save(std::vector<double>& memory) const override {
    memory.push_back(static_cast<double>(index_));
  }
  void restore(const double*& memory) override { index_ = static_cast<long>(*memory++); }

 private:
  double safety_;
  ExplicitRightHandSide rhs_;
  RungeKuttaStep stage_;
  Window window_;
  double step_ = 0;
  long index_ = 0;
};

const bool registered = IntegratorRegistry::instance().add(
    "RK4", {"Classical fourth-order Runge-Kutta method with a fixed step (Nguyen et al. 2020, "
            "appendix B).",
            specification(),
            [](const Teuchos::ParameterList& own) { return std::make_unique<RungeKutta4>(own); }});

}  // namespace
}  // namespace tooljoint::transient
