// SPDX-License-Identifier: BSD-3-Clause
#include "study/Row.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "common/Error.hpp"
#include "study/SpeedUp.hpp"

namespace tooljoint::study {
namespace {

using Json = nlohmann::ordered_json;

template <class T>
void take(const Json& json, const char* key, T& value) {
  value = json.at(key).get<T>();
}

template <class T>
void take(const Json& json, const char* key, std::optional<T>& value) {
  if (json.at(key).is_null())
    value.reset();
  else
    value = json.at(key).get<T>();
}

template <class T>
Json orNull(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json toJson(const RowCurves& c) {
  const auto& s = c.statistics;
  return {{"error_time", c.errorTime}, {"eps_t", c.errorOverTime},    {"bit_time", c.bitTime},
          {"bit_speed", c.bitSpeed},   {"initial", c.initial},        {"growth_time", c.growthTime},
          {"growth", c.growth},        {"samples", s.samples},        {"quantiles", s.bitSpeed},
          {"duty", s.contactDuty},     {"lateral_rms", s.lateralRms}, {"frequency", s.frequency},
          {"spectrum", s.spectrum}};
}

void fromJson(const Json& json, RowCurves& c) {
  auto& s = c.statistics;
  take(json, "error_time", c.errorTime);
  take(json, "eps_t", c.errorOverTime);
  take(json, "bit_time", c.bitTime);
  take(json, "bit_speed", c.bitSpeed);
  take(json, "initial", c.initial);
  take(json, "growth_time", c.growthTime);
  take(json, "growth", c.growth);
  take(json, "samples", s.samples);
  take(json, "quantiles", s.bitSpeed);
  take(json, "duty", s.contactDuty);
  take(json, "lateral_rms", s.lateralRms);
  take(json, "frequency", s.frequency);
  take(json, "spectrum", s.spectrum);
}

Json toJson(const ModeErrors& m) {
  return {{"full", m.full},   {"coupled", m.coupled},   {"mac", m.mac},
          {"error", m.error}, {"estimate", m.estimate}, {"definite", m.definite}};
}

void fromJson(const Json& json, ModeErrors& m) {
  take(json, "full", m.full);
  take(json, "coupled", m.coupled);
  take(json, "mac", m.mac);
  take(json, "error", m.error);
  take(json, "estimate", m.estimate);
  take(json, "definite", m.definite);
}

double least(const std::vector<double>& values) {
  return values.empty() ? 0.0 : *std::min_element(values.begin(), values.end());
}

/// Visits the numbers of a row with their keys, for both writing and reading.
template <class Row, class Visit>
void eachNumber(Row& row, const Visit& visit) {
  visit("modes", row.modes);
  visit("dofs", row.dofs);
  visit("simulated", row.simulated);
  visit("cpu", row.cpu);
  visit("wall", row.wall);
  visit("setup_cpu", row.setupCpu);
  visit("setup_wall", row.setupWall);
  visit("steps", row.counters.steps);
  visit("rejected", row.counters.rejected);
  visit("halved", row.counters.halved);
  visit("unconverged", row.counters.unconvergedSteps);
  visit("newton_iterations", row.counters.newtonIterations);
  visit("factorisations", row.counters.factorisations);
  visit("right_hand_sides", row.counters.rightHandSides);
  visit("min_step", row.counters.minStep);
  visit("max_step", row.counters.maxStep);
  visit("max_penetration", row.maxPenetration);
  visit("missed_nodes", row.missedNodes);
  visit("given_up_after", row.givenUpAfter);
  visit("status", row.status);
  visit("reason", row.reason);
  visit("basis", row.basis);
  visit("integrator", row.integrator);
  visit("machine", row.machine);
}

}  // namespace

double ModeErrors::worst() const {
  double largest = 0.0;
  for (double e : error) largest = std::max(largest, std::abs(e));
  return largest;
}

double ModeErrors::leastMac() const { return mac.empty() ? 1.0 : least(mac); }

double StudyRow::bestCpu() const { return least(cpu); }
double StudyRow::bestWall() const { return least(wall); }
double StudyRow::spread() const {
  if (cpu.size() < 2 || !(least(cpu) > 0.0)) return 0.0;
  return (*std::max_element(cpu.begin(), cpu.end()) - least(cpu)) / least(cpu);
}

std::string StudyRow::toJson() const {
  Json json{{"label", plan.label}};
  eachNumber(*this, [&](const char* key, const auto& value) { json[key] = value; });
  json["step_or_tolerance"] = orNull(stepOrTolerance);
  json["beside"] = orNull(beside);
  json["energy_residual"] = orNull(energyResidual);
  json["estimated_vibration_error"] = orNull(estimatedVibration);
  json["errors"] = errors
                       ? Json{errors->epsTMax, errors->epsTMean, errors->epsNMax, errors->vibration}
                       : Json(nullptr);
  json["statistics"] = statistics
                           ? Json{statistics->bitSpeed, statistics->dutyMax, statistics->dutyMean,
                                  statistics->lateralRms, statistics->spectrum}
                           : Json(nullptr);
  json["mode_errors"] = study::toJson(modeErrors);
  json["curves"] = study::toJson(curves);
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
}

void StudyRow::fromJson(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    eachNumber(*this, [&](const char* key, auto& value) { take(json, key, value); });
    take(json, "step_or_tolerance", stepOrTolerance);
    take(json, "beside", beside);
    take(json, "energy_residual", energyResidual);
    take(json, "estimated_vibration_error", estimatedVibration);
    errors.reset();
    statistics.reset();
    if (const auto& e = json.at("errors"); !e.is_null())
      errors = PointwiseErrors{e.at(0), e.at(1), e.at(2), e.at(3)};
    if (const auto& s = json.at("statistics"); !s.is_null())
      statistics = StatisticsDifference{s.at(0), s.at(1), s.at(2), s.at(3), s.at(4)};
    study::fromJson(json.at("mode_errors"), modeErrors);
    study::fromJson(json.at("curves"), curves);
  } catch (const Json::exception& error) {
    throw FileError(std::string("A stored row of the study cannot be read: ") + error.what() +
                    ". Run the study with --fresh.");
  }
}

std::vector<Ratios> ratios(const std::vector<StudyRow>& rows, const std::string& baseline) {
  std::vector<CostPoint> full;
  double baselineCost = 0.0;
  for (const auto& row : rows) {
    if (!row.done() || row.plan.kind != RunKind::Method || !row.errors) continue;
    if (!row.plan.reduced)
      full.push_back({row.plan.line, row.errors->vibration, row.cpuPerSimulatedSecond()});
    if (row.plan.label == baseline) baselineCost = row.cpuPerSimulatedSecond();
  }
  std::vector<Ratios> out(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& row = rows[i];
    const double cost = row.cpuPerSimulatedSecond();
    if (!row.done() || row.plan.kind != RunKind::Method || !row.errors || !(cost > 0.0)) continue;
    if (baselineCost > 0.0) out[i].baseline = baselineCost / cost;
    if (const auto best = bestCostAt(row.errors->vibration, full)) out[i].bestFull = *best / cost;
  }
  return out;
}

}  // namespace tooljoint::study
