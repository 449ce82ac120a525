// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>
#include <utility>

#include "common/Constants.hpp"
#include "common/Text.hpp"
#include "io/Csv.hpp"
#include "study/Row.hpp"

namespace tooljoint::study {
namespace {

const std::vector<io::Csv::Column>& columns() {
  static const std::vector<io::Csv::Column> all{{"kind", ""},
                                                {"method", ""},
                                                {"line", ""},
                                                {"label", ""},
                                                {"model", ""},
                                                {"basis", ""},
                                                {"modes", ""},
                                                {"reduced_dofs", ""},
                                                {"frequency_error", ""},
                                                {"least_mac", ""},
                                                {"integrator", ""},
                                                {"sweep", ""},
                                                {"step_or_tolerance", ""},
                                                {"status", ""},
                                                {"reason", ""},
                                                {"eps_t_max", ""},
                                                {"eps_t_mean", ""},
                                                {"eps_n_max", ""},
                                                {"vibration_error", ""},
                                                {"estimated_vibration_error", ""},
                                                {"cpu", "s"},
                                                {"machine", ""},
                                                {"beside", ""},
                                                {"cpu_spread", ""},
                                                {"repeats", ""},
                                                {"cpu_per_simulated_s", ""},
                                                {"wall", "s"},
                                                {"real_time_factor", ""},
                                                {"setup_cpu", "s"},
                                                {"setup_wall", "s"},
                                                {"speedup_baseline", ""},
                                                {"speedup_best_full", ""},
                                                {"steps", ""},
                                                {"rejected", ""},
                                                {"halved", ""},
                                                {"unconverged_steps", ""},
                                                {"newton_iterations", ""},
                                                {"factorisations", ""},
                                                {"right_hand_sides", ""},
                                                {"min_step", "s"},
                                                {"max_step", "s"},
                                                {"energy_residual", ""},
                                                {"max_penetration", "m"},
                                                {"missed_nodes", ""},
                                                {"bit_speed_p05", "rpm"},
                                                {"bit_speed_p50", "rpm"},
                                                {"bit_speed_p95", "rpm"},
                                                {"bit_speed_difference", "rpm"},
                                                {"contact_duty_difference_max", ""},
                                                {"contact_duty_difference_mean", ""},
                                                {"lateral_rms_difference", ""},
                                                {"spectrum_difference", "dB"}};
  return all;
}

std::string text(const std::optional<double>& value) {
  return value ? formatNumber(*value) : std::string();
}

std::string sweepText(const PlannedRun& plan) {
  std::vector<std::string> parts;
  for (const auto& [parameter, value] : plan.sweep) parts.push_back(parameter + "=" + value);
  return join(parts, "; ");
}

std::vector<std::string> cells(const StudyRow& row, const Ratios& ratios) {
  const auto& p = row.plan;
  std::vector<std::string> out{
      kindName(p.kind), p.method, p.line, p.label, p.reduced ? "reduced" : "full", row.basis};
  const bool known = row.done();
  const auto number = [&](auto value) {
    out.push_back(known ? formatNumber(static_cast<double>(value)) : std::string());
  };
  for (long count : {row.modes, row.dofs})
    out.push_back(row.hasModel() ? std::to_string(count) : std::string());
  const auto& modes = row.modeErrors;
  for (double value : {modes.worst(), modes.leastMac()})
    out.push_back(modes.known() ? formatNumber(value) : std::string());
  out.insert(out.end(), {row.integrator, sweepText(p), known ? text(row.stepOrTolerance) : "",
                         row.status, row.reason});
  const auto* e = known && row.errors ? &*row.errors : nullptr;
  for (auto member : {&PointwiseErrors::epsTMax, &PointwiseErrors::epsTMean,
                      &PointwiseErrors::epsNMax, &PointwiseErrors::vibration})
    out.push_back(e != nullptr ? formatNumber(e->*member) : std::string());
  out.push_back(known ? text(row.estimatedVibration) : "");
  number(row.bestCpu());
  out.push_back(known ? row.machine : "");
  out.push_back(known && row.beside ? std::to_string(*row.beside) : "");
  number(row.spread()), number(row.cpu.size()), number(row.cpuPerSimulatedSecond()),
      number(row.bestWall());
  number(row.realTimeFactor()), number(row.setupCpu), number(row.setupWall);
  out.push_back(text(ratios.baseline));
  out.push_back(text(ratios.bestFull));
  number(row.counters.steps), number(row.counters.rejected), number(row.counters.halved),
      number(row.counters.unconvergedSteps), number(row.counters.newtonIterations),
      number(row.counters.factorisations);
  number(row.counters.rightHandSides), number(row.counters.minStep), number(row.counters.maxStep);
  out.push_back(known ? text(row.energyResidual) : "");
  number(row.maxPenetration), number(row.missedNodes);
  const auto& speeds = row.curves.statistics.bitSpeed;
  for (std::size_t level : {0u, 2u, 4u})
    out.push_back(known && speeds.size() > level
                      ? formatNumber(constants::rpmPerRadianPerSecond * speeds[level])
                      : "");
  const auto* s = known && row.statistics ? &*row.statistics : nullptr;
  out.push_back(s != nullptr && !speeds.empty()
                    ? formatNumber(constants::rpmPerRadianPerSecond * s->bitSpeed)
                    : "");
  for (auto member : {&StatisticsDifference::dutyMax, &StatisticsDifference::dutyMean,
                      &StatisticsDifference::lateralRms, &StatisticsDifference::spectrum})
    out.push_back(s != nullptr ? formatNumber(s->*member) : std::string());
  return out;
}

std::string scientific(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.2e", value);
  return buffer;
}

std::string ratioText(const std::optional<double>& ratio) {
  char buffer[32] = "-";
  if (ratio) std::snprintf(buffer, sizeof buffer, "%.3g", *ratio);
  return buffer;
}

}  // namespace

std::string table(const std::vector<StudyRow>& rows, const std::vector<Ratios>& ratios) {
  io::Csv csv(columns());
  for (std::size_t i = 0; i < rows.size(); ++i) csv.row(cells(rows[i], ratios[i]));
  return csv.text();
}

std::string printedTable(const std::vector<StudyRow>& rows, const std::vector<Ratios>& ratios) {
  constexpr std::size_t widest = 30;  // of labels: lines of 100 columns; longer labels get their
                                      // own line
  std::size_t width = 20;
  for (const auto& row : rows)
    if (row.plan.label.size() <= widest) width = std::max(width, row.plan.label.size());
  const bool frequencies = std::any_of(rows.begin(), rows.end(),
                                       [](const StudyRow& row) { return row.modeErrors.known(); });
  char line[256];
  std::snprintf(line, sizeof line, "%-*s %6s %s%9s %9s %7s %8s %9s %7s", static_cast<int>(width),
                "run", "dofs", frequencies ? "frequency " : "", "vibration", "CPU s / s", "spread",
                "baseline", "best full", "steps");
  std::string out =
      std::string("errors relative to the motion; eps_t and eps_n are in study.csv\n") + line;
  double own = 0.0;  // error of the reference
  bool beyond = false;
  for (const auto& row : rows)
    if (row.plan.kind == RunKind::Check && row.done() && row.errors) own = row.errors->vibration;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    if (!row.done()) {
      out +=
          "\n" + row.plan.label + " " + row.status + (row.reason.empty() ? "" : ": " + row.reason);
      continue;
    }
    char error[16] = "-";
    if (row.errors) {
      const bool below = row.plan.kind == RunKind::Method && row.errors->vibration < own;
      beyond = beyond || below;
      std::snprintf(error, sizeof error, "%.2e%s", row.errors->vibration, below ? "*" : "");
    }
    char worst[16] = "";
    if (frequencies)
      std::snprintf(worst, sizeof worst, "%9s ",
                    row.modeErrors.known() ? scientific(row.modeErrors.worst()).c_str() : "-");
    const bool alone = row.plan.label.size() > width;
    if (alone) out += "\n" + row.plan.label;
    std::snprintf(line, sizeof line, "%-*s %6ld %s%9s %9.3g %5.0f %% %8s %9s %7ld",
                  static_cast<int>(width), alone ? "" : row.plan.label.c_str(), row.dofs, worst,
                  error, row.cpuPerSimulatedSecond(), 100.0 * row.spread(),
                  ratioText(ratios[i].baseline).c_str(), ratioText(ratios[i].bestFull).c_str(),
                  row.counters.steps);
    out += std::string("\n") + line;
    std::string more;
    for (const auto& [count, name] : {std::pair{row.counters.rejected, "rejected"},
                                      {row.counters.halved, "halved"},
                                      {row.counters.unconvergedSteps, "unconverged"},
                                      {row.missedNodes, "missed nodes"}})
      if (count > 0) more += (more.empty() ? "" : ", ") + std::to_string(count) + " " + name;
    if (!row.reason.empty()) more += (more.empty() ? "" : ". ") + row.reason;
    if (!more.empty()) out += "\n  " + more;
  }
  if (beyond)
    out += "\n* below the error of the reference itself: the error of this run is not known.";
  return out;
}

}  // namespace tooljoint::study
