// SPDX-License-Identifier: BSD-3-Clause
#include "statics/Continuation.hpp"

#include <algorithm>
#include <cstdio>

#include "common/Error.hpp"

namespace tooljoint::statics {

int ContinuationReport::iterations() const {
  int sum = 0;
  for (const auto& stage : stages) sum += stage.newton.iterations;
  return sum;
}

std::string ContinuationReport::message() const {
  if (converged)
    return std::to_string(stages.size()) + " stages converged in " + std::to_string(iterations()) +
           " iterations.";
  if (stages.empty()) return "there was no stage.";
  return "stage \"" + stages.back().name + "\": " + stages.back().newton.message;
}

ContinuationReport runStages(const model::NonlinearProblem& problem, Vector& x,
                             const std::vector<Stage>& stages, const Teuchos::ParameterList* nox,
                             const Teuchos::ParameterList* belos) {
  ContinuationReport report;
  for (const auto& stage : stages) {
    if (stage.prepare) stage.prepare();
    report.stages.push_back({stage.name, solve(problem, x, stage.options, nox, belos)});
    if (!report.stages.back().newton.converged) return report;
  }
  report.converged = !stages.empty();
  return report;
}

ContinuationReport runRamp(const model::NonlinearProblem& problem, Vector& x,
                           const std::function<void(double)>& set, const RampOptions& options,
                           const Teuchos::ParameterList* nox, const Teuchos::ParameterList* belos) {
  ContinuationReport report;
  const double largest = 1.0 / std::max(1, options.increments);
  double done = 0.0, increment = largest;
  int halvings = 0, easy = 0;
  while (done < 1.0) {
    const double next = done + increment > 1.0 - 1e-12 ? 1.0 : done + increment;
    set(next);
    Vector trial = x;
    char name[32];
    std::snprintf(name, sizeof name, "s = %.6g", next);
    report.stages.push_back({name, solve(problem, trial, options.newton, nox, belos)});
    if (report.stages.back().newton.converged) {
      x = trial;
      done = next;
      if (++easy >= 2 && increment < largest) {
        increment = std::min(largest, 2.0 * increment);
        --halvings;
        easy = 0;
      }
      continue;
    }
    easy = 0;
    if (++halvings > options.maxHalvings) return report;
    increment *= 0.5;
  }
  report.converged = true;
  return report;
}

void requireConverged(const ContinuationReport& report, const std::string& what,
                      const std::string& advice) {
  if (!report.converged)
    throw ConvergenceError(what + " did not converge: " + report.message() +
                           (advice.empty() ? "" : " " + advice));
}

}  // namespace tooljoint::statics
