// SPDX-License-Identifier: BSD-3-Clause
// An implicit integrator outside of the library: one file, compiled by itself, named in decks.
#include <tooljoint/common/Error.hpp>
#include <tooljoint/common/Text.hpp>
#include <tooljoint/transient/schemes/Explicit.hpp>
#include <tooljoint/transient/schemes/FixedStepIntegrator.hpp>
#include <tooljoint/transient/schemes/ImplicitStep.hpp>

using namespace tooljoint;
using namespace tooljoint::transient;

/// The trapezoidal rule (Newmark 1959 with beta 1/4, gamma 1/2), for q, v and states x alike:
///
///     q_{n+1} = q_n + h/2 (v_n + v_{n+1}),   v_{n+1} = v_n + h/2 (q''_n + q''_{n+1})
class Trapezoidal final : public FixedStepIntegrator {
 public:
  explicit Trapezoidal(const Teuchos::ParameterList& own)
      : tolerance_(own.get<double>("Tolerance")) {}
  bool carriesPointStates() const override { return true; }
  void save(std::vector<double>& memory) const override {
    FixedStepIntegrator::save(memory);
    equations_.save(memory);
  }
  void restore(const double*& memory) override {
    FixedStepIntegrator::restore(memory);
    equations_.restore(memory);
  }

 protected:
  void start(CompiledModel& model, State& state) override {
    ExplicitRightHandSide rhs;
    rhs.bind(model, "Trapezoidal", counters_);
    rhs.look(state.t, 0.0, state.q.data());
    rhs.complete(state);
    equations_.bind(model, {tolerance_, 25});
    model_ = &model;
    base_ = state.x;
  }
  void step(const State& from, State& to) override {
    const double h = to.t - from.t;
    for (auto& batch : model_->points()) batch.look(from.t, h, from.q.data());
    to.v = from.v + h * from.a;            // predicted
    to.q = from.q + 0.5 * h * from.v;      // where v_{n+1} = 0
    to.a = -from.a - 2.0 / h * from.v;     // likewise
    base_ = from.x + 0.5 * h * from.xDot;  // x_{n+1} = base + h/2 x'_{n+1}
    model_->states().bind(base_.data(), 0.5 * h);
    if (!equations_.solve(from.t, to, {h, 2.0 / h, 4.0 / (h * h), 0, 0, 1}, counters_))
      throw ConvergenceError("The equations of the step from t = " + formatNumber(from.t) +
                             " s have no solution that Newton finds. " + advice() + ".");
    model_->states().complete(to.t, to.q.data(), to.v.data(), to.x.data(), to.xDot.data());
  }

 private:
  double tolerance_;
  CompiledModel* model_ = nullptr;
  ImplicitStep equations_;
  Vector base_;
};

const bool registered = IntegratorRegistry::instance().add(
    "Trapezoidal",
    {"Implicit, second order, without numerical damping (Newmark 1959).",
     deck::ListSpec("Trapezoidal", "")
         .real("Tolerance", "", 1e-10, deck::Range::positive(),
               "Newton stops when the scaled residual falls below this part of the largest force."),
     [](const Teuchos::ParameterList& own) { return std::make_unique<Trapezoidal>(own); }});
