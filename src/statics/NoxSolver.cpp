// SPDX-License-Identifier: BSD-3-Clause
#include "statics/NoxSolver.hpp"

#include <memory>

#include "statics/DividedProblem.hpp"
#include "statics/NewtonMemory.hpp"
#include "statics/NewtonSolver.hpp"

namespace tooljoint::statics {

model::NonlinearSolver noxSolver(const Teuchos::ParameterList& list) {
  const auto sublist = [&list](const char* name) {
    return list.isSublist(name) ? std::make_shared<const Teuchos::ParameterList>(list.sublist(name))
                                : nullptr;
  };
  const auto nox = sublist("NOX");
  const auto belos = sublist("Belos");
  const auto memory = std::make_shared<NewtonMemory>();
  return [nox, belos, memory](const model::NonlinearProblem& problem, Vector& x,
                              const model::SolveRequest& request) {
    NewtonOptions options;
    options.tolerance = request.tolerance;
    options.updateTolerance = request.updateTolerance > 0.0 ? request.updateTolerance : 1.0;
    options.maxIterations = request.maxIterations;
    options.lineSearch = lineSearch(request.search);
    const auto divided = DividedProblem::of(problem);
    const auto report =
        solve(divided ? *divided : problem, x, options, nox.get(), belos.get(), memory.get());
    return model::SolveOutcome{report.converged, report.iterations, report.residual, report.update,
                               report.message};
  };
}

}  // namespace tooljoint::statics
