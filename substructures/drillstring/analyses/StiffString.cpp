// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffString.hpp"

#include <algorithm>
#include <cmath>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/analyses/Hanging.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"
#include "substructures/drillstring/scene/RestProblem.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "substructures/equilibrium/LoadPath.hpp"

namespace tooljoint::drillstring {

using namespace beam::nodal;

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

StiffLoads StiffString::under(const softstring::Operation& operation) const {
  StiffLoads loads;
  const auto problemInput = input(operation);
  equilibrium::StaticState state;
  try {
    state = solve(problemInput);
  } catch (const ConvergenceError& error) {
    loads.failure = error.what();
    return loads;
  }
  // the hook and the rotary table hold the first node
  const Vector reaction = equilibrium::StaticProblem(problemInput).unbalanced(state.displacement);
  loads.hookLoad = -reaction(w);
  loads.surfaceTorque = reaction(thetaZ);
  loads.twist = -state.displacement(perNode * (problemInput.nodes - 1) + thetaZ);
  loads.torqueDefect = state.relativeTorqueDefect();
  loads.iterations = state.report.iterations;
  loads.negativePivots = equilibrium::negativePivots(problemInput, state.displacement).value_or(0);
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
