// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// An integrator of your own, named in scene.xml: velocity Verlet (Swope et al. 1982),
///
///     q_{n+1} = q_n + h (v_n + h/2 a_n),   v_{n+1} = v_n + h/2 (a_n + a(q_{n+1}, v_n + h a_n)),
///
/// explicit, of second order, one solution with the mass matrix per evaluation of the forces. RK4
/// is the reference.
#include <Tpetra_Core.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <tooljoint/common/Parallel.hpp>
#include <tooljoint/run.hpp>
#include <tooljoint/transient/schemes/Explicit.hpp>
#include <tooljoint/transient/schemes/FixedStepIntegrator.hpp>
using namespace tooljoint;
using namespace tooljoint::transient;

class VelocityVerlet final : public FixedStepIntegrator {
 public:
  bool isExplicit() const override { return true; }

 protected:
  void start(CompiledModel& model, State& state) override {
    rhs_.bind(model, "Velocity Verlet", counters_);
    rhs_.look(state.t, 0.0, state.q.data());
    rhs_.complete(state);
  }
  void step(const State& from, State& to) override {
    const double h = to.t - from.t;
    rhs_.look(from.t, h, from.q.data());  // points that may touch in this step
    to.q = from.q + h * (from.v + 0.5 * h * from.a);
    do {
      to.v = from.v + h * from.a;
      rhs_.complete(to);  // to.a
      to.v = from.v + 0.5 * h * (from.a + to.a);
    } while (rhs_.missed(to.q.data()));
    rhs_.complete(to);
  }

 private:
  ExplicitRightHandSide rhs_;
};
const bool registered = IntegratorRegistry::instance().add(
    "Velocity Verlet",
    {"Explicit, second order (Swope et al. 1982).", {}, [](const Teuchos::ParameterList&) {
       return std::make_unique<VelocityVerlet>();
     }});

int main(int argc, char** argv) {
  const Tpetra::ScopeGuard scope(&argc, &argv);
  try {
    const auto mine = runDeck(SCENE, {"Output/Folder=verlet"});
    const auto reference = runDeck(SCENE, {"Transient/Integrator=RK4", "Output/Folder=rk4"});
    const auto q = mine.histories().numbers("/transient/displacement");
    const auto exact = reference.histories().numbers("/transient/displacement");
    double error = 0, size = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      error = std::max(error, std::abs(q[i] - exact[i]));
      size = std::max(size, std::abs(exact[i]));
    }
    if (parallel::rank() == 0)
      std::printf("largest difference to RK4: %.1e of the largest displacement; energy: %.1e\n",
                  error / size, mine.number("transient.energy_residual"));
    return error < 1e-3 * size ? 0 : 1;
  } catch (const Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return static_cast<int>(error.code());
  }
}
