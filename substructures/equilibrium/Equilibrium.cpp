// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/equilibrium/Equilibrium.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>
#include <string>

#include "common/Error.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::equilibrium {
namespace {

/// Tolerance of the intermediate stages; their result is the start of the next stage. Below it long
/// hanging strings hardly move, but need a hundred iterations to reach 1e-6.
constexpr double kStageTolerance = 1e-4;
/// Contact regularisations of the stages before that of the deck [1/m].
constexpr std::array<double, 3> kLambdaStages{1e3, 1e4, 1e6};

std::string shortNumber(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%.3g", value);
  return text;
}

/// The line searches tried in turn from the same start. Without friction the forces have a
/// potential, and the work of a step measures its progress; with friction full steps converge best.
using Searches = std::vector<model::LineSearch>;
const Searches minimising{model::LineSearch::Work, model::LineSearch::None};
const Searches following{model::LineSearch::None, model::LineSearch::Work};
const Searches inTheOpen{model::LineSearch::None, model::LineSearch::Residual};
const Searches fullSteps{model::LineSearch::None};

/// Runs the stages of a recipe on one problem and records them.
class Stages {
 public:
  Stages(StaticProblem& problem, const StaticOptions& options, const model::NonlinearSolver& solve,
         int halvings = mostHalvings)
      : problem_(problem), options_(options), solve_(solve), halvings_(halvings) {}

  /// One stage from x.
  void run(const std::string& name, const StaticSwitches& switches, double tolerance,
           const Searches& searches, Vector& x) {
    if (tryRun(name, switches, tolerance, searches, x)) return;
    throw ConvergenceError(complaint(std::max(options_.tolerance, tolerance)) + message_);
  }

  /// The same; returns false and restores x when the stage does not converge.
  bool tryRun(const std::string& name, const StaticSwitches& switches, double tolerance,
              const Searches& searches, Vector& x) {
    problem_.set(switches);
    for (const model::LineSearch search : searches) {
      Vector end = x;
      if (!attempt(name, tolerance, search, end)) continue;
      x = end;
      return true;
    }
    return false;
  }

  /// Name of the stage at a value; also sets the switches.
  using StageAt = std::function<std::string(double, StaticSwitches&)>;

  /// Stages from the present value `from` to `to`. If a stage does not converge, intermediate
  /// values are inserted: at equal ratios or, from 0, at equal distances.
  void march(double from, double to, double tolerance, const StageAt& stage,
             StaticSwitches switches, const Searches& searches, Vector& x) {
    march(from, to, tolerance, stage, switches, searches, x, halvings_);
  }

  /// A solve outside of the stages.
  void add(const StageReport& stage) {
    report_.stages.push_back(stage);
    report_.iterations += stage.iterations;
    report_.residual = stage.residual;
  }

  StaticReport report() const {
    StaticReport done = report_;
    done.converged = true;
    return done;
  }

 private:
  void march(double from, double to, double tolerance, const StageAt& stage,
             StaticSwitches switches, const Searches& searches, Vector& x, int halvings) {
    const std::string name = stage(to, switches);
    if (halvings == 0) return run(name, switches, tolerance, searches, x);
    if (tryRun(name, switches, tolerance, searches, x)) return;
    const double between = from > 0.0 ? std::sqrt(from * to) : 0.5 * to;
    march(from, between, tolerance, stage, switches, searches, x, halvings - 1);
    march(between, to, tolerance, stage, switches, searches, x, halvings - 1);
  }

  bool attempt(const std::string& name, double tolerance, model::LineSearch search, Vector& x) {
    model::SolveRequest request;
    request.what = "the static equilibrium (" + name + ")";
    request.tolerance = std::max(options_.tolerance, tolerance);
    request.maxIterations = options_.maxIterations;
    request.search = search;
    const model::SolveOutcome outcome = solve_(problem_, x, request);
    add({name, outcome.iterations, outcome.residual});
    message_ = outcome.message;
    return outcome.converged && x.allFinite();
  }

  std::string complaint(double tolerance) const {
    std::string text = "The static equilibrium did not converge to " + shortNumber(tolerance) +
                       " of the largest load. Stages: ";
    for (const StageReport& stage : report_.stages)
      text += stage.name + " (" + std::to_string(stage.iterations) + " iterations, residual " +
              shortNumber(stage.residual) + "), ";
    return text + (options_.recipe == Recipe::Source
                       ? "by the recipe \"Source\". Set /Static/Recipe to \"Continuation\". "
                       : "by the recipe \"Continuation\". Raise /Static/Max Iterations or "
                         "/Static/Friction Steps, reduce /Static/Lateral Step Limit, or check that "
                         "the supports and the well can carry the loads. ");
  }

  StaticProblem& problem_;
  const StaticOptions& options_;
  const model::NonlinearSolver& solve_;
  int halvings_;
  StaticReport report_;
  std::string message_;
};

/// The string fixed on the axis: tension and torque of the loads, no lateral motion. At D = 0 a
/// long string has no stabilising tension, and the first Newton step would move it far through the
/// wall.
Vector heldOnAxis(StaticProblem& problem, StaticSwitches switches) {
  switches.geometricStiffness = switches.contact = false;
  problem.set(switches);
  const Vector zero = Vector::Zero(problem.size());
  Vector negativeLoad;
  Sparse stiffness;
  problem.residual(zero, negativeLoad);
  problem.jacobian(zero, stiffness);
  const double stiff = 1e6 * Vector(stiffness.diagonal()).cwiseAbs().maxCoeff();
  for (const int i : problem.lateralUnknowns()) stiffness.coeffRef(i, i) += stiff;
  return linalg::DirectSolver(stiffness, [&problem](int i) { return problem.unknownName(i); })
      .solve(-negativeLoad);
}

/// Contacts from soft to stiff: first the stages that are softer than the stiffest law of the
/// model, then the law of each point. Each stage limits the wall stiffness such that the largest
/// load presses a point in by 1/lambda, the length over which its law is regularised.
void sharpen(const StaticInput& input, StaticProblem& problem, Stages& stages,
             const StaticSwitches& switches, double tolerance, Vector& x) {
  const contact::ContactPoints& points = input.contact->points();
  const double sharpest = *std::max_element(points.lambdaK.begin(), points.lambdaK.end());
  const double stiffest = *std::max_element(points.stiffness.begin(), points.stiffness.end());
  const auto sharpness = [&](double lambda, StaticSwitches& with) {
    const bool own = lambda >= sharpest;
    with.lambda = own ? 0.0 : lambda;
    with.stiffnessScale = own ? 1.0 : std::min(1.0, problem.largestLoad() * lambda / stiffest);
    return "lambda " + shortNumber(lambda) + " 1/m";
  };
  std::vector<double> values;
  for (const double lambda : kLambdaStages)
    if (lambda < sharpest) values.push_back(lambda);
  values.push_back(sharpest);
  double last = 0.1 * values.front();
  for (const double lambda : values) {
    stages.march(last, lambda, lambda < sharpest ? kStageTolerance : tolerance, sharpness, switches,
                 minimising, x);
    last = lambda;
  }
}

bool hasFriction(const StaticInput& input) {
  return !input.contact->points().frictionless() && input.sliding.any();
}

/// Friction in equal steps.
void slide(const StaticOptions& options, Stages& stages, const StaticSwitches& switches,
           Vector& x) {
  const double steps = options.frictionSteps;
  const auto friction = [](double scale, StaticSwitches& with) {
    with.frictionScale = scale;
    return shortNumber(scale) + " of the friction";
  };
  for (int step = 1; step <= options.frictionSteps; ++step)
    stages.march((step - 1) / steps, step / steps,
                 step < options.frictionSteps ? kStageTolerance : 0.0, friction, switches,
                 following, x);
}

/// Adds the attraction of open points to the wall, for laws that have it. If the string has no
/// equilibrium under it, the text of the ConvergenceError names the attraction.
void letPull(const StaticInput& input, Stages& stages, const StaticSwitches& switches, Vector& x) {
  const auto pull = [](double share, StaticSwitches& with) {
    with.pull = share;
    return share < 1.0 ? shortNumber(share) + " of the attraction on open points"
                       : std::string("the complete contact law");
  };
  try {
    stages.march(0.0, 1.0, 0.0, pull, switches, following, x);
  } catch (const ConvergenceError& error) {
    throw ConvergenceError(
        std::string(error.what()) +
        " The equilibrium without attraction was found. The contact law attracts every open point "
        "to the wall with up to " +
        shortNumber(input.contact->largestPull()) +
        " N. Raise /Contact/Stiffness Regularisation, or set /Contact/Law to \"Clamped\", which "
        "has "
        "no attraction.");
  }
}

/// Friction in steps, then the attraction of the contact laws.
void addFriction(const StaticInput& input, const StaticOptions& options, Stages& stages,
                 StaticSwitches switches, Vector& x) {
  if (hasFriction(input)) slide(options, stages, switches, x);
  switches.frictionScale = 1.0;
  if (input.contact->largestPull() > 0.0) letPull(input, stages, switches, x);
}

/// The string fixed on the axis; then contact from soft to stiff, without attraction and friction;
/// then friction in steps; then the attraction of the contact laws. The limit on lateral motion
/// keeps the first steps inside the hole.
void continuation(const StaticInput& input, const StaticOptions& options, StaticProblem& problem,
                  Stages& stages, StaticSwitches switches, Vector& x) {
  if (input.contact == nullptr || input.contact->size() == 0) {
    stages.run("no contact", switches, 0.0, inTheOpen, x);
    return;
  }
  x = heldOnAxis(problem, switches);
  switches.lateralStepLimit = options.lateralStepLimit;
  switches.slideAlongWall = true;
  switches.frictionScale = switches.pull = 0.0;
  sharpen(input, problem, stages, switches, hasFriction(input) ? kStageTolerance : 0.0, x);
  addFriction(input, options, stages, switches, x);
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
  const linalg::DirectSolver solver(stiffness,
                                    [&problem](int i) { return problem.unknownName(i); });
  x = solver.solve(-negativeLoad);
  switches.geometricStiffness = false;
  stages.run("without geometric stiffness", switches, geometric ? kStageTolerance : 0.0, fullSteps,
             x);
  if (!geometric) return;
  switches.geometricStiffness = true;
  stages.run("with geometric stiffness", switches, 0.0, fullSteps, x);
}

/// Contact forces, gaps and the count of touching nodes.
void describeContact(const StaticInput& input, const StaticProblem& problem, StaticState& state) {
  const int nodes = input.nodes;
  state.normalForce = state.tangentialForce = state.frictionTorque = Vector::Zero(nodes);
  state.axialFriction = state.normalForce;
  state.contactForce = Matrix::Zero(2, nodes);
  state.gap = Vector::Constant(nodes, -std::numeric_limits<double>::infinity());
  if (input.contact == nullptr) return;
  Vector forces;
  Vector normal;
  problem.contactForces(state.displacement, forces, normal);
  const contact::ContactPoints& points = input.contact->points();
  for (int p = 0; p < points.size(); ++p) {
    const auto i = static_cast<std::size_t>(p);
    const int n = points.node[i] - 1;
    const Eigen::Vector2d offset = input.contact->offset(p);
    const double u = state.displacement(6 * n) + offset.x();
    const double v = state.displacement(6 * n + 1) + offset.y();
    const double r = std::hypot(u, v);
    state.gap(n) = r - points.clearance[i];
    state.normalForce(n) = normal(p);
    // component along t = (-v, u)/r
    const auto force =
        forces.segment<contact::StaticContact::kForces>(contact::StaticContact::kForces * p);
    state.tangentialForce(n) = r > 0.0 ? (u * force(1) - v * force(0)) / r : 0.0;
    state.frictionTorque(n) = force(3);
    state.axialFriction(n) = force(2);
    state.contactForce.col(n) = force.head<2>();
    const auto dof = static_cast<std::size_t>(6 * n);
    if ((input.held[dof] == 0 || input.held[dof + 1] == 0) && state.gap(n) > 0.0)
      ++state.contactNodes;
    state.totalNormalForce += normal(p);
    state.totalFrictionTorque += force(3);
    if (normal(p) > state.maxNormalForce) {
      state.maxNormalForce = normal(p);
      state.maxNormalForceNode = n + 1;
    }
  }
}

/// A torque below that of the largest axial force at this lever [m] is within rounding.
constexpr double leastLever = 1e-6;

/// Torques about the axis of the string. Elastic forces do not resist an equal spin of all
/// sections, so the torque at the top balances loads, friction and supports below.
void describeTorque(const StaticInput& input, StaticState& state) {
  state.topTorque = state.torque(0);
  for (int n = 1; n < input.nodes; ++n) {
    const int dof = 6 * n + 5;
    state.appliedTorque += input.load(dof);
    if (input.held[static_cast<std::size_t>(dof)] != 0) state.appliedTorque += state.reaction(dof);
  }
  for (const StaticElement& element : input.elements)
    state.torqueScale = std::max(state.torqueScale, element.bendingMoment);
  const double pull = state.axialForce.size() > 0 ? state.axialForce.cwiseAbs().maxCoeff() : 0.0;
  state.torqueScale =
      std::max({state.torqueScale, leastLever * pull,
                std::abs(state.appliedTorque) + state.frictionTorque.cwiseAbs().sum()});
}

bool movesAlongTheWell(const StaticInput& input) {
  for (int n = 0; n < input.nodes; ++n)
    if (input.held[static_cast<std::size_t>(6 * n + beam::nodal::w)] == 0) return true;
  return false;
}

StaticSwitches switchesOf(const StaticInput& input, const StaticOptions& options) {
  StaticSwitches switches;
  switches.geometricStiffness = input.geometricStiffness && options.geometricStiffness;
  switches.exactJacobian = options.exactJacobian;
  return switches;
}

}  // namespace

StaticState describe(const StaticInput& input, const StaticProblem& problem,
                     const Vector& displacement) {
  StaticState state;
  state.displacement = displacement;
  const int elements = static_cast<int>(input.elements.size());
  state.axialForce.resize(elements);
  state.torque.resize(elements);
  state.geometricStiffness.reserve(input.elements.size());
  for (int e = 0; e < elements; ++e) {
    state.axialForce(e) = problem.elements().axialForce(e, displacement);
    state.torque(e) = problem.elements().torque(e, displacement);
    state.geometricStiffness.push_back(problem.geometricStiffness(e, displacement));
  }
  state.compressedElements = static_cast<int>((state.axialForce.array() < 0.0).count());
  state.topAxialForce = state.axialForce(0);
  state.lastElementAxialForce = state.axialForce(elements - 1);
  state.lastElementTorque = state.torque(elements - 1);
  describeContact(input, problem, state);
  state.reaction = problem.unbalanced(displacement);
  for (std::size_t dof = 0; dof < input.held.size(); ++dof)
    if (input.held[dof] == 0) state.reaction(static_cast<int>(dof)) = 0.0;
  if (movesAlongTheWell(input)) state.hookLoad = -state.reaction(beam::nodal::w);
  describeTorque(input, state);
  return state;
}

StaticState leaveUnstable(const StaticInput& input, const StaticOptions& options,
                          const model::NonlinearSolver& solve, const StaticState& from,
                          const UnstableMode& mode) {
  StaticProblem problem(input);
  auto switches = switchesOf(input, options);
  switches.slideAlongWall = true;
  switches.lateralStepLimit = options.lateralStepLimit;
  problem.set(switches);
  Stages stages(problem, options, solve);
  Vector x = problem.restrict(from.displacement);
  const auto settled = settle(input, problem, mode, options.tolerance, solve, x);
  stages.add({"along the unstable mode", settled.iterations, settled.residual});
  addFriction(input, options, stages, switches, x);
  StaticState state = describe(input, problem, problem.expand(x));
  state.report = stages.report();
  state.report.iterations += from.report.iterations;
  return state;
}

std::optional<StaticState> slideStatic(const StaticInput& input, const StaticOptions& options,
                                       const SlideRequest& asked, const Vector& start) {
  StaticProblem problem(input);
  auto switches = switchesOf(input, options);
  switches.lateralStepLimit = options.lateralStepLimit;
  switches.slideAlongWall = true;
  switches.pull = asked.pull;
  switches.frictionScale = asked.frictionScale;
  problem.set(switches);
  Vector x = problem.restrict(start);
  const Slide slide = slideToRest(input, problem, asked, x);
  if (!slide.rests) return std::nullopt;
  StaticState state = describe(input, problem, problem.expand(x));
  state.report.stages.push_back({"sliding to rest", slide.iterations, slide.residual});
  state.report.iterations = slide.iterations;
  state.report.residual = slide.residual;
  state.report.converged = true;
  return state;
}

StaticState solveStatic(const StaticInput& input, const StaticOptions& options,
                        const model::NonlinearSolver& solve, int halvings) {
  StaticProblem problem(input);
  const auto switches = switchesOf(input, options);
  Stages stages(problem, options, solve, halvings);
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
