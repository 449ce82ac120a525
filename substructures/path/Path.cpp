// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/path/Path.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>

#include "common/Error.hpp"
#include "substructures/path/PathProblem.hpp"
#include "substructures/well/Frames.hpp"

namespace tooljoint::path {
namespace {

/// Largest number of halvings of a load step before the path computation fails.
constexpr int kMaxHalvings = 6;

std::vector<double> unstretchedDepths(const PathInput& input) {
  std::vector<double> depths{0.0};
  for (const auto& element : input.elements) depths.push_back(depths.back() + element->length());
  return depths;
}

void check(const PathInput& input, Mode mode) {
  if (input.trajectory == nullptr) throw ModelError("The path has no well trajectory. Give one.");
  if (input.elements.empty()) throw ModelError("The path needs a string of at least one element.");
  for (std::size_t e = 0; e < input.elements.size(); ++e) {
    const std::string who = "Element " + std::to_string(e + 1) + " of the string ";
    if (!(input.elements[e]->length() > 0.0))
      throw ModelError(who + "does not have a positive length.");
    const beam::DofMap dofs = input.elements[e]->dofs();
    if (mode == Mode::ImposedNodes &&
        !std::all_of(dofs.begin(), dofs.end(), [](bool has) { return has; }))
      throw ModelError(who +
                       "lacks some of the dofs u, v, w, theta_x, theta_y and theta_z, which "
                       "/Path/Mode \"Imposed nodes\" needs. Use \"Centre line\".");
  }
}

/// Depth of the foot of X on the axis: (X - C(s)) . t(s) = 0, Newton from s.
double footOnAxis(const well::Trajectory& trajectory, const Vector3& x, double s) {
  for (int i = 0; i < 50; ++i) {
    const well::WellPoint p = trajectory.at(s);
    const Vector3 d = x - p.position;
    const double step = d.dot(p.tangent) / std::max(1.0 - d.dot(p.curvature), 0.1);
    s += step;
    if (std::abs(step) < 1e-12 * (1.0 + std::abs(s))) break;
  }
  return s;
}

/// Nodal positions, frames and distances from the axis at x.
void placeNodes(const PathInput& input, const PathOptions& options, const PathProblem& problem,
                const Vector& x, PathState& state) {
  const std::vector<NodePose> nodePoses = problem.poses(x);
  std::vector<double> guess = unstretchedDepths(input);
  for (std::size_t n = 0; n < nodePoses.size(); ++n) {
    state.position.push_back(nodePoses[n].position);
    state.sectionAxis.push_back(nodePoses[n].triad.col(2));
    state.arcLength.push_back(footOnAxis(*input.trajectory, nodePoses[n].position, guess[n]));
  }
  if (options.mode == Mode::CentreLine) {
    state.arcLength = static_cast<const CentreLineProblem&>(problem).depths(x);
    state.frame = well::bishopFrames(*input.trajectory, state.arcLength);
  } else {
    for (const NodePose& nodePose : nodePoses) state.frame.push_back(nodePose.triad);
  }
  for (std::size_t n = 0; n < nodePoses.size(); ++n) {
    const well::WellPoint foot = input.trajectory->at(state.arcLength[n]);
    const Vector3 away = state.position[n] - foot.position;
    state.offset.push_back(state.frame[n].transpose() * away);
    state.report.maxPositionError = std::max(state.report.maxPositionError, away.norm());
  }
}

/// Fills the result from the converged problem: reactions, element forces and, if requested,
/// tangents in nodal frames.
void describe(const PathInput& input, const PathOptions& options, const PathProblem& problem,
              const Vector& x, PathState& state) {
  placeNodes(input, options, problem, x, state);
  const bool withTangent = options.prestress == Prestress::FullTangent;
  const auto responses = problem.responses(x, withTangent);
  const Matrix forces = problem.nodalForces(x);
  state.reaction.resize(6, problem.nodes());
  for (int n = 0; n < problem.nodes(); ++n) {
    const Matrix3& q = state.frame[static_cast<std::size_t>(n)];
    state.reaction.col(n).head<3>() = -(q.transpose() * forces.col(n).head<3>());
    state.reaction.col(n).tail<3>() = -(q.transpose() * forces.col(n).tail<3>());
  }
  const int elements = static_cast<int>(responses.size());
  state.axialForce.resize(elements);
  state.torque.resize(elements);
  for (int e = 0; e < elements; ++e) {
    const auto i = static_cast<std::size_t>(e);
    const beam::CorotationalResponse& response = responses[i];
    state.elementFrame.push_back(beam::elementTriad(state.position[i], state.position[i + 1],
                                                    state.frame[i], state.frame[i + 1]));
    state.chordLength.push_back(response.length);
    state.force.push_back(response.force);
    state.axialForce(e) = response.axialForce;
    state.torque(e) = response.torque;
    if (withTangent) {
      // global axes to nodal frames: blkdiag(Q1, Q1, Q2, Q2)
      const beam::Matrix12 turn =
          beam::rotation12(Matrix3::Identity(), state.frame[i], state.frame[i + 1]);
      state.tangent.push_back(turn.transpose() * response.tangent * turn);
    }
  }
}

model::SolveRequest request(const PathOptions& options, const std::string& what) {
  model::SolveRequest out;
  out.what = what;
  out.tolerance = options.tolerance;
  out.maxIterations = options.maxIterations;
  return out;
}

/// Solves one load step. A trial state in which an element has no frame counts as not converged.
model::SolveOutcome attempt(const model::NonlinearSolver& solve, const PathProblem& problem,
                            Vector& x, const model::SolveRequest& asked) {
  try {
    return solve(problem, x, asked);
  } catch (const ModelError& error) {
    model::SolveOutcome failed;
    failed.message = error.what();
    return failed;
  }
}

PathState alongCentreLine(const PathInput& input, const PathOptions& options,
                          const model::NonlinearSolver& solve) {
  const std::vector<double> depths = unstretchedDepths(input);
  const CentreLineProblem problem(input, depths, well::bishopFrames(*input.trajectory, depths));
  Vector x = problem.start();
  model::SolveRequest asked = request(options, "the path along the centre line");
  asked.search = model::LineSearch::None;
  model::SolveOutcome outcome = attempt(solve, problem, x, asked);
  int iterations = outcome.iterations;
  if (!outcome.converged) {
    asked.search = model::LineSearch::Residual;
    x = problem.start();
    outcome = attempt(solve, problem, x, asked);
    iterations += outcome.iterations;
  }
  if (!outcome.converged)
    throw ConvergenceError(
        "The path along the centre line did not converge: residual " +
        std::to_string(outcome.residual) + " after " + std::to_string(outcome.iterations) +
        " iterations, with and without line search. " +
        "Use shorter elements where the well bends most, or raise /Path/Max Iterations. " +
        outcome.message);
  PathState state;
  state.report = {true, 1, iterations, outcome.residual, 0.0};
  describe(input, options, problem, x, state);
  return state;
}

/// 0-based imposed nodes: the given list, or equally spaced in arc length. The first node is always
/// fixed.
std::vector<int> imposedNodes(const PathInput& input, const PathOptions& options) {
  const std::vector<double> depths = unstretchedDepths(input);
  const int last = static_cast<int>(depths.size()) - 1;
  std::vector<int> nodes;
  for (const int node : options.nodes) {
    if (node < 1 || node > last + 1)
      throw ModelError("Imposed node " + std::to_string(node) +
                       " does not exist. The string has nodes 1 to " + std::to_string(last + 1) +
                       ".");
    nodes.push_back(node - 1);
  }
  if (options.nodes.empty())
    for (int i = 0; i < options.nodeCount; ++i) {
      const double target = depths.back() * i / (options.nodeCount - 1);
      const auto above = std::lower_bound(depths.begin(), depths.end(), target) - depths.begin();
      int node = std::min(static_cast<int>(above), last);
      const auto at = static_cast<std::size_t>(node);
      if (node > 0 && target - depths[at - 1] < depths[at] - target) --node;
      nodes.push_back(node);
    }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  nodes.erase(std::remove(nodes.begin(), nodes.end(), 0), nodes.end());
  if (nodes.empty()) throw ModelError("The path needs at least one imposed node below node 1.");
  return nodes;
}

PathState byImposedNodes(const PathInput& input, const PathOptions& options,
                         const model::NonlinearSolver& solve) {
  ImposedNodesProblem problem(input, imposedNodes(input, options));
  const std::vector<double> depths = unstretchedDepths(input);
  const int count = static_cast<int>(problem.imposedNodes().size());
  Matrix from(2, count);
  Matrix to(2, count);
  for (int i = 0; i < count; ++i) {
    from.col(i) = input.trajectory->at(0.0).position.head<2>();
    to.col(i) = input.trajectory
                    ->at(depths[static_cast<std::size_t>(
                        problem.imposedNodes()[static_cast<std::size_t>(i)])])
                    .position.head<2>();
  }

  PathState state;
  Vector x = problem.start();
  const double whole = 1.0 / options.increments;
  double done = 0.0;
  double step = whole;
  while (done < 1.0 - 1e-12) {
    const double next = std::min(1.0, done + step);
    problem.prescribe(from + next * (to - from));
    Vector trial = problem.start();
    const model::SolveOutcome outcome =
        attempt(solve, problem, trial,
                request(options, "the path at " + std::to_string(100.0 * next) +
                                     " % of the way into the well"));
    state.report.iterations += outcome.iterations;
    if (outcome.converged) {
      ++state.report.increments;
      state.report.residual = outcome.residual;
      problem.accept(trial);
      x = problem.start();
      done = next;
      step = std::min(whole, 2.0 * step);
      continue;
    }
    step *= 0.5;
    if (step < whole / (1 << kMaxHalvings))
      throw ConvergenceError("The path by imposed nodes did not converge at " +
                             std::to_string(100.0 * next) +
                             " % of the way into the well, although the load step was halved " +
                             std::to_string(kMaxHalvings) +
                             " times. Raise /Path/Increments, impose other nodes (/Path/Nodes), or "
                             "use /Path/Mode \"Centre line\". " +
                             outcome.message);
  }
  state.report.converged = true;
  describe(input, options, problem, x, state);
  return state;
}

}  // namespace

PathState computePath(const PathInput& input, const PathOptions& options,
                      const model::NonlinearSolver& solve) {
  check(input, options.mode);
  return options.mode == Mode::CentreLine ? alongCentreLine(input, options, solve)
                                          : byImposedNodes(input, options, solve);
}

PathState computePath(const PathInput& input, const Teuchos::ParameterList& path,
                      const model::NonlinearSolver& solve) {
  return computePath(input, optionsFrom(path), solve);
}

}  // namespace tooljoint::path
