// SPDX-License-Identifier: BSD-3-Clause
#include "io/Summary.hpp"

#include <cmath>
#include <nlohmann/json.hpp>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::io {
namespace {

using Json = nlohmann::ordered_json;

/// The documented keys, in the order of the file. "[]" ends the name of an array of rows.
const std::vector<std::string>& documentedKeys() {
  static const std::vector<std::string> keys{
      "format_version",
      "status",
      "message",
      "program.version",
      "program.git",
      "deck.file",
      "deck.sha256",
      "ranks",
      "wall_s",
      "peak_memory_mb",
      "files",
      "warnings",
      "model.nodes",
      "model.elements",
      "model.free_dofs",
      "model.length",
      "path.converged",
      "path.increments",
      "path.iterations",
      "path.max_position_error",
      "static.converged",
      "static.iterations",
      "static.residual",
      "static.contact_nodes",
      "static.compressed_elements",
      "static.top_axial_force",
      "static.last_element_axial_force",
      "static.last_element_torque",
      "static.max_normal_force",
      "static.max_normal_force_node",
      "static.total_normal_force",
      "static.top_torque",
      "static.top_torque_equilibrium",
      "static.torque_balance_defect",
      "static.torque_scale",
      "static.friction",
      "static.friction_direction",
      "static.friction_speed_rpm",
      "static.stable",
      "static.stability_without",
      "static.negative_pivots",
      "static.growth_rate",
      "static.growth_hz",
      "static.unstable_node",
      "static.unstable_half_waves",
      "static.perturbations",
      "reduction.basis",
      "reduction.substructures[].name",
      "reduction.substructures[].interior",
      "reduction.substructures[].interface",
      "reduction.substructures[].retained",
      "reduction.substructures[].modes",
      "reduction.substructures[].cutoff_hz",
      "reduction.reduced_dofs",
      "reduction.start_misfit",
      "reduction.wall_s",
      "reduction.cost_ratio",
      "reduction.coupling.assembly",
      "reduction.coupling.joined_dofs",
      "reduction.coupling.multipliers",
      "reduction.coupling.interface_modes",
      "reduction.estimate.rounds",
      "reduction.estimate.frequencies[].hz",
      "reduction.estimate.frequencies[].error",
      "reduction.estimate.frequencies[].complete",
      "reduction.estimate.frequencies[].part",
      "reduction.estimate.frequency_error",
      "reduction.estimate.wall_s",
      "reduction.estimate.motion_error",
      "reduction.estimate.motion_worst_sample",
      "reduction.estimate.motion_wall_s",
      "transient.model",
      "transient.integrator",
      "transient.start",
      "transient.end",
      "transient.steps",
      "transient.min_step",
      "transient.max_step",
      "transient.rejected",
      "transient.halved",
      "transient.newton_iterations",
      "transient.unconverged_steps",
      "transient.factorisations",
      "transient.right_hand_sides",
      "transient.strategies.relaxation",
      "transient.strategies.near_solves",
      "transient.strategies.points_alone",
      "transient.strategies.point_paths",
      "transient.strategies.turns",
      "transient.strategies.resting_impacts",
      "transient.strategies.newton",
      "transient.strategies.troubled_points",
      "transient.wall_s",
      "transient.cpu_s",
      "transient.ranks",
      "transient.dofs_of_rank",
      "transient.messages",
      "transient.real_time_factor",
      "transient.bit_speed_rpm.min",
      "transient.bit_speed_rpm.max",
      "transient.bit_speed_rpm.mean",
      "transient.step_error",
      "transient.energy_residual",
      "transient.max_penetration",
      "transient.max_displacement",
      "transient.figures.begin",
      "transient.figures.end",
      "transient.figures.samples",
      "transient.figures.bit_speed_rpm.mean",
      "transient.figures.bit_speed_rpm.rms",
      "transient.figures.bit_speed_rpm.min",
      "transient.figures.bit_speed_rpm.max",
      "transient.figures.stick_slip_index",
      "transient.figures.stuck_share",
      "transient.figures.stuck_speed_rpm",
      "transient.figures.weight_on_bit.mean",
      "transient.figures.weight_on_bit.rms",
      "transient.figures.weight_on_bit.min",
      "transient.figures.weight_on_bit.max",
      "transient.figures.torque_on_bit.mean",
      "transient.figures.torque_on_bit.rms",
      "transient.figures.torque_on_bit.min",
      "transient.figures.torque_on_bit.max",
      "transient.figures.rate_of_penetration",
      "transient.figures.specific_energy",
      "transient.figures.axial_acceleration.rms",
      "transient.figures.axial_acceleration.peak",
      "transient.figures.axial_acceleration.peak_node",
      "transient.figures.axial_acceleration.peak_depth",
      "transient.figures.axial_acceleration.worst_rms",
      "transient.figures.axial_acceleration.worst_rms_node",
      "transient.figures.axial_acceleration.worst_rms_depth",
      "transient.figures.lateral_acceleration.rms",
      "transient.figures.lateral_acceleration.peak",
      "transient.figures.lateral_acceleration.peak_node",
      "transient.figures.lateral_acceleration.peak_depth",
      "transient.figures.lateral_acceleration.worst_rms",
      "transient.figures.lateral_acceleration.worst_rms_node",
      "transient.figures.lateral_acceleration.worst_rms_depth",
      "transient.figures.whirl.forward_share",
      "transient.figures.whirl.backward_share",
      "transient.figures.whirl.backward_contact_share",
      "transient.figures.whirl.worst_backward_share",
      "transient.figures.whirl.worst_backward_share_node",
      "transient.figures.whirl.worst_backward_share_depth",
      "transient.figures.whirl.worst_backward_contact_share",
      "transient.figures.whirl.worst_precession_rpm",
      "transient.figures.contact.duty",
      "transient.figures.contact.total_force_mean",
      "transient.figures.contact.force_peak",
      "transient.figures.contact.force_peak_node",
      "transient.figures.contact.force_peak_depth",
      "transient.figures.bending.range",
      "transient.figures.bending.range_element",
      "transient.figures.bending.range_depth",
      "transient.figures.bending.cycles",
      "transient.figures.bending.damage_per_hour",
      "transient.figures.bending.damage_per_hour_element",
      "transient.figures.bending.damage_per_hour_depth",
      "transient.figures.acceleration.rms",
      "transient.figures.acceleration.peak",
      "transient.figures.acceleration.peak_part",
      "transient.figures.acceleration.peak_node",
      "transient.figures.displacement.rms",
      "transient.figures.displacement.peak",
      "transient.figures.displacement.peak_part",
      "transient.figures.displacement.peak_node",
      "measured.file",
      "measured.time_offset",
      "measured.columns[].name",
      "measured.columns[].column",
      "measured.columns[].quantity",
      "measured.columns[].unit",
      "measured.columns[].begin",
      "measured.columns[].end",
      "measured.columns[].samples",
      "measured.columns[].mean_difference",
      "measured.columns[].rms_difference",
      "measured.columns[].largest_difference",
      "measured.columns[].computed_mean",
      "measured.columns[].computed_min",
      "measured.columns[].computed_max",
      "measured.columns[].computed_index",
      "measured.columns[].computed_peak_hz",
      "measured.columns[].computed_peak_amplitude",
      "measured.columns[].measured_mean",
      "measured.columns[].measured_min",
      "measured.columns[].measured_max",
      "measured.columns[].measured_index",
      "measured.columns[].measured_peak_hz",
      "measured.columns[].measured_peak_amplitude",
      "reference.integrator",
      "reference.max_step",
      "reference.cpu_s",
      "reference.energy_residual",
      "reference.window_begin",
      "reference.window_end",
      "reference.end",
      "reference.machine",
      "reference.self_error.vibration_error",
      "reference.self_error.eps_t_max",
      "reference.self_error.eps_n_max",
      "reference.sensitivity.perturbation",
      "reference.sensitivity.vibration_error",
      "reference.sensitivity.at_window_end",
      "reference.sensitivity.at_end",
      "study[].kind",
      "study[].method",
      "study[].label",
      "study[].model",
      "study[].basis",
      "study[].modes",
      "study[].reduced_dofs",
      "study[].frequency_error",
      "study[].least_mac",
      "study[].integrator",
      "study[].step_or_tolerance",
      "study[].cpu_s",
      "study[].beside",
      "study[].cpu_spread",
      "study[].cpu_per_simulated_s",
      "study[].wall_s",
      "study[].setup_cpu_s",
      "study[].real_time_factor",
      "study[].speedup_baseline",
      "study[].speedup_best_full",
      "study[].steps",
      "study[].rejected",
      "study[].halved",
      "study[].unconverged_steps",
      "study[].newton_iterations",
      "study[].factorisations",
      "study[].right_hand_sides",
      "study[].missed_nodes",
      "study[].energy_residual",
      "study[].eps_t_max",
      "study[].eps_t_mean",
      "study[].eps_n_max",
      "study[].vibration_error",
      "study[].estimated_vibration_error",
      "study[].bit_speed_difference_rpm",
      "study[].contact_duty_difference_max",
      "study[].contact_duty_difference_mean",
      "study[].lateral_rms_difference",
      "study[].spectrum_difference_db",
      "study[].status",
      "study[].reason",
      "map.points",
      "map.done",
      "map.failed",
      "map.cpu_per_point_s",
      "map.wall_per_point_s",
      "map.axes[].name",
      "map.axes[].parameter",
      "map.axes[].unit",
      "map.axes[].points",
      "map.axes[].numeric",
      "map.values[].name",
      "map.values[].key",
      "map.values[].known",
      "map.values[].unsafe",
      "map.values[].unsafe_above",
      "map.values[].unsafe_below",
      "map.values[].min",
      "map.values[].max",
      "campbell.model",
      "campbell.dofs",
      "campbell.points",
      "campbell.modes",
      "campbell.least_damping",
      "campbell.largest_estimate",
      "campbell.largest_error",
      "campbell.crossings[].order",
      "campbell.crossings[].mode",
      "campbell.crossings[].speed_rpm",
      "campbell.crossings[].hz",
      "campbell.crossings[].damping",
      "campbell.crossings[].whirl",
      "campbell.crossings[].estimate",
      "buckling.end",
      "buckling.explanation",
      "buckling.steps",
      "buckling.halved_steps",
      "buckling.last_weight_on_bit",
      "buckling.crookedness",
      "buckling.crookedness_pitch",
      "buckling.limit",
      "buckling.unstable_from",
      "buckling.theory.sinusoidal",
      "buckling.theory.helical",
      "buckling.theory.spontaneous",
      "buckling.theory.finite_length",
      "buckling.theory.finite_half_waves",
      "buckling.jumps[].weight_on_bit",
      "bha.length",
      "bha.checked_length",
      "bha.length_change",
      "bha.missing",
      "bha.force_defect",
      "bha.moment_defect",
      "bha.rows[].inclination",
      "bha.rows[].weight_on_bit",
      "bha.rows[].mode",
      "bha.rows[].tool_face",
      "bha.rows[].side_force_high",
      "bha.rows[].side_force_right",
      "bha.rows[].tilt_high",
      "bha.rows[].tilt_right",
      "bha.rows[].sag_high",
      "bha.rows[].sag_right",
      "bha.rows[].tangency",
      "bha.rows[].largest_moment",
      "bha.rows[].largest_moment_from_bit",
      "bha.rows[].largest_von_mises",
      "bha.rows[].stable",
      "response.model",
      "response.dofs",
      "response.points",
      "response.largest_estimate",
      "response.largest_error",
      "response.peaks[].load",
      "response.peaks[].output",
      "response.peaks[].speed_rpm",
      "response.peaks[].hz",
      "response.peaks[].amplitude",
      "response.peaks[].unit",
      "response.peaks[].phase",
      "response.peaks[].estimate",
      "response.contact_speed_rpm",
      "response.contact_hz",
      "response.contact_node",
  };
  return keys;
}

Json::json_pointer pointer(const std::string& path) {
  Json::json_pointer where;
  for (const auto& key : split(path, '.')) where /= key;
  return where;
}

/// All keys with null; arrays of rows are null too until the first row comes.
Json skeleton() {
  Json json;
  for (const auto& key : documentedKeys()) {
    json[pointer(key.substr(0, key.find("[]")))] = nullptr;
  }
  return json;
}

[[noreturn]] void undocumented(const std::string& path) {
  throw Error(ExitCode::Internal, "\"" + path + "\" is no documented key of summary.json.");
}

void requireFinite(const std::string& path, double value) {
  if (!std::isfinite(value)) {
    throw Error(ExitCode::Internal, "The summary key \"" + path + "\" was given " +
                                        formatNumber(value) + ", which is never written.");
  }
}

}  // namespace

struct SummaryRow::Data {
  Json json = Json::object();
};
struct Summary::Data {
  Json json = skeleton();

  /// The place of a documented value; rows and groups are not values.
  Json& at(const std::string& path) {
    for (const auto& key : documentedKeys()) {
      if (key == path) return json[pointer(path)];
    }
    undocumented(path);
  }
};

SummaryRow::SummaryRow() : data_(std::make_unique<Data>()) {}
SummaryRow::~SummaryRow() = default;
SummaryRow::SummaryRow(const SummaryRow& other) : data_(std::make_unique<Data>(*other.data_)) {}

SummaryRow& SummaryRow::set(const std::string& key, double value) {
  requireFinite(key, value);
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::set(const std::string& key, long value) {
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::set(const std::string& key, bool value) {
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::set(const std::string& key, const std::string& value) {
  data_->json[key] = value;
  return *this;
}
SummaryRow& SummaryRow::setNull(const std::string& key) {
  data_->json[key] = nullptr;
  return *this;
}

Summary::Summary() : data_(std::make_unique<Data>()) {
  set("format_version", summaryFormatVersion);
  set("program.version", programVersion());
  set("program.git", gitHash());
  set("ranks", parallel::size());
}
Summary::~Summary() = default;

void Summary::set(const std::string& path, double value) {
  requireFinite(path, value);
  data_->at(path) = value;
}
void Summary::set(const std::string& path, long value) { data_->at(path) = value; }
void Summary::set(const std::string& path, bool value) { data_->at(path) = value; }
void Summary::set(const std::string& path, const std::string& value) { data_->at(path) = value; }
void Summary::set(const std::string& path, const std::vector<std::string>& values) {
  data_->at(path) = values;
}

void Summary::append(const std::string& path, const SummaryRow& row) {
  const std::string prefix = path + "[].";
  Json complete = Json::object();
  for (const auto& key : documentedKeys()) {
    if (key.rfind(prefix, 0) == 0) complete[key.substr(prefix.size())] = nullptr;
  }
  if (complete.empty()) undocumented(path);
  for (const auto& [key, value] : row.data_->json.items()) {
    if (!complete.contains(key)) undocumented(prefix + key);
    complete[key] = value;
  }
  Json& array = data_->json[pointer(path)];
  if (array.is_null()) array = Json::array();
  array.push_back(complete);
}

std::vector<std::string> Summary::keys() { return documentedKeys(); }

std::string Summary::text() const {
  // texts from the outside (file names, messages) may hold bytes that are no UTF-8: replaced, never
  // a failure
  return data_->json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

void Summary::stage(const std::string& path) const { stageText(path, text()); }
void Summary::write(const std::string& path) const { writeText(path, text()); }

PreviousRun readPreviousRun(const std::string& path) {
  PreviousRun run;
  std::string text;
  try {
    text = readText(path);
  } catch (const FileError&) {
    return run;  // none there
  }
  const Json json = Json::parse(text, nullptr, false);
  if (!json.is_object()) return run;
  if (json.contains("status") && json["status"].is_string())
    run.status = json["status"].get<std::string>();
  if (json.contains("files") && json["files"].is_array()) {
    for (const auto& name : json["files"]) {
      if (name.is_string()) run.files.push_back(name.get<std::string>());
    }
  }
  return run;
}

}  // namespace tooljoint::io
