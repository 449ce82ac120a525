// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/RestProblem.hpp"

#include <algorithm>
#include <optional>
#include <string>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "statics/NoxSolver.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/contact/Eccentric.hpp"
#include "substructures/drillstring/SidedFeatures.hpp"
#include "substructures/drillstring/scene/SlidingRest.hpp"

namespace tooljoint::drillstring {
namespace {

Teuchos::ParameterList listOrEmpty(const Scene& scene, const std::string& name) {
  return scene.list().isSublist(name) ? scene.list().sublist(name) : Teuchos::ParameterList(name);
}

/// Halvings of a stage before the string slides to rest.
constexpr int halvingsBeforeSliding = 1;

/// Reason why sliding finds no static state.
struct Unsettled {
  std::string why;      ///< a sentence; empty if unknown
  bool driven = false;  ///< friction drives the string round the hole: there is no static state
};

/// The state that the string reaches by sliding, for strings that buckle in a stage of the static
/// solution; none if there is no such state.
std::optional<equilibrium::StaticState> slideToRest(const Scene& scene,
                                                    const equilibrium::StaticInput& input,
                                                    const Vector& mass,
                                                    const model::NonlinearSolver& solver,
                                                    Unsettled& unsettled) try {
  const auto problem = [&](double share) {
    auto part = input;
    const auto bit = kNodeDofs * (part.nodes - 1);
    part.load(bit + beam::nodal::w) *= share, part.load(bit + beam::nodal::thetaZ) *= share;
    return part;
  };
  const SlidingRest string(scene.string, scene.statics, mass, problem);
  const auto slid = string.from(withoutFriction(problem(0.0), scene.statics, solver, mass));
  if (!slid.rest) {
    unsettled.driven = slid.driven;
    unsettled.why =
        "The string does not come to rest. " + slid.unsettled +
        (slid.advice.empty() ? "" : " " + slid.advice) +
        (slid.driven ? " Static/Friction \"None\" gives the state without friction." : "");
    return std::nullopt;
  }
  if (!(input.contact->largestPull() > 0.0)) return slid.rest->state;
  auto pulled = string.withPull(slid.rest->state);
  if (!pulled)
    unsettled.why =
        "The string buckles, and rests only without the attraction of open points to the wall. "
        "Set Contact/Law to \"Clamped\", which has none.";
  return pulled;
} catch (const ConvergenceError&) {  // no frictionless state to slide from
  return std::nullopt;
}

}  // namespace

path::PathState bendIntoWell(const Scene& scene) {
  path::PathInput input;
  input.elements = scene.string.formulations();
  input.trajectory = &scene.well.trajectory();
  return path::computePath(input, scene.path, statics::noxSolver(listOrEmpty(scene, "Path")));
}

PathEquations equationsOnPath(const Scene& scene, const path::PathState& path) {
  auto equations = buildEquations({scene.string, scene.well, path, scene.held, scene.mud.get(),
                                   scene.rotary, scene.loads, scene.damping});
  addPads(scene.string, path, equations);
  return equations;
}

std::vector<double> hangingTension(const PathEquations& equations) {
  std::vector<double> tension(at(equations.model.elements()));
  double below = 0.0;
  for (int e = equations.model.elements(); e-- > 0;) {
    below += equations.load(kNodeDofs * (e + 1) + beam::nodal::w);
    tension[at(e)] = below;
  }
  return tension;
}

equilibrium::StaticInput restProblem(const Scene& scene, const path::PathState& path,
                                     const PathEquations& equations,
                                     const contact::Sliding& sliding,
                                     const contact::ContactPoints& points,
                                     equilibrium::Reference reference) {
  equilibrium::StaticInput input;
  input.nodes = equations.model.nodes;
  input.held = scene.heldAtRest();
  input.geometricStiffness = scene.statics.geometricStiffness;
  std::vector<double> pretension;
  if (reference == equilibrium::Reference::Hanging) pretension = hangingTension(equations);
  input.elements.reserve(at(equations.model.elements()));
  for (int e = 0; e < equations.model.elements(); ++e) {
    const auto i = at(e);
    const auto& section = scene.string.elements[i].section();
    equilibrium::StaticElement element;
    element.formulation = scene.string.elements[i].formulation;
    element.stiffness = equations.stiffness[i];
    element.rotation = beam::rotation12(path.elementFrame[i], path.frame[i], path.frame[i + 1]);
    element.slopes =
        scene.path.prestress == path::Prestress::AxialAndTorque
            ? element.rotation
            : beam::slopeRotation(element.rotation, path.axisInFrame(i), path.axisInFrame(i + 1));
    const double curvature =
        std::max(scene.well.trajectory().at(path.arcLength[i]).curvature.norm(),
                 scene.well.trajectory().at(path.arcLength[i + 1]).curvature.norm());
    element.bendingMoment =
        section.youngModulus() * std::max(section.inertiaX(), section.inertiaY()) * curvature;
    if (!pretension.empty()) element.pretension = pretension[i];
    input.elements.push_back(element);
  }
  input.kinks = kinks(scene.string, path);
  input.load = equations.load;
  input.pathReaction = equations.pathReaction;
  input.sliding = sliding;
  if (points.size() > 0) input.contact = scene.contact->law->atRest(points);
  if (auto offsets = gaugeOffsets(scene.string, path, points); !offsets.empty())
    input.contact = contact::eccentric(input.contact, std::move(offsets));
  return input;
}

Vector massDiagonal(const StringModel& model) {
  Vector mass = Vector::Zero(kNodeDofs * model.nodes);
  for (int e = 0; e < model.elements(); ++e)
    mass.segment<2 * kNodeDofs>(kNodeDofs * e) += model.mass[at(e)].diagonal();
  return mass;
}

model::NonlinearSolver staticSolver(const Scene& scene) {
  return statics::noxSolver(listOrEmpty(scene, "Static"));
}

equilibrium::StaticState solveAtRest(const Scene& scene, const equilibrium::StaticInput& input,
                                     const Vector& mass, const model::NonlinearSolver& solver) {
  if (scene.statics.recipe != equilibrium::Recipe::Continuation || !input.contact ||
      input.contact->size() == 0)
    return equilibrium::solveStatic(input, scene.statics, solver);
  Unsettled unsettled;
  try {
    return equilibrium::solveStatic(input, scene.statics, solver, halvingsBeforeSliding);
  } catch (const ConvergenceError&) {
    if (auto slid = slideToRest(scene, input, mass, solver, unsettled)) return *slid;
  }
  if (unsettled.driven) throw ConvergenceError(unsettled.why);
  try {
    return equilibrium::solveStatic(input, scene.statics, solver);
  } catch (const ConvergenceError& error) {
    if (unsettled.why.empty()) throw;
    throw ConvergenceError(unsettled.why + " (" + error.what() + ")");
  }
}

}  // namespace tooljoint::drillstring
