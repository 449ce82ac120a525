// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/StudyFiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "cases/ListText.hpp"
#include "cases/run/ResultsWriter.hpp"
#include "common/Constants.hpp"
#include "common/Text.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/ResultsFile.hpp"
#include "io/TextFile.hpp"
#include "study/StepLimit.hpp"

namespace tooljoint::study {

namespace {

/// "/runs/003"
std::string numbered(const std::string& group, std::size_t index) {
  const auto digits = std::to_string(index + 1);
  return group + "/" + std::string(digits.size() < 3 ? 3 - digits.size() : 0, '0') + digits;
}

void writeCurve(io::ResultsFile& file, const std::string& path, const std::vector<double>& values,
                const std::string& unit, const std::string& name) {
  if (!values.empty()) file.write(path, values, {values.size()}, unit, name);
}

void writeRow(io::ResultsFile& file, const std::string& group, const StudyRow& row) {
  const auto& c = row.curves;
  const auto& m = row.modeErrors;
  writeCurve(file, group + "/cpu", row.cpu, "s",
             "CPU time of each repeat, transient only, summed over the ranks");
  writeCurve(file, group + "/mode_full", m.full, "Hz",
             "Lowest frequencies of the full model, negative when divergent");
  writeCurve(file, group + "/mode_coupled", m.coupled, "Hz",
             "Those of the coupled modes of the same shape");
  writeCurve(file, group + "/mode_mac", m.mac, "1", "Modal assurance criterion of both shapes");
  writeCurve(file, group + "/mode_error", m.error, "1", "Coupled over full frequency, minus 1");
  writeCurve(file, group + "/mode_estimate", m.estimate, "1",
             "The same estimated without the full model");
  writeCurve(file, group + "/mode_definite", m.definite, "1",
             "0 where modes are missing below that frequency");
  writeCurve(file, group + "/error_time", c.errorTime, "s", "Times of eps_t");
  writeCurve(file, group + "/eps_t", c.errorOverTime, "1", "eps_t against the reference");
  writeCurve(file, group + "/bit_time", c.bitTime, "s", "Times of the bit speed");
  writeCurve(file, group + "/bit_speed", c.bitSpeed, "rad/s", "Bit speed, thinned out");
  writeCurve(file, group + "/initial_radius", c.initial, "m",
             "Lateral distance of the nodes from the well axis at the start");
  writeCurve(file, group + "/growth_time", c.growthTime, "s", "Times of the growth");
  writeCurve(file, group + "/growth", c.growth, "m",
             "Largest lateral distance of a node from its place in the reference run");
  writeCurve(file, group + "/contact_duty", c.statistics.contactDuty, "1",
             "Fraction of the time beyond the window during which a node touches");
  writeCurve(file, group + "/lateral_rms", c.statistics.lateralRms, "m",
             "Root mean square of the lateral motion about its mean, beyond the window");
  writeCurve(file, group + "/frequency", c.statistics.frequency, "Hz",
             "Frequencies of the spectrum");
  writeCurve(file, group + "/spectrum", c.statistics.spectrum, "m2/Hz",
             "Spectral density of the lateral motion beyond the window, mean of the nodes");
  file.attribute(group, "label", row.plan.label);
  file.attribute(group, "line", row.plan.line);
  file.attribute(group, "kind", kindName(row.plan.kind));
  file.attribute(group, "model", row.plan.reduced ? "reduced" : "full");
}

void writePublished(io::ResultsFile& file, const std::vector<Published>& published) {
  for (std::size_t i = 0; i < published.size(); ++i) {
    const auto& p = published[i];
    const auto group = numbered("/published", i);
    file.write(group + "/cpu_time", p.cpu, {p.cpu.size()}, "s",
               "CPU time per simulated second, of another machine");
    writeCurve(file, group + "/error", p.error, "1", "Error of the points");
    if (!p.points.empty()) file.write(group + "/points", p.points, "What each point is");
    file.attribute(group, "label", p.label);
  }
}

io::SummaryRow summaryRow(const StudyRow& row, const Ratios& ratios) {
  io::SummaryRow out;
  out.set("kind", kindName(row.plan.kind))
      .set("method", row.plan.method)
      .set("label", row.plan.label);
  out.set("model", row.plan.reduced ? "reduced" : "full").set("status", row.status);
  if (!row.reason.empty()) out.set("reason", row.reason);
  if (row.hasModel() && !row.basis.empty()) out.set("basis", row.basis).set("modes", row.modes);
  if (row.hasModel()) out.set("reduced_dofs", row.dofs);
  if (row.modeErrors.known())
    out.set("frequency_error", row.modeErrors.worst()).set("least_mac", row.modeErrors.leastMac());
  if (!row.done()) return out;
  out.set("integrator", row.integrator);
  if (row.stepOrTolerance) out.set("step_or_tolerance", *row.stepOrTolerance);
  out.set("cpu_s", row.bestCpu())
      .set("cpu_spread", row.spread())
      .set("cpu_per_simulated_s", row.cpuPerSimulatedSecond());
  if (row.beside) out.set("beside", static_cast<long>(*row.beside));
  out.set("wall_s", row.bestWall())
      .set("setup_cpu_s", row.setupCpu)
      .set("real_time_factor", row.realTimeFactor());
  out.set("steps", row.counters.steps)
      .set("rejected", row.counters.rejected)
      .set("halved", row.counters.halved)
      .set("unconverged_steps", row.counters.unconvergedSteps);
  out.set("newton_iterations", row.counters.newtonIterations)
      .set("factorisations", row.counters.factorisations)
      .set("right_hand_sides", row.counters.rightHandSides)
      .set("missed_nodes", row.missedNodes);
  if (row.energyResidual) out.set("energy_residual", *row.energyResidual);
  if (row.errors)
    out.set("eps_t_max", row.errors->epsTMax)
        .set("eps_t_mean", row.errors->epsTMean)
        .set("eps_n_max", row.errors->epsNMax)
        .set("vibration_error", row.errors->vibration);
  if (row.estimatedVibration) out.set("estimated_vibration_error", *row.estimatedVibration);
  if (ratios.baseline) out.set("speedup_baseline", *ratios.baseline);
  if (ratios.bestFull) out.set("speedup_best_full", *ratios.bestFull);
  if (row.statistics && !row.curves.statistics.bitSpeed.empty())
    out.set("bit_speed_difference_rpm",
            constants::rpmPerRadianPerSecond * row.statistics->bitSpeed);
  if (row.statistics)
    out.set("contact_duty_difference_max", row.statistics->dutyMax)
        .set("contact_duty_difference_mean", row.statistics->dutyMean)
        .set("lateral_rms_difference", row.statistics->lateralRms)
        .set("spectrum_difference_db", row.statistics->spectrum);
  return out;
}

/// Growth at the last sample that is not later than t.
double growthAt(const StudyRow& row, double t) {
  double value = 0.0;
  for (std::size_t i = 0; i < row.curves.growth.size(); ++i)
    if (row.curves.growthTime[i] <= t + 1e-9) value = row.curves.growth[i];
  return value;
}

}  // namespace

const StudyRow* StudyResult::find(RunKind kind) const {
  const auto it = std::find_if(rows.begin(), rows.end(), [&](const StudyRow& row) {
    return row.plan.kind == kind && row.done();
  });
  return it == rows.end() ? nullptr : &*it;
}

void stageStudyTable(const StudyResult& result, io::OutputFolder& folder) {
  io::stageText(folder.file("study.csv"),
                table(result.rows, ratios(result.rows, result.plan.settings.baseline)));
}

void stageStudyFile(const StudyResult& result, io::OutputFolder& folder) {
  const auto& reference = *result.plan.runs.front().scene;
  io::ResultsFile file(folder.file("study.h5"), cases::provenance(reference.deck()));
  file.attribute("/", "machine", result.machine);
  file.attribute("/", "deck_name", reference.deck().name());
  file.attribute("/", "window_begin", result.plan.start);
  file.attribute("/", "window_end", result.plan.windowEnd);
  file.attribute("/", "end", result.plan.end);
  file.attribute("/", "baseline", result.plan.settings.baseline);
  file.attribute("/", "perturbation", result.plan.settings.perturbation);
  if (const auto* check = result.find(RunKind::Check); check != nullptr && check->errors)
    file.attribute("/", "self_error", check->errors->vibration);
  if (const auto* moved = result.find(RunKind::Sensitivity); moved != nullptr && moved->errors)
    file.attribute("/", "sensitivity", moved->errors->vibration);
  file.attribute("/", "frequencies", result.plan.settings.frequencies);
  if (result.rest) result.rest->writeProfile(file);
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    if (result.rows[i].done() || result.rows[i].modeErrors.known())
      writeRow(file, numbered("/runs", i), result.rows[i]);
  writePublished(file, result.plan.settings.published);
  file.flush();
  file.close();
}

void summarise(const StudyResult& result, io::Summary& summary) {
  summary.set("reference.window_begin", result.plan.start);
  summary.set("reference.window_end", result.plan.windowEnd);
  summary.set("reference.end", result.plan.end);
  summary.set("reference.machine", result.machine);
  if (const auto* reference = result.find(RunKind::Reference)) {
    summary.set("reference.integrator", reference->integrator);
    summary.set("reference.max_step", reference->counters.maxStep);
    summary.set("reference.cpu_s", reference->bestCpu());
    if (reference->energyResidual)
      summary.set("reference.energy_residual", *reference->energyResidual);
  }
  if (const auto* check = result.find(RunKind::Check); check != nullptr && check->errors) {
    summary.set("reference.self_error.vibration_error", check->errors->vibration);
    summary.set("reference.self_error.eps_t_max", check->errors->epsTMax);
    summary.set("reference.self_error.eps_n_max", check->errors->epsNMax);
  }
  if (const auto* moved = result.find(RunKind::Sensitivity); moved != nullptr && moved->errors) {
    summary.set("reference.sensitivity.perturbation", result.plan.settings.perturbation);
    summary.set("reference.sensitivity.vibration_error", moved->errors->vibration);
    summary.set("reference.sensitivity.at_window_end", growthAt(*moved, result.plan.windowEnd));
    summary.set("reference.sensitivity.at_end", growthAt(*moved, result.plan.end));
  }
  if (result.predictedCpu) summary.set("reference.predicted_cpu_s", *result.predictedCpu);
  summary.set("step_limits", stepLimits(result));
  const auto speedUps = ratios(result.rows, result.plan.settings.baseline);
  for (std::size_t i = 0; i < result.rows.size(); ++i)
    summary.append("study", summaryRow(result.rows[i], speedUps[i]));
}

std::vector<std::string> stepLimits(const StudyResult& result) {
  std::vector<std::string> lists;
  for (const auto& run : result.plan.runs)
    lists.push_back(run.scene ? cases::canonicalText(run.scene->transient()) : "");
  return stepLimits(result.rows, lists);
}

std::string describeReference(const StudyResult& result) {
  char line[256];
  std::string text;
  const auto* same = result.find(RunKind::Check);
  if (same != nullptr && same->errors && same->errors->vibration == 0.0)
    return "reference   its check has the same motion to the last digit: it does not measure the "
           "error of the reference. Change Study/Check/Set.";
  if (const auto* check = result.find(RunKind::Check); check != nullptr && check->errors) {
    std::snprintf(
        line, sizeof line,
        "reference   own error, against its check: vibration error %.2e, eps_t at most %.2e, eps_n "
        "at most %.2e",
        check->errors->vibration, check->errors->epsTMax, check->errors->epsNMax);
    text = line;
  } else {
    text = "reference   own error unknown: its check failed";
  }
  if (const auto* moved = result.find(RunKind::Sensitivity); moved != nullptr && moved->errors) {
    const deck::PrintedUnit length("m");
    const char* const unit = length.name().c_str();
    std::snprintf(line, sizeof line,
                  "\n            a change of %.0e %s at the start is one of %.1e %s at %g s and of "
                  "%.1e %s at %g s: vibration error %.1e over the window",
                  length(result.plan.settings.perturbation), unit,
                  length(growthAt(*moved, result.plan.windowEnd)), unit, result.plan.windowEnd,
                  length(growthAt(*moved, result.plan.end)), unit, result.plan.end,
                  moved->errors->vibration);
    text += line;
  }
  return text;
}

}  // namespace tooljoint::study
