// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffString.hpp"

#include <algorithm>
#include <cmath>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "deck/PrintedUnits.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/analyses/Hanging.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"
#include "substructures/drillstring/scene/RestProblem.hpp"
#include "substructures/equilibrium/LoadPath.hpp"

namespace tooljoint::drillstring {

using namespace beam::nodal;

namespace {

/// Equal parts in which weight on bit and friction come, so that the string finds the state next to
/// the one before: all at once, a string with a stable sinusoidal state winds into a helix.
constexpr int slidingSteps = 8;
/// Residual where a part of them is on.
constexpr double slidingTolerance = 1e-5;
/// Iterations of a string that slides to rest, over Static/Max Iterations.
constexpr int slidingEffort = 20;
/// Helix that disturbs the string before each part: of the clearance, and its pitch [m], two to
/// four half waves of drill pipe that buckles. The motion picks out the waves that grow.
constexpr double helixSize = 0.05, helixPitch = 25.0;
/// Elements a half wave of a helix needs.
constexpr double elementsPerHalfWave = 3.0;

}  // namespace

StiffString::StiffString(const Scene& scene, double bit)
    : scene_(hungAt(scene, bit)),
      path_(bendIntoWell(scene_)),
      equations_(equationsOnPath(scene_, path_)),
      bending_(bendingElements(scene_.string, path_)),
      points_(scene_.contactPoints.slidingFast()) {
  frictionless_ =
      equilibrium::solveStatic(input({}), scene_.statics, staticSolver(scene_)).displacement;
  // all stages together take no more than one may: a string that buckles has no state near this
  // one, and thousands of iterations do not find one
  scene_.statics.mostIterations = scene_.statics.maxIterations;
}

equilibrium::StaticInput StiffString::input(const softstring::Operation& operation) const {
  auto input = restProblem(scene_, path_, equations_, {operation.axialSpeed, operation.rotarySpeed},
                           points_, equilibrium::Reference::Hanging);
  const int bit = perNode * (input.nodes - 1);
  input.load(bit + w) -= operation.weightOnBit;
  input.load(bit + thetaZ) -= operation.torqueOnBit;
  return input;
}

/// From the string without friction; where that is too far away, by the whole way from the axis.
equilibrium::StaticState StiffString::solve(const equilibrium::StaticInput& input) const {
  const auto solver = staticSolver(scene_);
  try {
    return equilibrium::solveStaticFrom(input, scene_.statics, solver, frictionless_);
  } catch (const ConvergenceError&) {
    return equilibrium::solveStatic(input, scene_.statics, solver);
  }
}

Vector StiffString::withHelix(const Vector& displacement) const {
  Vector x = displacement;
  for (std::size_t p = 0; p < points_.node.size(); ++p) {
    const int node = points_.node[p] - 1;
    const double angle = constants::twoPi * scene_.string.nodes[at(node)].s / helixPitch;
    x(perNode * node + u) += helixSize * points_.clearance[p] * std::cos(angle);
    x(perNode * node + v) += helixSize * points_.clearance[p] * std::sin(angle);
  }
  return x;
}

/// With weight on bit and friction in equal steps. None where it does not come to rest: `why`.
std::optional<equilibrium::StaticState> StiffString::slide(const softstring::Operation& operation,
                                                           StiffLoads& why) const {
  equilibrium::SlideRequest request;
  request.mostIterations = slidingEffort * scene_.statics.maxIterations;
  request.mass = Vector::Zero(frictionless_.size());
  for (int e = 0; e < equations_.model.elements(); ++e)
    request.mass.segment<2 * perNode>(perNode * e) += equations_.model.mass[at(e)].diagonal();
  Vector x = frictionless_;
  for (int step = 1; step <= slidingSteps; ++step) {
    const double share = static_cast<double>(step) / slidingSteps;
    auto part = operation;
    part.weightOnBit *= share, part.torqueOnBit *= share;
    const auto loaded = input(part);
    const equilibrium::StaticProblem problem(loaded);
    request.frictionScale = share;
    request.tolerance = step < slidingSteps ? slidingTolerance : scene_.statics.tolerance;
    request.stop = [&](const Vector& full) {
      why.locksUp = compressed(problem, full);
      return why.locksUp || interruptRequested();
    };
    const auto slid = equilibrium::slideStatic(loaded, scene_.statics, request,
                                               staticSolver(scene_), withHelix(x));
    if (interruptRequested()) throw InterruptedError("Interrupted.");
    if (!slid) {
      why.unsettled = why.locksUp
                          ? "It locks up."
                          : "It buckles and does not come to rest within " +
                                std::to_string(slidingEffort * scene_.statics.maxIterations) +
                                " iterations. Raise Static/Max Iterations.";
      return std::nullopt;
    }
    why.unsettled = tooLong(slid->axialForce);
    if (!why.unsettled.empty()) return std::nullopt;
    if (step == slidingSteps) return slid;
    request.mostIterations -= slid->report.iterations;
    x = slid->displacement;
  }
  return std::nullopt;
}

/// A sentence where elements do not resolve half waves pi sqrt(2 E I/F) of a helix under their
/// compression F; else empty.
std::string StiffString::tooLong(const Vector& axialForce) const {
  double worst = 0.0, length = 0.0, wave = 0.0;
  for (int e = 0; e < scene_.string.elementCount(); ++e) {
    const auto& element = scene_.string.elements[at(e)];
    if (!(axialForce(e) < 0.0)) continue;
    const auto& section = element.section();
    const double half = constants::pi * std::sqrt(2.0 * section.youngModulus() *
                                                  section.inertiaX() / -axialForce(e));
    if (element.length() / half > worst)
      worst = element.length() / half, length = element.length(), wave = half;
  }
  if (worst <= 1.0 / elementsPerHalfWave) return "";
  return "It buckles, and its elements of " + deck::printed(length, "m", 2) +
         " are too long for the half waves of a helix, " + deck::printed(wave, "m", 2) +
         ". Use three or more to a half wave.";
}

/// Some element so much that the string counts as locked up.
bool StiffString::compressed(const equilibrium::StaticProblem& problem, const Vector& x) const {
  for (int e = 0; e < scene_.string.elementCount(); ++e)
    if (problem.elements().axialForce(e, x) <
        -softstring::lockedStrain * scene_.string.elements[at(e)].section().axialRigidity())
      return true;
  return false;
}

StiffLoads StiffString::under(const softstring::Operation& operation) const {
  StiffLoads loads;
  const auto problemInput = input(operation);
  const auto unstable = [&](const equilibrium::StaticState& found) {
    return equilibrium::negativePivots(problemInput, found.displacement).value_or(0);
  };
  std::optional<equilibrium::StaticState> near;
  try {
    near = solve(problemInput);
    loads.negativePivots = unstable(*near);
  } catch (const ConvergenceError& error) {
    loads.failure = error.what();
  }
  if (!near || loads.negativePivots > 0) {
    const auto slid = slide(operation, loads);
    if (!near || loads.locksUp) loads.failure = loads.unsettled;
    if (slid) {
      loads.buckled = true;
      loads.negativePivots = unstable(*slid);
      near = slid;
    }
  }
  if (!loads.found()) return loads;
  const equilibrium::StaticState& state = *near;
  // the hook and the rotary table hold the first node
  const Vector reaction = equilibrium::StaticProblem(problemInput).unbalanced(state.displacement);
  loads.hookLoad = -reaction(w);
  loads.surfaceTorque = reaction(thetaZ);
  loads.twist = -state.displacement(perNode * (problemInput.nodes - 1) + thetaZ);
  loads.torqueDefect = state.relativeTorqueDefect();
  loads.iterations = state.report.iterations;
  loads.depth = scene_.string.depths();
  loads.contactForce.assign(state.normalForce.data(),
                            state.normalForce.data() + state.normalForce.size());
  for (int e = 0; e < scene_.string.elementCount(); ++e) {
    const auto& element = scene_.string.elements[at(e)];
    const double moment = meanMoment(bending_[at(e)], at(e), state.displacement).norm();
    loads.stretch += state.axialForce(e) / element.formulation->stiffness()(w, w);
    loads.tension.push_back(state.axialForce(e));
    loads.torque.push_back(state.torque(e));
    loads.moment.push_back(moment);
  }
  return loads;
}

}  // namespace tooljoint::drillstring
