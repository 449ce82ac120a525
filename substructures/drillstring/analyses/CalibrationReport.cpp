// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fmt/format.h>
#include <string>
#include <vector>

#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "substructures/drillstring/analyses/Calibration.hpp"

namespace tooljoint::drillstring {
namespace {

std::string number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? fmt::format("{:.10g}", *value) : "";
}

/// ".../Friction/Static" from ".../Friction/Dynamic".
std::string staticOf(const std::string& dynamic) {
  return dynamic.substr(0, dynamic.rfind('/') + 1) + "Static";
}

void print(const Calibration& fit) {
  log::info(fmt::format("calibration to {} lines of measurements; intervals of 95 % confidence",
                        fit.measured.size()));
  std::vector<std::string> settings, bounds;
  for (const Fitted& one : fit.fitted) {
    const bool force = one.name == "block weight";
    const deck::PrintedUnit unit(force ? "kN" : "");
    const std::string suffix = force ? " " + unit.name() : "";
    const auto text = [&](double value) {
      return fmt::format("{:.{}f}", unit(value), force ? 1 : 3);
    };
    log::info(fmt::format("{:<28}{:>9} {}{}   (deck: {})", one.name, text(one.value),
                          one.atBound ? "at its bound" : "+- " + text(one.uncertainty), suffix,
                          text(one.deck)));
    if (one.atBound) bounds.push_back(one.name);
    // measurements do not separate the static coefficient from the dynamic one
    if (!force)
      settings.push_back(fmt::format("--set \"{}={}\"", staticOf(one.parameter), text(one.value)));
    settings.push_back(fmt::format("--set \"{}={}{}\"", one.parameter, text(one.value), suffix));
  }
  const deck::PrintedUnit force("kN"), torque("kN m");
  log::info(fmt::format(
      "misfit      {:.1f} {} of hook load, {:.2f} {} of torque (root mean square)",
      force(fit.hookLoadMisfit), force.name(), torque(fit.torqueMisfit), torque.name()));
  constexpr double tooLarge = 2.0;  // misfit in stated uncertainties
  if (!bounds.empty())
    log::warn("The fit ends at a bound of " + join(bounds, " and ") +
              ": the measurements contradict the model of the deck. Look at their units, "
              "operations and signs, and at weights and sections of the deck.");
  else if (fit.scatter > tooLarge)
    log::warn(
        fmt::format("The measurements scatter {:.2g} times as much about the fit as their "
                    "uncertainties in the deck say: values may be wrong, or the model lacks "
                    "something.",
                    fit.scatter));
  log::info(
      "These settings take the fit into the deck, whose own coefficients the loads below have. "
      "Measurements do not separate static from dynamic friction.");
  for (const auto& setting : settings) log::info("  " + setting);
}

void stageFit(const Calibration& fit, io::OutputFolder& folder) {
  io::Csv fitted({{"parameter", ""},
                  {"unit", ""},
                  {"deck", ""},
                  {"fitted", ""},
                  {"lower", ""},
                  {"upper", ""},
                  {"at_bound", ""}});
  for (const Fitted& one : fit.fitted)
    fitted.row({one.parameter, one.name == "block weight" ? "N" : "1", number(one.deck),
                number(one.value), number(one.value - one.uncertainty),
                number(one.value + one.uncertainty), one.atBound ? "1" : "0"});
  fitted.stage(folder.file("torque_drag_calibration.csv"));
  io::Csv lines({{"bit_depth", "m"},
                 {"operation", ""},
                 {"hook_load", "N"},
                 {"computed_hook_load", "N"},
                 {"surface_torque", "N m"},
                 {"computed_surface_torque", "N m"}});
  for (std::size_t i = 0; i < fit.measured.size(); ++i) {
    const Measurement &measured = fit.measured[i], &computed = fit.computed[i];
    lines.row({number(measured.bit), measured.operation, number(measured.hookLoad),
               number(computed.hookLoad), number(measured.surfaceTorque),
               number(computed.surfaceTorque)});
  }
  lines.stage(folder.file("torque_drag_measured.csv"));
}

}  // namespace

std::vector<Measurement> measurementsOf(const Scene& scene,
                                        const softstring::TorqueDragSettings& settings) {
  if (!settings.measured) return {};
  std::string file = *settings.measured;
  if (file[0] != '/' && !scene.deck.folder().empty()) file = scene.deck.folder() + "/" + file;
  auto measured = readMeasurements(file, softstring::operationNames());
  for (auto& one : measured) one.bit = withinReach(scene, one.bit, file + ": the table holds");
  return measured;
}

CalibrationResults calibrationOf(const Scene& scene,
                                 const softstring::TorqueDragSettings& settings) {
  CalibrationResults found;
  if (settings.measured) {
    found.fit = calibrate(scene, settings, measurementsOf(scene, settings));
    print(*found.fit);
  }
  if (!settings.broomstick.empty()) found.broomstick = broomstick(scene, settings);
  return found;
}

void stage(const CalibrationResults& found, io::OutputFolder& folder) {
  if (found.fit) stageFit(*found.fit, folder);
  if (found.broomstick.empty()) return;
  io::Csv table({{"bit_depth", "m"},
                 {"operation", ""},
                 {"friction", ""},
                 {"hook_load", "N"},
                 {"surface_torque", "N m"}});
  for (const auto& row : found.broomstick)
    table.row({number(row.bit), row.operation, number(row.friction), number(row.hookLoad),
               number(row.surfaceTorque)});
  table.stage(folder.file("torque_drag_broomstick.csv"));
}

void summarise(const CalibrationResults& found, io::Summary& summary) {
  if (!found.fit) return;
  summary.set("torque_drag.hook_load_misfit", found.fit->hookLoadMisfit);
  summary.set("torque_drag.torque_misfit", found.fit->torqueMisfit);
  for (const Fitted& one : found.fit->fitted) {
    io::SummaryRow row;
    row.set("parameter", one.parameter)
        .set("deck", one.deck)
        .set("fitted", one.value)
        .set("at_bound", one.atBound);
    if (std::isfinite(one.uncertainty)) row.set("uncertainty", one.uncertainty);
    summary.append("torque_drag.calibration", row);
  }
}

}  // namespace tooljoint::drillstring
