// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/scene/Stages.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "deck/PrintedUnits.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/part/Partition.hpp"
#include "substructures/beam/NodalDofs.hpp"
#include "substructures/contact/Eccentric.hpp"
#include "substructures/drillstring/EquationBuilder.hpp"
#include "substructures/drillstring/SidedFeatures.hpp"
#include "substructures/drillstring/scene/RestProblem.hpp"
#include "substructures/drillstring/scene/StringStability.hpp"

namespace tooljoint::drillstring {

namespace nodal = beam::nodal;

namespace {

/// Loads that balance the bends against the stiffness of the linearised string, -(K_pa + K_gpo)
/// kink.
void addBends(const equilibrium::StaticInput& input, const equilibrium::StaticState& state,
              StringModel& model) {
  if (input.kinks.empty()) return;
  Vector load = Vector::Zero(kNodeDofs * model.nodes);
  for (std::size_t e = 0; e < input.kinks.size(); ++e)
    load.segment<12>(kNodeDofs * static_cast<int>(e)) -=
        (input.elements[e].stiffness + state.geometricStiffness[e]) * input.kinks[e];
  model.loads.push_back({"bend", model.lawIndex(model::ScalarLaw::one()), std::move(load)});
}

ContactBatch contactInMotion(const Scene& scene, const path::PathState& path) {
  ContactBatch contact;
  if (scene.contactPoints.size() == 0) return contact;
  const auto rotary = scene.rotary;
  contact.law = scene.contact->law->inMotion(
      scene.contactPoints, [rotary](double t) { return rotary.speed(t); },
      {scene.topDrive.blockSpeed, scene.contact->axialFriction});
  if (auto offsets = gaugeOffsets(scene.string, path, scene.contactPoints); !offsets.empty())
    contact.law = contact::eccentric(contact.law, std::move(offsets));
  for (int node : scene.contactPoints.node) contact.nodes.push_back(node - 1);
  return contact;
}

/// The law of the bit in motion; empty without a law.
std::vector<drilling::PointOnString> bitInMotion(const Scene& scene) {
  if (!scene.bit) return {};
  return {drilling::bitOnString(*scene.bit, scene.string.nodeCount() - 1, scene.rotary,
                                scene.topDrive.blockSpeed, scene.weightOnBit())};
}

/// Adds the loads of the rock on the bit to F_s: steady drilling at the speeds of the start.
void addBitAtRest(const Scene& scene, PathEquations& equations) {
  for (const auto& bit : bitInMotion(scene)) {
    const auto load = drilling::steadyLoad(bit, scene.startTime());
    equations.load(kNodeDofs * bit.node + nodal::w) -= load.weight;
    equations.load(kNodeDofs * bit.node + nodal::thetaZ) -= load.torque;
  }
}

/// Adds the tension that the nodes of a hanging string carry at zero displacement.
void addPretension(const equilibrium::StaticInput& input, StringModel& model) {
  Vector forces = equilibrium::pretensionForces(input);
  if (forces.any())
    model.loads.push_back(
        {"pretension", model.lawIndex(model::ScalarLaw::one()), std::move(forces)});
}

/// The inertia of the drive: J theta_z'' on the left, -J dOmega/dt on the right. The mass of the
/// block is in a frame that advances steadily.
void addDriveInertia(const Scene& scene, StringModel& model) {
  if (const auto& driller = scene.topDrive.autodriller)
    model.mass.front()(nodal::w, nodal::w) += driller->blockMass;
  const double J = scene.topDrive.inertia;
  if (J == 0.0) return;
  model.mass.front()(nodal::thetaZ, nodal::thetaZ) += J;
  Vector load = Vector::Zero(kNodeDofs * model.nodes);
  load(nodal::thetaZ) = -J;
  model.loads.push_back(
      {"drive spin-up", model.lawIndex(scene.rotary.scalar("dOmega/dt")), std::move(load)});
}

/// Support force on a dof of the first node at rest: K D_s minus constant loads and point laws.
double reactionAtTop(const StringModel& string, double t, int component) {
  const auto model = assemble(string);
  const Vector& state = model.initialDisplacement;
  Vector force = reduction::constantStiffness(model) * state -
                 model.pointForce(t, state, Vector::Zero(model.size()));
  for (const auto& load : model.loads)
    if (model.laws[static_cast<std::size_t>(load.law)].isOne()) force -= load.vector;
  for (std::size_t i = 0; i < model.dofs.size(); ++i)
    if (model.dofs[i] == model::DofLabel::physical(1, component))
      return force(static_cast<Eigen::Index>(i));
  throw Error(ExitCode::Internal, "The top of the string is held where its drive should move it.");
}

/// Bit and top drive as laws of the motion that starts from the static state.
void addDrilling(const Scene& scene, StringModel& model) {
  model.drilling = bitInMotion(scene);
  const auto& drive = scene.topDrive;
  if (drive.constantHookLoad) {
    Vector load = Vector::Zero(kNodeDofs * model.nodes);
    load(nodal::w) = reactionAtTop(model, scene.startTime(), nodal::w);
    model.loads.push_back({"hook load", model.lawIndex(model::ScalarLaw::one()), std::move(load)});
  }
  if (drive.autodriller) {
    const double weight = drilling::steadyLoad(model.drilling.front(), scene.startTime()).weight;
    model.drilling.push_back(
        drilling::autodrillerOnString(*drive.autodriller, drive.blockSpeed,
                                      reactionAtTop(model, scene.startTime(), nodal::w), weight));
  }
  if (drive.turnsFreely())
    model.drilling.push_back(
        drilling::driveOnString(drive, reactionAtTop(model, scene.startTime(), nodal::thetaZ)));
}

/// Explanation for a string that floats although springs seem to hold it.
std::string notByCoupling(const Scene& scene) {
  return scene.coupling ? " Springs of the list Coupling count from the static state, so they do "
                          "not hold the string."
                        : "";
}

/// Throws ModelError for a string without supports, with the dof that moves most: it has no
/// equilibrium, since its stiffness, with walls as springs wherever it can touch, is singular.
/// `equations` are unchanged afterwards.
void requireHeld(const Scene& scene, StringModel& equations) {
  auto heldInMotion = std::exchange(equations.held, scene.heldAtRest());
  const auto model = assemble(equations);
  equations.held = std::move(heldInMotion);
  std::unordered_map<std::int64_t, std::vector<int>> lateral;  // dofs of each node
  for (int dof = 0; dof < model.size(); ++dof)
    if (const auto& label = model.dofs[static_cast<std::size_t>(dof)]; label.component < nodal::w)
      lateral[label.entity].push_back(dof);
  Triplets walls;
  for (int i = 0; i < scene.contactPoints.size(); ++i)
    for (const int dof : lateral[scene.contactPoints.node[static_cast<std::size_t>(i)]])
      walls.emplace_back(dof, dof, scene.contactPoints.stiffness[static_cast<std::size_t>(i)]);
  Sparse wall(model.size(), model.size());
  wall.setFromTriplets(walls.begin(), walls.end());
  try {
    linalg::DirectSolver(Sparse(model.stiffnessAt(0.0) + wall), [&](int dof) {
      return model::describe(model.dofs[static_cast<std::size_t>(dof)], model.componentNames);
    });
  } catch (const ModelError& error) {
    throw ModelError(std::string("The string floats: it has no support. ") + error.what() +
                     " Hold that dof in the Supports list." + notByCoupling(scene));
  }
}

/// Motion of a string with a component that is free at every node.
struct FreeMotion {
  int component;
  const char* does;
};
constexpr FreeMotion freeMotions[] = {{nodal::w, "slides along the well"},
                                      {nodal::thetaZ, "turns about its axis"}};

/// A string with w (or theta_z) unsupported is singular only in a straight well. In a curved well
/// walls and bending resist sliding, but far too little for the weight. If such a string has no
/// static equilibrium, or only a distant one, this reports a floating model, with the exit code for
/// that instead of that of a failed solver. `found` is the message of the solver.
void explainFreeMotion(const Scene& scene, const std::string& found) {
  const auto free = freeDirections(scene);
  if (free.empty()) return;
  const auto motion =
      std::find_if(std::begin(freeMotions), std::end(freeMotions),
                   [&](const FreeMotion& one) { return one.component == free.front(); });
  const std::string dof = componentNames()[static_cast<std::size_t>(motion->component)];
  throw ModelError("The string floats: " + dof + " is free at all of its " +
                   std::to_string(scene.string.nodeCount()) + " nodes, so the string " +
                   motion->does + ", and walls and bending cannot hold it. Hold " + dof +
                   " of node 1 or of the bit in the Supports list." + notByCoupling(scene) + " (" +
                   found + ")");
}

/// Largest number of unstable states that "Perturb" leaves.
constexpr int mostPerturbations = 20;

/// The growing mode of the state at all dofs of the string.
equilibrium::UnstableMode unstableMode(const Scene& scene, const StaticStage& stage) {
  const auto model = assemble(stage.equations);
  const Vector diagonal = model.mass.diagonal();
  equilibrium::UnstableMode mode;
  mode.growthRate = std::max(stage.stability.staticGrowthRate, stage.stability.growthRate);
  mode.shape = mode.mass = Vector::Zero(static_cast<int>(scene.held.size()));
  for (int i = 0; i < model.size(); ++i) {
    const auto& dof = model.dofs[static_cast<std::size_t>(i)];
    const auto place = static_cast<int>(kNodeDofs * (dof.entity - 1) + dof.component);
    mode.shape(place) = stage.stability.shape(i);
    mode.mass(place) = diagonal(i);
  }
  return mode;
}

}  // namespace

std::vector<int> freeDirections(const Scene& scene) {
  const auto heldDofs = scene.heldAtRest();
  std::vector<int> free;
  for (const auto& motion : freeMotions) {
    bool held = false;
    for (int node = 0; node < scene.string.nodeCount(); ++node)
      held = held || heldDofs[at(kNodeDofs * node + motion.component)];
    if (!held) free.push_back(motion.component);
  }
  return free;
}

StaticStage findEquilibrium(const Scene& scene) {
  StaticStage stage;
  stage.friction = staticFriction(scene);
  {
    const Stage watch("path of the string");
    stage.path = bendIntoWell(scene);
  }
  const Stage watch("equations of the string");
  auto equations = equationsOnPath(scene, stage.path);
  addBitAtRest(scene, equations);
  addDriveInertia(scene, equations.model);
  requireHeld(scene, equations.model);
  const auto& friction = stage.friction;
  const auto& sliding = friction.sliding;
  auto input = restProblem(scene, stage.path, equations, sliding,
                           friction.ofSlidingSpeed ? scene.contactPoints.slidingAt(
                                                         sliding.rotarySpeed, sliding.axialSpeed)
                                                   : scene.contactPoints,
                           scene.statics.reference);
  addPretension(input, equations.model);
  auto solver = staticSolver(scene);
  const bool onlyOnce = scene.statics.unstable != equilibrium::UnstableRule::Perturb;
  const auto finish = [&] {
    stage.equations = linearise(onlyOnce ? std::move(equations) : PathEquations(equations),
                                stage.state.geometricStiffness, stage.state.displacement,
                                scene.damping, contactInMotion(scene, stage.path));
    addBends(input, stage.state, stage.equations);
    addDrilling(scene, stage.equations);
    if (onlyOnce) input = {}, solver = nullptr;  // an eighth of the peak memory, in the check
    stage.stability = stability::assess(assemble(stage.equations), scene.startTime());
  };
  try {
    const Stage solving("static equilibrium");
    stage.state = solveAtRest(scene, input, massDiagonal(equations.model), solver);
  } catch (const ConvergenceError& error) {
    explainFreeMotion(scene, error.what());
    throw;
  }
  finish();
  if (onlyOnce) return stage;
  while (stage.stability.diverges()) {
    if (++stage.perturbations > mostPerturbations)
      throw ConvergenceError(
          "After " + std::to_string(mostPerturbations) +
          " perturbations the static state is still unstable: " + describeStability(stage) +
          " Reduce the loads, or set Static/Unstable State to \"Warn\".");
    stage.state = equilibrium::leaveUnstable(input, scene.statics, solver, stage.state,
                                             unstableMode(scene, stage));
    finish();
  }
  return stage;
}

void judgeTorqueBalance(const Scene& scene, const StaticStage& stage) {
  constexpr double worthAWarning = 0.02, wrong = 0.1;  // of the torque scale
  const auto& state = stage.state;
  const double defect = state.relativeTorqueDefect();
  if (defect <= worthAWarning) return;
  const deck::PrintedUnit torque("N m");
  const auto text = [&](double value) {
    return formatNumber(std::round(torque(value))) + " " + torque.name();
  };
  const std::string found =
      "The displacements of the static state give a torque of " + text(state.topTorque) +
      " at the top, loads, friction and supports below give " + text(state.topTorqueEquilibrium()) +
      ": the balance of torque is off by " + formatNumber(std::round(1e3 * defect) / 10.0) +
      " % of " + text(state.torqueScale) + ". ";
  const auto free = freeDirections(scene);
  if (std::count(free.begin(), free.end(), nodal::thetaZ) > 0) explainFreeMotion(scene, found);
  const bool round = std::all_of(
      scene.string.elements.begin(), scene.string.elements.end(),
      [](const Element& e) { return e.section().inertiaX() == e.section().inertiaY(); });
  if (scene.path.prestress == path::Prestress::AxialAndTorque)
    log::warn(found +
              "The pre-stress \"Axial and torque\" resists a spin about the curved axis; "
              "Path/Pre-stress \"Full tangent\" does not.");
  else if (!round)
    log::warn(found + "Sections that are not round resist a spin about the curved axis.");
  else if (defect <= wrong)
    log::warn(found +
              "Use more elements per component, or shorter ones where the well bends most.");
  else
    throw ConvergenceError(found +
                           "Use more elements per component, shorter ones where the well bends "
                           "most; or accept the imbalance "
                           "with Path/Pre-stress \"Axial and torque\".");
}

void judgeStretch(const Scene& scene, const StaticStage& stage) {
  constexpr double worthAWarning = 0.01;  // [rad]: contact forces too large by a tenth
  const auto depths = scene.string.depths();
  double turn = 0.0, depth = 0.0, shift = 0.0;
  for (std::size_t node = 0; node < depths.size(); ++node) {
    const double w =
        stage.state.displacement[static_cast<Eigen::Index>(kNodeDofs * node) + nodal::w];
    const double angle = std::abs(w) * scene.well.trajectory().at(depths[node]).curvature.norm();
    if (angle > turn) turn = angle, depth = depths[node], shift = w;
  }
  if (turn <= worthAWarning) return;
  const deck::PrintedUnit length("m");
  const std::string found =
      "Loads move the string by " + formatNumber(std::round(10 * std::abs(length(shift))) / 10) +
      " " + length.name() + " along the well at " + formatNumber(std::round(length(depth))) + " " +
      length.name() + ", where the well turns by " +
      formatNumber(std::round(10 * turn / constants::degree) / 10) + " deg over that length.";
  const auto free = freeDirections(scene);
  if (std::count(free.begin(), free.end(), nodal::w) > 0) explainFreeMotion(scene, found);
  log::warn(found +
            " The model assumes small displacements about the meshed nodes, so side forces and "
            "friction are too large there. Set Static/Reference to \"Hanging\".");
}

namespace {

void judgeBit(const Scene& scene) {
  for (const auto& bit : bitInMotion(scene)) {
    const double weight = drilling::steadyLoad(bit, scene.startTime()).weight;
    const auto warning =
        drilling::outsideCalibration(*scene.bit, "the static state", weight, weight);
    if (!warning.empty()) log::warn(warning);
  }
}

void judgeRounding(const Scene& scene, const StaticStage& stage) {
  constexpr double worthAWarning = 10;  // of the tolerance
  const double residual = stage.state.report.residual;
  if (residual > worthAWarning * scene.statics.tolerance)
    log::warn("The residual of the static state ends at " + linalg::scientific(residual) +
              " of the largest load, where " + linalg::scientific(scene.statics.tolerance) +
              " is the tolerance: rounding to double precision causes it where elements are short "
              "compared with the stretch of the string. Use longer elements, or set "
              "Static/Reference to \"Hanging\".");
}

}  // namespace

void judgeStatic(const Scene& scene, const StaticStage& stage) {
  judgeBit(scene);
  judgeRounding(scene, stage);
  judgeTorqueBalance(scene, stage);
  judgeStretch(scene, stage);
  judgeStability(scene, stage);
}

StaticStage solveStatic(const Scene& scene) {
  auto stage = findEquilibrium(scene);
  judgeStatic(scene, stage);
  return stage;
}

model::SecondOrderModel fullModel(const StaticStage& stage) { return assemble(stage.equations); }

namespace {

/// Rotations of the ends in bending. A torque T about the axis of the well bends an end that leans:
/// E I u'' = -T v', E I v'' = T u' (Greenhill). Interior modes have no moment there and converge
/// slowly without these dofs.
void insertTwistedEnds(const Scene& scene, const StaticStage& stage, std::set<int>& dofs) {
  constexpr double rounding = 1e-9;  // of the moment that bends the element by one radian
  const auto& elements = scene.string.elements;
  const int last = scene.string.nodeCount() - 1;
  for (const auto& [node, element] : {std::pair{0, 0}, std::pair{last, last - 1}}) {
    const double bending = elements[static_cast<std::size_t>(element)].formulation->stiffness()(
        nodal::thetaX, nodal::thetaX);
    if (std::abs(stage.state.torque[element]) <= rounding * bending) continue;
    for (const int component : {nodal::thetaX, nodal::thetaY})
      if (const int dof = kNodeDofs * node + component; !scene.held[static_cast<std::size_t>(dof)])
        dofs.insert(dof);
  }
}

NodeState nodeState(const Scene& scene, const StaticStage& stage) {
  NodeState nodes;
  const auto count = static_cast<std::size_t>(scene.string.nodeCount());
  nodes.gap.assign(count, std::numeric_limits<double>::infinity());
  nodes.candidate.assign(count, 0);
  for (int node : stage.equations.contact.nodes) {
    nodes.gap[static_cast<std::size_t>(node)] = -stage.state.gap(node);
    nodes.candidate[static_cast<std::size_t>(node)] = 1;
  }
  std::set<int> loaded;
  for (const auto& load : loads::pointLoads(scene.loads, scene.string.depths(), scene.rotary)) {
    const int dof = kNodeDofs * (load.node - 1) + load.component;
    if (load.value != 0.0 && !scene.held[static_cast<std::size_t>(dof)]) loaded.insert(dof);
  }
  for (const auto& one : stage.equations.drilling)
    for (const int component : one.components)
      if (const int dof = kNodeDofs * one.node + component;
          !scene.held[static_cast<std::size_t>(dof)])
        loaded.insert(dof);
  if (scene.topDrive.constantHookLoad) loaded.insert(nodal::w);
  insertTwistedEnds(scene, stage, loaded);
  nodes.loadedDofs.assign(loaded.begin(), loaded.end());
  return nodes;
}

}  // namespace

std::vector<int> contactNodes(const Scene& scene, const StaticStage& stage) {
  if (!scene.partition.contactAtRetainedOnly) return stage.equations.contact.nodes;
  const auto chosen = chosenNodes(scene.string, scene.partition, nodeState(scene, stage));
  std::vector<int> nodes;
  std::set_intersection(chosen.begin(), chosen.end(), stage.equations.contact.nodes.begin(),
                        stage.equations.contact.nodes.end(), std::back_inserter(nodes));
  return nodes;
}

std::vector<model::Substructure> cut(const Scene& scene, const StaticStage& stage) {
  const auto retained = retainedDofs(scene.string, scene.partition, nodeState(scene, stage));
  const auto touching = contactNodes(scene, stage);
  std::vector<model::Substructure> parts;
  for (const auto& range : cutParts(scene.string, scene.partition))
    parts.push_back(assemblePart(stage.equations, range, retained, &touching));
  return parts;
}

coupling::ResolvedCoupling resolvedParts(const Scene& scene, const StaticStage& stage) {
  auto parts = cut(scene, stage);
  if (scene.coupling) return coupling::resolve(parts, *scene.coupling);
  return {std::move(parts), {}};
}

std::vector<int> elementsBelowReleases(const Scene& scene, const StaticStage& stage) {
  if (!scene.coupling) return {};
  std::vector<int> elements;
  for (const auto& dof : resolvedParts(scene, stage).options.connections.released)
    if (dof.node > 1 && dof.node < scene.string.elementCount())  // if there is a next element
      elements.push_back(static_cast<int>(dof.node) - 1);
  makeUnique(elements);
  return elements;
}

coupling::Coupling joinUnreduced(const coupling::ResolvedCoupling& resolved) {
  auto options = resolved.options;
  options.assembly = coupling::Assembly::Primal;
  return coupling::coupleWithPositions(resolved.parts, options);
}

model::SecondOrderModel fullModel(const Scene& scene, const StaticStage& stage) {
  return scene.coupling ? joinUnreduced(resolvedParts(scene, stage)).model : fullModel(stage);
}

}  // namespace tooljoint::drillstring
