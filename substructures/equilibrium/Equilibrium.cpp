// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/equilibrium/Equilibrium.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "common/Error.hpp"
#include "linalg/DirectSolver.hpp"

namespace tooljoint::equilibrium {
namespace {

/// Accuracy of the stages that only lead to the next one.
constexpr double kStageTolerance = 1e-6;

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// Runs the stages of a recipe on one problem and keeps the account.
class Stages {
 public:
  Stages(StaticProblem& problem, const StaticOptions& options, const model::NonlinearSolver& solve)
      : problem_(problem), options_(options), solve_(solve) {}

  /// One stage from x; `rescue` allows a second attempt from the same start with a line search.
  void run(const std::string& name, const StaticSwitches& switches, double tolerance, bool rescue, Vector& x) {
    if (tryRun(name, switches, tolerance, rescue, x)) return;
    throw ConvergenceError(complaint(std::max(options_.tolerance, tolerance)) + message_);
  }

  /// The same; false when it does not converge.
  bool tryRun(const std::string& name, const StaticSwitches& switches, double tolerance, bool rescue, Vector& x) {
    problem_.set(switches);
    const Vector start = x;
    if (attempt(name, tolerance, false, x)) return true;
    x = start;
    return rescue && attempt(name + ", line search", tolerance, true, x);
  }

  /// Stages from where x is (`from`) to `to`; where one does not converge, by way of what lies between: at equal ratios or, from
  /// 0, at equal distances. \param stage  switches and name for a value
  void march(double from, double to, double tolerance, const std::function<std::string(double, StaticSwitches&)>& stage,
             StaticSwitches switches, Vector& x, int cuts = 5) {
    const std::string name = stage(to, switches);
    const Vector start = x;
    if (cuts == 0) return run(name, switches, tolerance, true, x);
    if (tryRun(name, switches, tolerance, cuts == 5, x)) return;
    x = start;
    const double between = from > 0.0 ? std::sqrt(from * to) : 0.5 * to;
    march(from, between, kStageTolerance, stage, switches, x, cuts - 1);
    march(between, to, tolerance, stage, switches, x, cuts - 1);
  }

  StaticReport report() const {
    StaticReport done = report_;
    done.converged = true;
    return done;
  }

 private:
  bool attempt(const std::string& name, double tolerance, bool backtracking, Vector& x) {
    model::SolveRequest request;
    request.what = "the static equilibrium (" + name + ")";
    request.tolerance = std::max(options_.tolerance, tolerance);
    request.maxIterations = options_.maxIterations;
    request.backtracking = backtracking;
    const model::SolveOutcome outcome = solve_(problem_, x, request);
    report_.stages.push_back({name, outcome.iterations, outcome.residual});
    report_.iterations += outcome.iterations;
    report_.residual = outcome.residual;
    message_ = outcome.message;
    return outcome.converged && x.allFinite();
  }

  std::string complaint(double tolerance) const {
    std::string text = "The static equilibrium did not converge to " + shortNumber(tolerance) + " of the largest load; tried ";
    for (const StageReport& stage : report_.stages)
      text += stage.name + " (" + std::to_string(stage.iterations) + " iterations, residual " + shortNumber(stage.residual) + "), ";
    return text + (options_.recipe == Recipe::Source
                       ? "by the recipe \"Source\". Use /Static/Recipe \"Continuation\". "
                       : "by the recipe \"Continuation\". Allow more /Static/Max Iterations or /Static/Friction Steps, a shorter "
                         "/Static/Lateral Step Limit, or check that the supports and the well can carry the loads. ");
  }

  StaticProblem& problem_;
  const StaticOptions& options_;
  const model::NonlinearSolver& solve_;
  StaticReport report_;
  std::string message_;
};

/// The string held on the axis: tension and torque of the loads, no lateral motion. From D = 0 a long string has no tension
/// yet to hold it, and the first Newton step would throw it far through the wall.
Vector heldOnAxis(StaticProblem& problem, StaticSwitches switches) {
  switches.geometricStiffness = switches.contact = false;
  problem.set(switches);
  const Vector zero = Vector::Zero(problem.size());
  Vector negativeLoad;
  Sparse stiffness;
  problem.residual(zero, negativeLoad);
  problem.jacobian(zero, stiffness);
  const double stiff = 1e6 * Matrix(stiffness.diagonal()).cwiseAbs().maxCoeff();
  for (int i = 0; i < problem.size(); ++i)
    if (problem.isLateral(i)) stiffness.coeffRef(i, i) += stiff;
  return linalg::DirectSolver(stiffness, [&problem](int i) { return problem.unknownName(i); }).solve(-negativeLoad);
}

/// Contacts from soft to sharp, while they are softer than the sharpest law of the scene. False when a stage does not converge:
/// the tails of soft contacts pull with k/(pi^2 lambda), too much for light pipe.
bool sharpen(const StaticOptions& options, double sharpest, Stages& stages, StaticSwitches switches, Vector& x) {
  for (const double lambda : options.lambdas) {
    if (lambda >= sharpest) break;
    switches.lambda = lambda;
    if (!stages.tryRun("lambda " + shortNumber(lambda) + " 1/m", switches, kStageTolerance, true, x)) return false;
  }
  return true;
}

/// Walls from yielding to stiff, without tails; then contacts from sharp to their own.
void harden(double sharpest, Stages& stages, StaticSwitches switches, Vector& x) {
  constexpr double sharp = 1e6;
  switches.lambda = sharp;
  const auto hard = [](double scale, StaticSwitches& with) {
    with.stiffnessScale = scale;
    return shortNumber(scale) + " of the wall stiffness";
  };
  double last = 1e-4;
  for (const double scale : {1e-4, 1e-3, 1e-2, 0.1, 1.0}) {
    stages.march(last, scale, kStageTolerance, hard, switches, x);
    last = scale;
  }
  switches.stiffnessScale = 1.0;
  if (sharpest <= sharp) return;
  stages.march(sharp, sharpest, kStageTolerance, [](double lambda, StaticSwitches& with) {
    with.lambda = lambda;
    return "lambda " + shortNumber(lambda) + " 1/m";
  }, switches, x);
}

/// Held on the axis; lambda up to each point's own without friction, then friction in steps. The cap on lateral motion is what makes
/// it robust: at small lambda the tails of the contact law pull open nodes to the wall, and a line search on the residual
/// alone creeps there, so it comes second.
void continuation(const StaticInput& input, const StaticOptions& options, StaticProblem& problem, Stages& stages,
                  StaticSwitches switches, Vector& x) {
  x.setZero();
  if (input.contact == nullptr) {
    stages.run("no contact", switches, 0.0, true, x);
    return;
  }
  const contact::ContactPoints& points = input.contact->points();
  const bool friction = !points.frictionless() && input.direction != 0.0;
  const double sharpest = points.size() > 0 ? *std::max_element(points.lambdaK.begin(), points.lambdaK.end()) : 0.0;
  x = heldOnAxis(problem, switches);
  switches.lateralStepLimit = options.lateralStepLimit;
  switches.frictionScale = 0.0;
  const Vector start = x;
  if (!sharpen(options, sharpest, stages, switches, x)) {
    x = start;
    harden(sharpest, stages, switches, x);
  }
  switches.lambda = 0.0;
  stages.run("without friction", switches, friction ? kStageTolerance : 0.0, true, x);
  if (!friction) return;
  const double steps = options.frictionSteps;
  for (int step = 1; step <= options.frictionSteps; ++step)
    stages.march((step - 1) / steps, step / steps, step < options.frictionSteps ? kStageTolerance : 0.0,
                 [](double scale, StaticSwitches& with) {
                   with.frictionScale = scale;
                   return shortNumber(scale) + " of the friction";
                 }, switches, x);
}

/// D = K_pa^-1 F_s, full steps: without K_gpo (appendix A), then with it.
void asTheSource(StaticProblem& problem, Stages& stages, StaticSwitches switches, Vector& x) {
  const bool geometric = switches.geometricStiffness;
  StaticSwitches linear = switches;
  linear.geometricStiffness = linear.contact = linear.pathReaction = false;
  problem.set(linear);
  Vector negativeLoad;
  Sparse stiffness;
  problem.residual(Vector::Zero(problem.size()), negativeLoad);
  problem.jacobian(Vector::Zero(problem.size()), stiffness);
  const linalg::DirectSolver solver(stiffness, [&problem](int i) { return problem.unknownName(i); });
  x = solver.solve(-negativeLoad);
  switches.geometricStiffness = false;
  stages.run("without geometric stiffness", switches, geometric ? kStageTolerance : 0.0, false, x);
  if (!geometric) return;
  switches.geometricStiffness = true;
  stages.run("with geometric stiffness", switches, 0.0, false, x);
}

/// Contact forces, gaps and the count of touching nodes.
void describeContact(const StaticInput& input, const StaticProblem& problem, StaticState& state) {
  const int nodes = input.nodes;
  state.normalForce = state.tangentialForce = state.frictionTorque = Vector::Zero(nodes);
  state.gap = Vector::Constant(nodes, -std::numeric_limits<double>::infinity());
  if (input.contact == nullptr) return;
  Vector forces;
  Vector normal;
  problem.contactForces(state.displacement, forces, normal);
  const contact::ContactPoints& points = input.contact->points();
  for (int p = 0; p < points.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const int n = points.node[i] - 1;
    const double u = state.displacement(6 * n);
    const double v = state.displacement(6 * n + 1);
    const double r = std::hypot(u, v);
    state.gap(n) = r - points.clearance[i];
    state.normalForce(n) = normal(p);
    // component along t = (-v, u)/r
    state.tangentialForce(n) = r > 0.0 ? (u * forces(3 * p + 1) - v * forces(3 * p)) / r : 0.0;
    state.frictionTorque(n) = forces(3 * p + 2);
    const auto dof = static_cast<std::size_t>(6 * n);
    if ((input.held[dof] == 0 || input.held[dof + 1] == 0) && state.gap(n) > 0.0) ++state.contactNodes;
    state.totalNormalForce += normal(p);
    state.totalFrictionTorque += forces(3 * p + 2);
    if (normal(p) > state.maxNormalForce) {
      state.maxNormalForce = normal(p);
      state.maxNormalForceNode = n + 1;
    }
  }
}

}  // namespace

StaticState describe(const StaticInput& input, const StaticProblem& problem, const Vector& displacement) {
  StaticState state;
  state.displacement = displacement;
  const int elements = static_cast<int>(input.elements.size());
  state.axialForce.resize(elements);
  state.torque.resize(elements);
  for (int e = 0; e < elements; ++e) {
    state.axialForce(e) = problem.axialForce(e, displacement);
    state.torque(e) = problem.torque(e, displacement);
    state.geometricStiffness.push_back(problem.geometricStiffness(e, displacement));
  }
  state.compressedElements = static_cast<int>((state.axialForce.array() < 0.0).count());
  state.topAxialForce = state.axialForce(0);
  state.lastElementAxialForce = state.axialForce(elements - 1);
  state.lastElementTorque = state.torque(elements - 1);
  describeContact(input, problem, state);
  for (int n = 1; n < input.nodes; ++n) state.appliedTorque += input.load(6 * n + 5);
  state.topTorque = state.torque(0);
  state.torqueBalanceDefect = state.topTorque - state.appliedTorque - state.totalFrictionTorque;
  return state;
}

StaticState solveStatic(const StaticInput& input, const StaticOptions& options, const model::NonlinearSolver& solve) {
  StaticProblem problem(input);
  StaticSwitches switches;
  switches.geometricStiffness = input.geometricStiffness && options.geometricStiffness;
  switches.exactJacobian = options.exactJacobian;
  Stages stages(problem, options, solve);
  Vector x = Vector::Zero(problem.size());
  if (options.recipe == Recipe::Source)
    asTheSource(problem, stages, switches, x);
  else
    continuation(input, options, problem, stages, switches, x);
  StaticState state = describe(input, problem, problem.expand(x));
  state.report = stages.report();
  return state;
}

}  // namespace tooljoint::equilibrium
