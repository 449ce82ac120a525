// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The solutions of r(x, p) = 0 along a path, by pseudo-arc-length continuation: the stepper of
/// LOCA (A. G. Salinger et al., SAND2002-0396), with NOX for each step.
#pragma once

#include <functional>
#include <optional>
#include <string>

#include "model/ParametricProblem.hpp"

namespace tooljoint::statics {

struct PathOptions {
  double from = 0.0, to = 1.0;  ///< of the parameter; from < to
  /// Lengths of steps, of the path (model::ParametricProblem::pathWeights()).
  double firstStep = 0.01, largestStep = 0.1, smallestStep = 1e-6;
  /// Steps longer than this are not taken over a bifurcation, where another branch is near.
  double bifurcationStep = 1e-3;
  int maxSteps = 500;       ///< tried, failed ones too
  int maxIterations = 15;   ///< Newton iterations of a step; with more it is tried again in half
  double tolerance = 1e-9;  ///< on the largest scaled residual
};

struct PathPoint {
  int step = 0;  ///< 0: the start
  double parameter = 0.0;
  Vector x;
  std::optional<int> negativePivots;  ///< of the problem
};

/// How a path ended. Anything but Reached misses the request.
enum class PathEnd {
  Reached,   ///< the last parameter
  Returned,  ///< the first parameter, backwards
  Steps,     ///< all steps were taken
  Stopped,   ///< by the observer
  Failed     ///< not even the smallest step converged
};

struct PathReport {
  PathEnd end = PathEnd::Failed;
  int steps = 0;            ///< converged, beside the start
  int failedSteps = 0;      ///< tried again in half
  double parameter = 0.0;   ///< of the last point
  std::string explanation;  ///< one sentence: how it ended, at which parameter, and why

  template <class Archive>
  void serialize(Archive& archive) {
    archive(end, steps, failedSteps, parameter, explanation);
  }
};

/// Gets each point in turn; false ends the path.
using PathObserver = std::function<bool(const PathPoint&)>;

/// Follows the path that leads from the solution near `start` at options.from through turning
/// points of the parameter until it reaches options.to. The first direction is that of growing
/// parameter. Steps grow where Newton's method converges fast, and are halved where it fails; each
/// solves
///
///     r(x, p) = 0,   sum_i a_i t_i (x_i - x_i0) + t_p (p - p_0)/scale^2 = ds
///
/// with the tangent (t, t_p) of the step before. At a turning point of the parameter one pivot
/// changes its sign; a step over which pivots do so while the parameter goes on is one over a
/// bifurcation, or from one branch of an imperfect bifurcation to the other: it is halved down to
/// options.bifurcationStep. Never throws for failure: the report says why.
/// Errors thrown by the problem or the observer pass through. The same on every rank: nothing is
/// sent. ModelError: sizes or bounds do not fit.
PathReport followPath(const model::ParametricProblem& problem, const Vector& start,
                      const PathOptions& options, const PathObserver& observer);

/// Whether followPath() finds its first point from this start.
bool startsPath(const model::ParametricProblem& problem, const Vector& start,
                const PathOptions& options);

}  // namespace tooljoint::statics
