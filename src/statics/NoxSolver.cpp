// SPDX-License-Identifier: BSD-3-Clause
#include "statics/NoxSolver.hpp"

#include <memory>

#include "statics/NewtonSolver.hpp"

namespace tooljoint::statics {

model::NonlinearSolver noxSolver(const Teuchos::ParameterList& list) {
  const auto sublist = [&list](const char* name) {
    return list.isSublist(name) ? std::make_shared<const Teuchos::ParameterList>(list.sublist(name))
                                : nullptr;
  };
  const auto nox = sublist("NOX");
  const auto belos = sublist("Belos");
  return [nox, belos](const model::NonlinearProblem& problem, Vector& x,
                      const model::SolveRequest& request) {
    NewtonOptions options;
    options.tolerance = request.tolerance;
    options.updateTolerance = request.updateTolerance > 0.0 ? request.updateTolerance : 1.0;
    options.maxIterations = request.maxIterations;
    options.lineSearch = lineSearch(request.search);
    const auto report = solve(problem, x, options, nox.get(), belos.get());
    return model::SolveOutcome{report.converged, report.iterations, report.residual, report.update,
                               report.message};
  };
}

}  // namespace tooljoint::statics
