// SPDX-License-Identifier: BSD-3-Clause
#include "app/ResultsWriter.hpp"

#include <cmath>

#include "common/Text.hpp"
#include "io/Csv.hpp"

namespace tooljoint::app {

namespace {

constexpr double kRpm = 30.0 / 3.14159265358979323846;  ///< rad/s -> rpm

std::size_t nodeCount(const Scene& scene) {
  return static_cast<std::size_t>(scene.string.nodeCount());
}

std::vector<double> rows(const std::vector<Vector3>& vectors) {
  std::vector<double> out;
  for (const auto& v : vectors) out.insert(out.end(), v.data(), v.data() + 3);
  return out;
}

}  // namespace

io::Provenance provenance(const deck::Deck& deck) {
  return {deck.file(), deck.text(), deck.sha256(), deck.overrides()};
}

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
  file.write("/static/axial_force", state.axialForce, {elements}, "N",
             "Axial force F_apo of the elements, tension positive");
  file.write("/static/torque", state.torque, {elements}, "N m", "Torque T_apo of the elements");
}

void writeBases(const std::vector<reduction::ReducedSubstructure>& parts, io::ResultsFile& file) {
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const auto& part = parts[p];
    const std::string group = "/reduction/part_" + std::to_string(p + 1);
    file.write(group + "/basis", Matrix(part.basis->vectors), "1",
               "Basis Phi of " + part.name + ": D = offset + Phi q");
    file.write(group + "/offset", part.offset, {static_cast<std::size_t>(part.offset.size())},
               "m, rad", "D at q = 0");
    if (part.basis->eigenvalues.size() > 0)
      file.write(group + "/eigenvalues", part.basis->eigenvalues,
                 {static_cast<std::size_t>(part.basis->eigenvalues.size())}, "rad2/s2",
                 "Squared angular frequencies of the modes");
  }
}

void stageStaticTables(const Scene& scene, const StaticStage& stage, io::OutputFolder& folder) {
  const auto& state = stage.state;
  io::Csv nodes({{"node", ""},
                 {"s", "m"},
                 {"u", "m"},
                 {"v", "m"},
                 {"w", "m"},
                 {"theta_z", "rad"},
                 {"r", "m"},
                 {"clearance", "m"},
                 {"normal_force", "N"},
                 {"tangential_force", "N"},
                 {"friction_torque", "N m"}});
  for (int i = 0; i < scene.string.nodeCount(); ++i) {
    const auto& node = scene.string.nodes[static_cast<std::size_t>(i)];
    const auto d = state.displacement.segment<6>(6 * i);
    nodes.row({i + 1.0, node.s, d(0), d(1), d(2), d(5), std::hypot(d(0), d(1)), node.clearance,
               state.normalForce(i), state.tangentialForce(i), state.frictionTorque(i)});
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

void stageBasisTable(const std::vector<reduction::ReducedSubstructure>& parts,
                     io::OutputFolder& folder) {
  io::Csv table({{"part", ""},
                 {"kind", ""},
                 {"vector", ""},
                 {"frequency", "Hz"},
                 {"omega2", "rad2/s2"},
                 {"residual", ""},
                 {"kept", ""},
                 {"why", ""}});
  const auto number = [](double value) {
    return std::isfinite(value) ? formatNumber(value) : std::string();
  };
  for (const auto& part : parts)
    for (const auto& row : part.basisRows())
      table.row({part.name, row.kind, row.name, number(row.frequency()), number(row.eigenvalue),
                 number(row.residual), row.kept ? "kept" : "dropped", row.why});
  table.stage(folder.file("basis.csv"));
}

void summarise(const Scene& scene, io::Summary& summary) {
  summary.set("deck.file", scene.deck.file());
  summary.set("deck.sha256", scene.deck.sha256());
  summary.set("model.nodes", scene.string.nodeCount());
  summary.set("model.elements", scene.string.elementCount());
  summary.set("model.free_dofs", scene.freeDofs());
  summary.set("model.length", scene.string.length());
}

void summarise(const StaticStage& stage, io::Summary& summary) {
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
  summary.set("static.friction_speed_rpm", stage.friction.speed * kRpm);
}

void summarise(const std::vector<reduction::ReducedSubstructure>& parts, const std::string& basis,
               int reducedDofs, double wall, io::Summary& summary) {
  summary.set("reduction.basis", basis);
  for (const auto& part : parts)
    summary.append("reduction.substructures", io::SummaryRow()
                                                  .set("name", part.name)
                                                  .set("interior", part.report.interior)
                                                  .set("interface", part.report.interface)
                                                  .set("retained", part.report.retained)
                                                  .set("modes", part.report.modes)
                                                  .set("cutoff_hz", part.report.cutOffHz()));
  summary.set("reduction.reduced_dofs", reducedDofs);
  summary.set("reduction.wall_s", wall);
}

void summarise(const coupling::Coupling& coupled, io::Summary& summary) {
  summary.set("reduction.coupling.assembly",
              std::string(coupled.multipliers.empty() ? "Primal" : "Dual"));
  summary.set("reduction.coupling.joined_dofs", coupled.joinedDofs);
  summary.set("reduction.coupling.multipliers", static_cast<long>(coupled.multipliers.size()));
  if (coupled.interfaceModes >= 0)
    summary.set("reduction.coupling.interface_modes", coupled.interfaceModes);
}

void summarise(const estimate::Outcome& outcome, const std::vector<model::Substructure>& parts,
               io::Summary& summary) {
  if (!outcome.rounds.empty())
    summary.set("reduction.estimate.rounds", static_cast<long>(outcome.rounds.size()));
  if (!outcome.rounds.empty() || !outcome.frequencies.empty())
    summary.set("reduction.estimate.wall_s", outcome.wall);
  if (outcome.frequencies.empty()) return;
  for (const auto& e : outcome.frequencies) {
    Eigen::Index worst = 0;
    if (e.byPart.size() > 0) e.byPart.maxCoeff(&worst);
    io::SummaryRow row;
    row.set("hz", e.frequency()).set("error", e.error).set("complete", e.definite);
    if (e.byPart.size() > 0 && e.byPart[worst] > 0)
      row.set("part", parts[static_cast<std::size_t>(worst)].name);
    summary.append("reduction.estimate.frequencies", row);
  }
  summary.set("reduction.estimate.frequency_error", estimate::largestError(outcome.frequencies));
}

void summarise(const estimate::MotionEstimate& error, io::Summary& summary) {
  summary.set("reduction.estimate.motion_error", error.error);
  summary.set("reduction.estimate.motion_worst_sample", error.largest);
  summary.set("reduction.estimate.motion_wall_s", error.wall);
}

void summarise(const transient::TransientReport& report, bool reduced, io::Summary& summary) {
  const auto& c = report.counters;
  summary.set("transient.model", reduced ? "reduced" : "full");
  summary.set("transient.integrator", report.integrator);
  summary.set("transient.start", report.start);
  summary.set("transient.end", report.end);
  summary.set("transient.steps", c.steps);
  summary.set("transient.min_step", c.minStep);
  summary.set("transient.max_step", c.maxStep);
  summary.set("transient.rejected", c.rejected);
  summary.set("transient.halved", c.halved);
  summary.set("transient.newton_iterations", c.newtonIterations);
  summary.set("transient.unconverged_steps", c.unconvergedSteps);
  summary.set("transient.factorisations", c.factorisations);
  summary.set("transient.right_hand_sides", c.rightHandSides);
  summary.set("transient.wall_s", report.wall);
  summary.set("transient.cpu_s", report.cpu);
  summary.set("transient.real_time_factor", report.realTimeFactor);
  if (report.stepErrors.local > 0) summary.set("transient.local_error", report.stepErrors.local);
  if (report.stepErrors.stepDoubling > 0)
    summary.set("transient.halving_error", report.stepErrors.stepDoubling);
  if (report.hasEnergy) summary.set("transient.energy_residual", report.energy.residual());
}

void summarise(const transient::TransientReport& report, const MotionFigures& figures, bool reduced,
               io::Summary& summary) {
  summarise(report, reduced, summary);
  summary.set("transient.bit_speed_rpm.min", figures.minBitSpeed * kRpm);
  summary.set("transient.bit_speed_rpm.max", figures.maxBitSpeed * kRpm);
  summary.set("transient.bit_speed_rpm.mean", figures.meanBitSpeed() * kRpm);
  summary.set("transient.max_penetration", figures.maxPenetration);
}

}  // namespace tooljoint::app
