// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Solutions of r(x, p) = 0 along a path by pseudo-arc-length continuation: the stepper of LOCA (A.
/// G. Salinger et al., SAND2002-0396), with NOX for each step.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/ParametricProblem.hpp"

namespace tooljoint::statics {

struct PathOptions {
  double from = 0.0, to = 1.0;  ///< range of the parameter; from < to
  /// Step lengths along the path (model::ParametricProblem::pathWeights()).
  double firstStep = 0.01, largestStep = 0.1, smallestStep = 1e-6;
  /// Limit of steps over a bifurcation, where another branch is near.
  double bifurcationStep = 1e-3;
  int maxSteps = 500;       ///< including failed ones
  int maxIterations = 15;   ///< Newton iterations of a step; if more are needed the step is halved
  double tolerance = 1e-9;  ///< on the largest scaled residual
};

struct PathPoint {
  int step = 0;  ///< 0: the start
  double parameter = 0.0;
  Vector x;
  std::optional<int> negativePivots;  ///< of the problem
};

/// How a path ended. Only Reached fulfils the request.
enum class PathEnd {
  Reached,   ///< the last parameter was reached
  Returned,  ///< the path returned to the first parameter
  Steps,     ///< all steps were taken
  Stopped,   ///< by the observer
  Failed     ///< even the smallest step did not converge
};

struct PathReport {
  PathEnd end = PathEnd::Failed;
  int steps = 0;            ///< converged, without the start
  int failedSteps = 0;      ///< repeated with half the length
  double parameter = 0.0;   ///< of the last point
  std::string explanation;  ///< one sentence: how and at which parameter it ended, and why

  template <class Archive>
  void serialize(Archive& archive) {
    archive(end, steps, failedSteps, parameter, explanation);
  }
};

/// Receives each point in order; false ends the path.
using PathObserver = std::function<bool(const PathPoint&)>;

/// Follows the path from the solution near `start` at options.from, through turning points of the
/// parameter, until it reaches options.to. The parameter grows at first. Steps are lengthened while
/// Newton's method converges fast, and halved if it fails; each step solves
///
///     r(x, p) = 0,   sum_i a_i t_i (x_i - x_i0) + t_p (p - p_0)/scale^2 = ds
///
/// with the tangent (t, t_p) of the previous step. At a turning point of the parameter one pivot
/// changes its sign. If pivots change their sign while the parameter keeps its direction, the step
/// is over a bifurcation, or from one branch of an imperfect bifurcation to the other: it is halved
/// down to options.bifurcationStep. Failures are not thrown: the report gives the reason. Errors
/// thrown by the problem or the observer are passed on. The same on every rank, without messages.
/// ModelError: sizes or bounds do not fit.
PathReport followPath(const model::ParametricProblem& problem, const Vector& start,
                      const PathOptions& options, const PathObserver& observer);

/// Whether followPath() finds its first point from this start.
bool startsPath(const model::ParametricProblem& problem, const Vector& start,
                const PathOptions& options);

}  // namespace tooljoint::statics
