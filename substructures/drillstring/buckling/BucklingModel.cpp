// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/buckling/BucklingModel.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <string>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/scene/RestProblem.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"

namespace tooljoint::drillstring {

namespace nodal = beam::nodal;

namespace {

/// Relative size of the last Newton step after a jump.
constexpr double smallUpdate = 1e-8;
/// Steps to make the string crooked, before the weight grows.
constexpr int stepsOfBending = 1000;

/// The scene without motion and without weight on bit.
Scene atRest(const Scene& scene) {
  Scene still = scene;
  Teuchos::ParameterList list = scene.list().sublist("Loads");
  list.set("Weight On Bit", 0.0);
  list.remove("Unbalance", false);
  still.loads = loads::readLoads(list);
  still.rotary = {};
  still.statics.friction = equilibrium::FrictionRule::None;
  still.bit.reset();
  still.topDrive = {};
  return still;
}

const Scene& checked(const Scene& scene) {
  const auto refuse = [&](const std::string& path, const std::string& sentence) {
    throw DeckError(scene.deck.error(path, sentence));
  };
  if (!scene.contact || scene.contactPoints.size() == 0)
    throw DeckError(scene.deck.file() +
                    ": buckling needs contact with the wall of the hole. Add the list Contact.");
  if (!scene.list().isSublist("Loads"))
    throw DeckError(
        scene.deck.file() +
        ": the string has no loads. Add the list Loads; with Gravity 0 it has no weight.");
  if (!scene.statics.geometricStiffness)
    refuse("Static/Geometric Stiffness",
           "is false, but buckling needs geometric stiffness. Leave it out.");
  if (scene.held[at(nodal::perNode * (scene.string.nodeCount() - 1) + nodal::w)] != 0)
    refuse("Supports/Bit",
           "holds w, so that the weight on bit cannot move the bit. Release w of the bit and hold "
           "that of Top.");
  return scene;
}

}  // namespace

BucklingModel::BucklingModel(const Scene& scene, double last)
    : scene_(atRest(checked(scene))),
      path_(bendIntoWell(scene_)),
      input_(restProblem(scene_, path_, equationsOnPath(scene_, path_), {}, scene_.contactPoints,
                         scene_.statics.reference)),
      last_(last) {
  load_.direction = Vector::Zero(nodal::perNode * input_.nodes);
  load_.direction(nodal::perNode * (input_.nodes - 1) + nodal::w) = -1.0;
  load_.contained = load_.scale = last;  // the largest load is the scale of the residual
  load_.pathWeights = pathWeights();
  input_.load += last * load_.direction;
}

Vector BucklingModel::start(const equilibrium::LoadPath& problem) const {
  auto input = input_;
  input.load -= load_.contained * load_.direction;
  auto options = scene_.statics;
  options.tolerance *= std::max(
      1.0, problem.problem().largestLoad() / equilibrium::StaticProblem(input).largestLoad());
  return problem.problem().restrict(
      equilibrium::solveStatic(input, options, staticSolver(scene_)).displacement);
}

void BucklingModel::bend(double amplitude, double pitch, statics::PathOptions options, Vector& x) {
  const Vector lateral = crooked(amplitude, pitch);
  auto input = input_;
  input.load += lateral - load_.contained * load_.direction;
  auto growing = load_;
  growing.direction = lateral;
  growing.contained = growing.scale = 1.0;
  options.from = 0.0, options.to = 1.0;
  options.maxSteps = stepsOfBending;  // the deck's limit counts steps of the weight
  const equilibrium::LoadPath bending(input, growing);
  options.tolerance *= std::max(1.0, scaleOfPath() / bending.problem().largestLoad());
  const auto report =
      statics::followPath(bending, x, options, [&](const statics::PathPoint& point) {
        x = point.x;
        return true;
      });
  if (report.end != statics::PathEnd::Reached)
    throw ConvergenceError("The state of the crooked string without weight on bit was not found: " +
                           report.explanation + " Reduce Buckling/Crookedness.");
  input_.load += lateral;
}

void BucklingModel::setCrooked(double amplitude, double pitch) {
  input_.load += crooked(amplitude, pitch);
}

void BucklingModel::unload() {
  // the load of the last weight is part of the input
  load_.direction = -load_.direction;
  load_.contained = 0.0;
  unloads_ = true;
}

Vector BucklingModel::jump(const equilibrium::LoadPath& problem, const Vector& x,
                           const Vector& towards, double p) const {
  auto input = input_;
  input.load += (p - load_.contained) * load_.direction;
  equilibrium::StaticProblem rest(input);
  auto switches = problem.problem().switches();
  switches.lateralStepLimit = scene_.statics.lateralStepLimit;
  switches.slideAlongWall = true;
  rest.set(switches);
  Vector found = x;
  equilibrium::settle(input, rest, unstableMode(problem, x, towards), scene_.statics.tolerance,
                      staticSolver(scene_), found);
  // motions with little resistance, as the rotation of a helix about the axis of a vertical hole,
  // leave a small residual far from the state, so the update is checked too
  model::SolveRequest request;
  request.what = "the state after a jump";
  request.tolerance = scene_.statics.tolerance;
  request.updateTolerance = smallUpdate;
  request.maxIterations = scene_.statics.maxIterations;
  request.search = model::LineSearch::Work;
  const auto outcome = staticSolver(scene_)(rest, found, request);
  if (!outcome.converged)
    throw ConvergenceError("The state after a jump of the string was not found: " +
                           outcome.message);
  return found;
}

/// Lateral motion in clearances, root mean square along the string.
Vector BucklingModel::pathWeights() const {
  Vector weights = Vector::Zero(nodal::perNode * input_.nodes);
  const auto& string = scene_.string;
  for (int e = 0; e < string.elementCount(); ++e)
    for (const int n : {e, e + 1}) {
      const double r = string.nodes[at(n)].clearance;
      if (!(r > 0.0)) continue;
      const double share = 0.5 * string.elements[at(e)].length() / (string.length() * r * r);
      weights(nodal::perNode * n + nodal::u) += share;
      weights(nodal::perNode * n + nodal::v) += share;
    }
  return weights;
}

/// A lateral load that deflects a straight string into the shape, to first order: E I q^4 A (cos q
/// s, sin q s) per length, q = 2 pi/pitch.
Vector BucklingModel::crooked(double amplitude, double pitch) const {
  Vector load = Vector::Zero(nodal::perNode * input_.nodes);
  const auto depth = scene_.string.depths();
  const double q = constants::twoPi / pitch;
  for (int e = 0; e < scene_.string.elementCount(); ++e) {
    const auto& element = scene_.string.elements[at(e)];
    const auto& section = element.section();
    const double EI = section.youngModulus() * section.inertiaX();
    for (const int n : {e, e + 1}) {
      const double force = 0.5 * element.length() * EI * std::pow(q, 4) * amplitude;
      load(nodal::perNode * n + nodal::u) += force * std::cos(q * depth[at(n)]);
      load(nodal::perNode * n + nodal::v) += force * std::sin(q * depth[at(n)]);
    }
  }
  return load;
}

equilibrium::UnstableMode BucklingModel::unstableMode(const equilibrium::LoadPath& problem,
                                                      const Vector& x,
                                                      const Vector& towards) const {
  auto equations = equationsOnPath(scene_, path_).model;
  equations.held = input_.held;
  const Sparse mass = assemble(equations).mass;
  const auto modes = linalg::lowestModes(problem.symmetricTangent(x), mass, 2);
  equilibrium::UnstableMode mode;
  const Vector shape = modes.vectors.col(0);
  mode.shape = problem.problem().expand(shape.dot(towards) < 0.0 ? Vector(-shape) : shape);
  mode.mass = problem.problem().expand(mass.diagonal());
  // the string has just become unstable here; during the jump it is less stable
  mode.growthRate = std::sqrt(modes.values.cwiseAbs().maxCoeff());
  return mode;
}

}  // namespace tooljoint::drillstring
