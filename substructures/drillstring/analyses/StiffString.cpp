// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/StiffString.hpp"

#include <algorithm>
#include <cmath>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/drillstring/analyses/Hanging.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"
#include "substructures/drillstring/scene/RestProblem.hpp"

namespace tooljoint::drillstring {

using namespace beam::nodal;

namespace {

/// Points closer to the axis than this fraction of the clearance do not lie on the wall.
constexpr double aside = 0.5;
/// Angle between neighbours [rad] above which the string changes sides and does not wind.
constexpr double changesSides = 0.5 * constants::pi;

/// Largest number of turns about the hole that a compressed stretch makes along the wall.
double turnsOnWall(const contact::ContactPoints& points, const equilibrium::StaticState& state) {
  double turned = 0.0, most = 0.0, last = 0.0;
  int before = -1;  // node of `last`
  for (std::size_t p = 0; p < points.node.size(); ++p) {
    const int node = points.node[p] - 1;
    const double x = state.displacement(perNode * node + u),
                 y = state.displacement(perNode * node + v);
    const bool compressed = node > 0 && state.axialForce(node - 1) < 0.0;
    if (!compressed || std::hypot(x, y) < aside * points.clearance[p]) {
      before = -1;
      continue;
    }
    const double angle = std::atan2(y, x), step = std::remainder(angle - last, constants::twoPi);
    const bool winds = before == node - 1 && std::abs(step) < changesSides;
    turned = winds ? turned + step : 0.0;
    most = std::max(most, std::abs(turned));
    before = node;
    last = angle;
  }
  return most / constants::twoPi;
}

}  // namespace

StiffString::StiffString(const Scene& scene, double bit)
    : scene_(hungAt(scene, bit)),
      path_(bendIntoWell(scene_)),
      equations_(equationsOnPath(scene_, path_)),
      bending_(bendingElements(scene_.string, path_)),
      points_(scene_.contactPoints.slidingFast()),
      mass_(massDiagonal(equations_.model)),
      frictionless_(withoutFriction(input({}), scene_.statics, staticSolver(scene_), mass_)) {}

equilibrium::StaticInput StiffString::input(const softstring::Operation& operation) const {
  auto input = restProblem(scene_, path_, equations_, {operation.axialSpeed, operation.rotarySpeed},
                           points_, equilibrium::Reference::Hanging);
  const int bit = perNode * (input.nodes - 1);
  input.load(bit + w) -= operation.weightOnBit;
  input.load(bit + thetaZ) -= operation.torqueOnBit;
  return input;
}

StiffLoads StiffString::under(const softstring::Operation& operation) const {
  StiffLoads loads;
  const auto problem = [&](double share) {
    auto part = operation;
    part.weightOnBit *= share, part.torqueOnBit *= share;
    return input(part);
  };
  auto found = SlidingRest(scene_.string, scene_.statics, mass_, problem).from(frictionless_);
  loads.iterations = found.iterations;
  loads.buckled = found.buckled;
  loads.locksUp = found.locksUp;
  loads.unsettled = found.unsettled;
  loads.advice = found.advice;
  if (!found.rest) loads.failure = loads.unsettled;
  if (!loads.found()) return loads;
  loads.negativePivots = found.rest->negativePivots;
  const auto problemInput = problem(1.0);
  const equilibrium::StaticState& state = found.rest->state;
  // the hook and the rotary table hold the first node
  const Vector reaction = equilibrium::StaticProblem(problemInput).unbalanced(state.displacement);
  loads.hookLoad = -reaction(w);
  loads.surfaceTorque = reaction(thetaZ);
  loads.twist = -state.displacement(perNode * (problemInput.nodes - 1) + thetaZ);
  loads.turns = turnsOnWall(points_, state);
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
