// SPDX-License-Identifier: BSD-3-Clause
// An explicit integrator outside of the library: one file, compiled by itself, named in decks.
#include <tooljoint/transient/schemes/Explicit.hpp>
#include <tooljoint/transient/schemes/FixedStepIntegrator.hpp>

using namespace tooljoint;
using namespace tooljoint::transient;

/// Second order (Heun 1900), with y' = f(y) for y = (q, v, x):
///
///     y* = y_n + h f(y_n),   y_{n+1} = y_n + h/2 (f(y_n) + f(y*))
class Heun final : public FixedStepIntegrator {
 public:
  bool isExplicit() const override { return true; }
  bool carriesPointStates() const override { return true; }

 protected:
  void start(CompiledModel& model, State& state) override {
    rhs_.bind(model, "Heun", counters_);
    rhs_.look(state.t, 0.0, state.q.data());
    rhs_.complete(state);
    guess_ = state;
  }
  void step(const State& from, State& to) override {
    const double h = to.t - from.t;
    rhs_.look(from.t, h, from.q.data());
    do {
      guess_.t = to.t;
      guess_.q = from.q + h * from.v;
      guess_.v = from.v + h * from.a;
      guess_.x = from.x + h * from.xDot;
      rhs_.complete(guess_);
      to.q = from.q + 0.5 * h * (from.v + guess_.v);
      to.v = from.v + 0.5 * h * (from.a + guess_.a);
      to.x = from.x + 0.5 * h * (from.xDot + guess_.xDot);
    } while (rhs_.missed(to.q.data()));
    rhs_.accept(to);
  }

 private:
  ExplicitRightHandSide rhs_;
  State guess_;
};

const bool registered = IntegratorRegistry::instance().add(
    "Heun", {"Explicit, second order (Heun 1900).", {}, [](const Teuchos::ParameterList&) {
               return std::make_unique<Heun>();
             }});
