// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/case/StringResults.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/printf.h>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Detail.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "substructures/drillstring/figures/BendingElements.hpp"
#include "substructures/drillstring/scene/StringStability.hpp"

namespace tooljoint::drillstring {

namespace {

std::size_t nodeCount(const Scene& scene) {
  return static_cast<std::size_t>(scene.string.nodeCount());
}

std::vector<double> rows(const std::vector<Vector3>& vectors) {
  std::vector<double> out;
  for (const auto& v : vectors) out.insert(out.end(), v.data(), v.data() + 3);
  return out;
}

/// 1 for a string that turns to the right or not at all at the start of the motion, -1 to the left.
double senseOfRotation(const Scene& scene) {
  return scene.rotary.sense(scene.startTime()) < 0.0 ? -1.0 : 1.0;
}

/// Torques below this fraction of StaticState::torqueScale are printed as 0.
constexpr double roundedTorque = 1e-6;

}  // namespace

void writeModel(const Scene& scene, const StaticStage& stage, io::ResultsFile& file) {
  const auto nodes = nodeCount(scene);
  std::vector<double> s, clearance, radius, frames;
  std::vector<Vector3> axis;
  for (const auto& node : scene.string.nodes) {
    s.push_back(node.s);
    clearance.push_back(node.clearance);
    radius.push_back(node.contactRadius);
    axis.push_back(scene.well.at(node.s).position);
  }
  for (const auto& frame : stage.path.frame)
    for (int row = 0; row < 3; ++row)
      for (int column = 0; column < 3; ++column) frames.push_back(frame(row, column));
  file.write("/model/s", s, {nodes}, "m", "Depth of the nodes along the well");
  file.write("/model/position", rows(axis), {nodes, 3}, "m",
             "Well axis at the nodes, global X, Y, Z (down)");
  file.write("/model/frame", frames, {nodes, 3, 3}, "1",
             "Nodal frames; columns are the x, y, z axes in global components");
  file.write("/model/clearance", clearance, {nodes}, "m", "Radial clearance between node and wall");
  file.write("/model/contact_radius", radius, {nodes}, "m", "Lever arm of the friction torque");
}

void writeSections(const Scene& scene, io::ResultsFile& file) {
  std::vector<double> outer, inner, area, torsion, young, shear;
  std::vector<std::string> names;
  std::vector<int> component;
  for (const auto& element : scene.string.elements) {
    const auto& section = element.section();
    outer.push_back(section.outerRadius());
    inner.push_back(section.innerRadius());
    area.push_back(section.area());
    torsion.push_back(section.torsion());
    young.push_back(section.youngModulus());
    shear.push_back(section.material().shearModulus());
    const auto& name = scene.string.instances[at(element.instance)].component;
    const auto found = std::find(names.begin(), names.end(), name);
    component.push_back(static_cast<int>(found - names.begin()) + 1);
    if (found == names.end()) names.push_back(name);
  }
  const io::Shape elements{outer.size()};
  file.write("/model/outer_radius", outer, elements, "m", "Outer radius of the elements");
  file.write("/model/inner_radius", inner, elements, "m", "Inner radius of the elements");
  file.write("/model/area", area, elements, "m2", "Area of the section of the elements");
  file.write("/model/torsion_constant", torsion, elements, "m4", "Torsion constant J");
  file.write("/model/young_modulus", young, elements, "Pa", "Young's modulus E");
  file.write("/model/shear_modulus", shear, elements, "Pa", "Shear modulus G");
  file.write("/model/component_names", names, "Entries of the assembly, each once");
  file.write("/model/component", component, elements, "1",
             "Entry of the assembly an element belongs to, counted from 1");
}

void writeBending(const Scene& scene, const StaticStage& stage, io::ResultsFile& file) {
  std::vector<double> onPath, slopes;
  for (const auto& element : bendingElements(scene.string, stage.path))
    for (int axis = 0; axis < 2; ++axis) {
      onPath.push_back(element.pathCurvature[axis]);
      for (std::size_t end : {0, 1})
        for (int component = 0; component < 3; ++component)
          slopes.push_back((end == 1 ? 1.0 : -1.0) * element.slope[end](axis, component) /
                           element.length);
    }
  const auto elements = onPath.size() / 2;
  file.write("/model/path_curvature", onPath, {elements, 2}, "1/m",
             "Curvature of the elements on the path, in two axes across them");
  file.write("/model/curvature_of_rotations", slopes, {elements, 2, 6}, "1/m",
             "Curvature in these axes per rotation of the upper and the lower node");
  std::vector<int> below = elementsBelowReleases(scene, stage);
  for (int& element : below) ++element;
  if (!below.empty())
    file.write("/model/elements_below_releases", below, {below.size()}, "1",
               "Elements, counted from 1, whose upper node moves apart from that shown: strain and "
               "curvature are those of the next element");
}

void writePath(const StaticStage& stage, io::ResultsFile& file) {
  const auto nodes = stage.path.position.size();
  const auto elements = stage.path.chordLength.size();
  file.write("/path/position", rows(stage.path.position), {nodes, 3}, "m",
             "Nodes at the end of the path, global X, Y, Z");
  file.write("/path/reaction", Matrix(stage.path.reaction.transpose()), "N, N m",
             "Pre-load R_ipa of the nodes in nodal frames, forces then moments");
  file.write("/path/axial_force", stage.path.axialForce, {elements}, "N",
             "Axial force of the elements, tension positive");
  file.write("/path/torque", stage.path.torque, {elements}, "N m", "Torque of the elements");
}

void writeStatic(const Scene& scene, const StaticStage& stage, io::ResultsFile& file) {
  const auto nodes = nodeCount(scene);
  const auto elements = stage.path.chordLength.size();
  const auto& state = stage.state;
  file.write(
      "/static/displacement", state.displacement, {nodes, 6}, "m, rad",
      "Displacements from the path state in nodal frames: u, v, w, theta_x, theta_y, theta_z");
  file.write("/static/normal_force", state.normalForce, {nodes}, "N",
             "Normal contact force, positive pushing off the wall");
  file.write("/static/tangential_force", state.tangentialForce, {nodes}, "N",
             "Friction force along the direction of rotation");
  file.write("/static/friction_torque", state.frictionTorque, {nodes}, "N m",
             "Friction torque about the axis");
  if (scene.contact && scene.contact->axialFriction)
    file.write("/static/axial_friction", state.axialFriction, {nodes}, "N",
               "Friction force along the hole, downwards positive");
  file.write("/static/axial_force", state.axialForce, {elements}, "N",
             "Axial force F_apo of the elements, tension positive");
  file.write("/static/torque", state.torque, {elements}, "N m", "Torque T_apo of the elements");
}

void writeProfile(const Scene& scene, const StaticStage& stage, io::ResultsFile& file) {
  const auto& state = stage.state;
  std::vector<double> s, clearance, radius;
  for (int i = 0; i < scene.string.nodeCount(); ++i) {
    const auto& node = scene.string.nodes[static_cast<std::size_t>(i)];
    s.push_back(node.s);
    clearance.push_back(node.clearance);
    radius.push_back(std::hypot(state.displacement(6 * i), state.displacement(6 * i + 1)));
  }
  const auto elements = static_cast<std::size_t>(state.axialForce.size());
  file.write("/profile/s", s, {s.size()}, "m", "Depth of the nodes along the well");
  file.write("/profile/clearance", clearance, {s.size()}, "m",
             "Radial clearance between node and wall");
  file.write("/profile/radius", radius, {s.size()}, "m",
             "Static lateral distance of the nodes from the well axis");
  file.write("/profile/normal_force", state.normalForce, {s.size()}, "N",
             "Static normal contact force");
  file.write("/profile/axial_force", state.axialForce, {elements}, "N",
             "Static axial force of the elements, tension positive");
  file.write("/profile/torque", state.torque, {elements}, "N m", "Static torque of the elements");
}

void stageStaticTables(const Scene& scene, const StaticStage& stage, io::OutputFolder& folder) {
  const auto& state = stage.state;
  const bool axial = scene.contact && scene.contact->axialFriction;
  std::vector<io::Csv::Column> columns{{"node", ""},
                                       {"s", "m"},
                                       {"u", "m"},
                                       {"v", "m"},
                                       {"w", "m"},
                                       {"theta_z", "rad"},
                                       {"r", "m"},
                                       {"clearance", "m"},
                                       {"normal_force", "N"},
                                       {"tangential_force", "N"},
                                       {"friction_torque", "N m"}};
  if (axial) columns.push_back({"axial_friction", "N"});
  io::Csv nodes(columns);
  for (int i = 0; i < scene.string.nodeCount(); ++i) {
    const auto& node = scene.string.nodes[static_cast<std::size_t>(i)];
    const auto d = state.displacement.segment<6>(6 * i);
    std::vector<double> row{i + 1.0,
                            node.s,
                            d(0),
                            d(1),
                            d(2),
                            d(5),
                            std::hypot(d(0), d(1)),
                            node.clearance,
                            state.normalForce(i),
                            state.tangentialForce(i),
                            state.frictionTorque(i)};
    if (axial) row.push_back(state.axialFriction(i));
    nodes.row(row);
  }
  nodes.stage(folder.file("static_nodes.csv"));
  io::Csv elements({{"element", ""},
                    {"s", "m"},
                    {"axial_force", "N"},
                    {"torque", "N m"},
                    {"path_axial_force", "N"},
                    {"path_torque", "N m"}});
  for (int e = 0; e < scene.string.elementCount(); ++e) {
    const auto i = static_cast<std::size_t>(e);
    elements.row({e + 1.0, 0.5 * (scene.string.nodes[i].s + scene.string.nodes[i + 1].s),
                  state.axialForce(e), state.torque(e), stage.path.axialForce(e),
                  stage.path.torque(e)});
  }
  elements.stage(folder.file("static_elements.csv"));
}

std::vector<cases::RestFigure> restFigures(const StaticStage& stage) {
  const auto& state = stage.state;
  return {
      {"contact_nodes", "1", "Nodes on the wall", static_cast<double>(state.contactNodes)},
      {"hook_load", "N", "Hook load, without block", state.hookLoad},
      {"top_axial_force", "N", "Tension of the first element", state.topAxialForce},
      {"last_axial_force", "N", "Tension of the last element", state.lastElementAxialForce},
      {"top_torque", "N m", "Torque of the first element", state.topTorque},
      {"last_torque", "N m", "Torque of the last element", state.lastElementTorque},
      {"total_normal_force", "N", "Sum of the normal contact forces", state.totalNormalForce},
  };
}

void summarise(const Scene& scene, io::Summary& summary) {
  summary.set("deck.file", scene.deck.file());
  summary.set("deck.sha256", scene.deck.sha256());
  summary.set("model.nodes", scene.string.nodeCount());
  summary.set("model.elements", scene.string.elementCount());
  summary.set("model.free_dofs", scene.freeDofs());
  summary.set("model.length", scene.string.length());
}

void summarise(const Scene& scene, const StaticStage& stage, io::Summary& summary) {
  const auto& path = stage.path.report;
  summary.set("path.converged", path.converged);
  summary.set("path.increments", path.increments);
  summary.set("path.iterations", path.iterations);
  summary.set("path.max_position_error", path.maxPositionError);
  const auto& state = stage.state;
  summary.set("static.converged", state.report.converged);
  summary.set("static.iterations", state.report.iterations);
  summary.set("static.residual", state.report.residual);
  summary.set("static.contact_nodes", state.contactNodes);
  summary.set("static.compressed_elements", state.compressedElements);
  summary.set("static.hook_load", state.hookLoad);
  summary.set("static.surface_torque", 0.0 - senseOfRotation(scene) * state.topTorque);
  summary.set("static.top_axial_force", state.topAxialForce);
  summary.set("static.last_element_axial_force", state.lastElementAxialForce);
  summary.set("static.last_element_torque", state.lastElementTorque);
  summary.set("static.max_normal_force", state.maxNormalForce);
  summary.set("static.max_normal_force_node", state.maxNormalForceNode);
  summary.set("static.total_normal_force", state.totalNormalForce);
  summary.set("static.top_torque", state.topTorque);
  summary.set("static.top_torque_equilibrium", state.topTorqueEquilibrium());
  summary.set("static.torque_balance_defect", state.torqueBalanceDefect());
  summary.set("static.torque_scale", state.torqueScale);
  summary.set("static.friction", stage.friction.why);
  summary.set("static.friction_direction", stage.friction.direction);
  summary.set("static.friction_speed_rpm", stage.friction.speed * constants::rpmPerRadianPerSecond);
  summary.set("static.friction_axial_speed", stage.friction.sliding.axialSpeed);
  summariseStability(stage, summary);
}

namespace {

/// 150 deg/30 m [1/m], a radius of 11 m: wells drilled with a short radius have 12 m or more.
constexpr double sharpestDrilled = 150.0 * constants::degree / 30.0;

/// Measured and vertical depth of the bit, the sharpest bend above it, its inclination.
std::string describeWell(const Scene& scene) {
  constexpr double beside = 1e-6;     // [m] of a depth where the curvature jumps
  constexpr double rounding = 1e-12;  // of the vertical depth of a level hole, relative to its
                                      // length
  const double bit = scene.string.length();
  auto depths = scene.string.depths();
  // at a jump of the curvature below the bit, that of the interval above counts
  depths.back() = bit - beside;
  for (const double s : scene.well.trajectory().breaks())
    for (const double place : {s - beside, s + beside})
      if (place > 0.0 && place < bit) depths.push_back(place);
  double sharpest = 0.0, where = 0.0;
  for (const double s : depths)
    if (const double bend = scene.well.at(s).curvature.norm(); bend > sharpest)
      sharpest = bend, where = s;
  double fall = scene.well.at(bit).position.z() - scene.well.at(0.0).position.z();
  if (std::abs(fall) < rounding * bit) fall = 0.0;
  std::string text = fmt::sprintf("well        bit at MD %s, TVD %s, inclination %.3g deg; ",
                                  deck::printed(bit, "m", 5), deck::printed(fall, "m", 5),
                                  scene.well.inclination(bit) / constants::degree);
  if (sharpest == 0.0) return text + "straight";
  text += fmt::sprintf("largest dogleg %s at %s", deck::printed(sharpest, "deg/30 m", 3),
                       deck::printed(where, "m", 5));
  return sharpest > sharpestDrilled
             ? text + ", sharper than wells are drilled: check the depths and angles there"
             : text;
}

/// Weight, weight below the uppermost kind of component, the longest element.
std::string describeString(const Scene& scene) {
  const auto& string = scene.string;
  const double mud = scene.list().isSublist("Mud")
                         ? mud::readProperties(scene.list().sublist("Mud")).density
                         : 0.0;
  double mass = 0.0, displaced = 0.0, longest = 0.0, below = 0.0;
  const std::string& uppermost = string.instances.front().component;
  for (const Element& element : string.elements) {
    mass += element.section().massPerLength() * element.length();
    displaced += mud * element.section().area() * element.length();
    longest = std::max(longest, element.length());
    below += element.length();
    const auto& instance = string.instances[static_cast<std::size_t>(element.instance)];
    if (instance.component == uppermost) below = 0.0;
  }
  const double gravity = loads::acceleration(scene.loads).norm();
  std::string text = "            longest element " + deck::printed(longest, "m", 3) + "; " +
                     deck::printed(below, "m", 4) + " of string below the last " + uppermost;
  if (gravity == 0.0) return text + "; no weight";
  text += "; weight " + deck::printed(mass * gravity, "kN", 4) + " in air";
  if (mud > 0.0) text += ", " + deck::printed((mass - displaced) * gravity, "kN", 4) + " in mud";
  return text;
}

}  // namespace

std::string describeScene(const Scene& scene) {
  std::string text =
      fmt::sprintf("string      %d nodes, %d elements, %s in a well of %s, %d free dofs\n",
                   scene.string.nodeCount(), scene.string.elementCount(),
                   deck::printed(scene.string.length(), "m", 4),
                   deck::printed(scene.well.length(), "m", 4), scene.freeDofs());
  text += describeString(scene) + "\n" + describeWell(scene);
  for (const auto& remark : scene.well.trajectory().remarks()) text += "\nsurvey      " + remark;
  if (scene.contact && scene.contact->law->atRest(scene.contactPoints)->largestPull() > 0.0)
    text += "\ncontact     the law " + inQuotes(scene.contact->lawName) +
            " attracts points to the wall, on rebound and when open; Clamped never does";
  return text;
}

std::string describeStatic(const Scene& scene, const StaticStage& stage) {
  const auto& path = stage.path.report;
  const auto& s = stage.state;
  std::string text;
  if (log::verbose())
    text += fmt::sprintf("path        iterations %d, load steps %d, nodes %s the axis\n",
                         path.iterations, path.increments,
                         path.maxPositionError > 0.0
                             ? "within " + deck::printed(path.maxPositionError, "m", 2) + " of"
                             : "on");
  text += fmt::sprintf("static      %d nodes in contact, %d elements in compression\n",
                       s.contactNodes, s.compressedElements);
  if (log::verbose())
    text += fmt::sprintf("            %d iterations, residual %.1e\n", s.report.iterations,
                         s.report.residual);
  const auto force = [](double value) { return deck::printed(value, "kN", 4); };
  const auto torque = [](double value) { return deck::printed(value, "kN m", 4); };
  const auto against = [&](double value) {  // against the rotation, without rounding errors
    const bool nothing = std::abs(value) <= roundedTorque * s.torqueScale;
    return torque(nothing ? 0.0 : -senseOfRotation(scene) * value);
  };
  text += fmt::sprintf(
      "            hook load %s, axial force %s in the last element\n"
      "            surface torque %s, %s in the last element\n",
      force(s.hookLoad), force(s.lastElementAxialForce), against(s.topTorque),
      against(s.lastElementTorque));
  if (s.maxNormalForceNode > 0)
    text += fmt::sprintf("            contact %s in all, at most %s at node %d\n",
                         force(s.totalNormalForce), force(s.maxNormalForce), s.maxNormalForceNode);
  text += fmt::sprintf("            friction: %s", stage.friction.why.c_str());
  if (stage.friction.speed > 0.0)
    text += fmt::sprintf(", %.4g rpm", stage.friction.speed * constants::rpmPerRadianPerSecond);
  if (const double along = stage.friction.sliding.axialSpeed; along != 0.0)
    text += ", " + deck::printed(std::abs(along), "m/s", 4) + (along > 0.0 ? " down" : " up");
  if (log::verbose())
    text += fmt::sprintf(
        "\n            top torque %s by the balance of torque, defect %s (%.2g %% of %s)",
        torque(s.topTorqueEquilibrium()), deck::printed(s.torqueBalanceDefect(), "N m", 4),
        100.0 * s.relativeTorqueDefect(), torque(s.torqueScale));
  if (stage.perturbations > 0)
    text +=
        fmt::sprintf("\n            perturbed %d times along unstable modes", stage.perturbations);
  return text + "\nstability   " + describeStability(stage);
}

}  // namespace tooljoint::drillstring
