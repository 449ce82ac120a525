// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffString.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

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
/// Iterations in which Newton's method finds the state of a string that does not buckle.
constexpr int nearIterations = 60;
/// Times that a string is disturbed again because it rests in an unstable state.
constexpr int mostDisturbances = 3;
/// Residual where a part of them is on.
constexpr double slidingTolerance = 1e-5;
/// Iterations of a string that slides to rest, over Static/Max Iterations.
constexpr int slidingEffort = 6;
/// Helix that disturbs the string before each part: of the clearance, and its pitch [m], two to
/// four half waves of drill pipe that buckles. The motion picks out the waves that grow; one of
/// their own length winds a string with a stable sinusoidal state into a helix.
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
  mass_ = Vector::Zero(perNode * scene_.string.nodeCount());
  for (int e = 0; e < equations_.model.elements(); ++e)
    mass_.segment<2 * perNode>(perNode * e) += equations_.model.mass[at(e)].diagonal();
  frictionless_ = hangingFree();
}

/// The displacement without friction. A string on the axis of a long level hole has next to nothing
/// that resists sideways: where the stages of the static state fail, it slides down from there
/// against viscous forces.
Vector StiffString::hangingFree() const {
  const auto free = input({});
  try {
    return equilibrium::solveStatic(free, scene_.statics, staticSolver(scene_)).displacement;
  } catch (const ConvergenceError&) {
    equilibrium::SlideRequest request;
    request.mass = mass_;
    request.tolerance = scene_.statics.tolerance;
    request.mostIterations = slidingEffort * scene_.statics.maxIterations;
    request.stop = [](const Vector&) { return interruptRequested(); };
    const auto slid =
        equilibrium::slideStatic(free, scene_.statics, request, Vector::Zero(mass_.size()));
    if (interruptRequested()) throw InterruptedError("Interrupted.");
    if (!slid) throw;
    return slid->displacement;
  }
}

equilibrium::StaticInput StiffString::input(const softstring::Operation& operation) const {
  auto input = restProblem(scene_, path_, equations_, {operation.axialSpeed, operation.rotarySpeed},
                           points_, equilibrium::Reference::Hanging);
  const int bit = perNode * (input.nodes - 1);
  input.load(bit + w) -= operation.weightOnBit;
  input.load(bit + thetaZ) -= operation.torqueOnBit;
  return input;
}

StiffString::Part StiffString::part(const softstring::Operation& operation, double share) const {
  auto reduced = operation;
  reduced.weightOnBit *= share, reduced.torqueOnBit *= share;
  return {input(reduced), share};
}

/// The state of rest next to `start`, and the negative pivots of its tangent: by Newton's method,
/// or against the viscous forces of alpha. None within few iterations, as of a string that buckles.
std::optional<StiffString::Rest> StiffString::near(const Part& part, const Vector& start,
                                                   double tolerance, double alpha,
                                                   int& iterations) const {
  equilibrium::SlideRequest request;
  request.mass = mass_;
  request.frictionScale = part.share;
  request.tolerance = tolerance;
  request.alpha = alpha;
  request.mostIterations = nearIterations;
  request.stop = [](const Vector&) { return interruptRequested(); };
  auto state = equilibrium::slideStatic(part.input, scene_.statics, request, start);
  iterations += state ? state->report.iterations : nearIterations;
  if (!state) return std::nullopt;
  const int pivots = equilibrium::negativePivots(part.input, state->displacement).value_or(0);
  return Rest{std::move(*state), pivots};
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

/// With weight on bit and friction in equal parts, from the largest number of them at which the
/// string does not buckle. None where it does not come to rest: `why`.
std::optional<StiffString::Rest> StiffString::slide(const softstring::Operation& operation,
                                                    StiffLoads& why) const {
  Vector x = frictionless_;
  int stable = 0;
  for (int parts = slidingSteps / 2; parts > 0; parts /= 2)
    if (const auto rest = near(part(operation, double(stable + parts) / slidingSteps), x,
                               slidingTolerance, 0.0, why.iterations);
        rest && rest->negativePivots == 0) {
      stable += parts;
      x = rest->state.displacement;
    }
  equilibrium::SlideRequest request;
  request.mass = mass_;
  request.mostIterations = slidingEffort * scene_.statics.maxIterations;
  int again = mostDisturbances;
  for (int step = stable + 1;;) {
    const Part loaded = part(operation, double(step) / slidingSteps);
    const equilibrium::StaticProblem problem(loaded.input);
    request.frictionScale = loaded.share;
    request.tolerance = step < slidingSteps ? slidingTolerance : scene_.statics.tolerance;
    request.stop = [&](const Vector& full) {
      why.locksUp = compressed(problem, full);
      return why.locksUp || interruptRequested();
    };
    auto slid = equilibrium::slideStatic(loaded.input, scene_.statics, request, withHelix(x));
    if (interruptRequested()) throw InterruptedError("Interrupted.");
    if (!slid) {
      why.unsettled = tooLong(
          Vector::Constant(scene_.string.elementCount(), -operation.weightOnBit * loaded.share));
      if (!why.unsettled.empty())
        why.locksUp = false;
      else if (why.locksUp)
        why.unsettled = "It locks up.";
      else
        why.unsettled = "It buckles and does not come to rest within " +
                        std::to_string(slidingEffort * scene_.statics.maxIterations) +
                        " iterations. Raise Static/Max Iterations.";
      return std::nullopt;
    }
    why.unsettled = tooLong(slid->axialForce);
    if (!why.unsettled.empty()) return std::nullopt;
    x = slid->displacement;
    request.mostIterations -= slid->report.iterations;
    why.iterations += slid->report.iterations;
    if (step < slidingSteps) {
      ++step;
      continue;
    }
    const int pivots = equilibrium::negativePivots(loaded.input, x).value_or(0);
    if (pivots == 0 || again-- == 0) return Rest{std::move(*slid), pivots};
  }
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
  const Part whole = part(operation, 1.0);
  const double tolerance = scene_.statics.tolerance;
  auto rest = near(whole, frictionless_, tolerance, 0.0, loads.iterations);
  if (!rest)
    rest = near(whole, frictionless_, tolerance, equilibrium::slidingAlpha, loads.iterations);
  if (!rest || rest->negativePivots > 0) {
    auto slid = slide(operation, loads);
    loads.buckled = slid.has_value();
    if (!rest || loads.locksUp) loads.failure = loads.unsettled;
    if (slid) rest = std::move(slid);
  }
  if (!loads.found()) return loads;
  loads.negativePivots = rest->negativePivots;
  const auto& problemInput = whole.input;
  const equilibrium::StaticState& state = rest->state;
  // the hook and the rotary table hold the first node
  const Vector reaction = equilibrium::StaticProblem(problemInput).unbalanced(state.displacement);
  loads.hookLoad = -reaction(w);
  loads.surfaceTorque = reaction(thetaZ);
  loads.twist = -state.displacement(perNode * (problemInput.nodes - 1) + thetaZ);
  loads.torqueDefect = state.relativeTorqueDefect();
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
