// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fmt/format.h>

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

void print(const Calibration& fit) {
  log::info(fmt::format("calibration to {} lines of measurements; intervals of 95 % confidence",
                        fit.measured.size()));
  std::string settings;
  for (const Fitted& one : fit.fitted) {
    const bool force = one.name == "block weight";
    const deck::PrintedUnit unit(force ? "kN" : "");
    const std::string suffix = force ? " " + unit.name() : "";
    const auto text = [&](double value) {
      return fmt::format("{:.{}f}", unit(value), force ? 1 : 3);
    };
    log::info(fmt::format("{:<28}{:>9} {} {}{}   (deck: {})", one.name, text(one.value),
                          one.atBound ? "at its bound," : "+-", text(one.uncertainty), suffix,
                          text(one.deck)));
    settings += fmt::format(" --set \"{}={}{}\"", one.parameter, text(one.value), suffix);
  }
  const deck::PrintedUnit force("kN"), torque("kN m");
  log::info(fmt::format(
      "misfit      {:.1f} {} of hook load, {:.2f} {} of torque (root mean square)",
      force(fit.hookLoadMisfit), force.name(), torque(fit.torqueMisfit), torque.name()));
  log::info("in a deck  " + settings);
}

void write(const Calibration& fit, const std::string& folder) {
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
  fitted.writeInto(folder, "torque_drag_calibration.csv");
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
  lines.writeInto(folder, "torque_drag_measured.csv");
}

}  // namespace

void reportCalibration(const Scene& scene, const std::string& folder) {
  auto settings = torqueDragSettings(scene);
  std::string files;
  if (settings.measured) {
    std::string& file = *settings.measured;
    if (file[0] != '/' && !scene.deck.folder().empty()) file = scene.deck.folder() + "/" + file;
    const auto measured = readMeasurements(file, softstring::operationNames());
    for (const auto& one : measured) requireReach(scene, one.bit, file + ": the table holds");
    const auto fit = calibrate(scene, settings, measured);
    print(fit);
    if (!folder.empty()) {
      write(fit, folder);
      files = "torque_drag_calibration.csv, torque_drag_measured.csv";
    }
  }
  if (!settings.broomstick.empty() && !folder.empty()) {
    io::Csv table({{"bit_depth", "m"},
                   {"operation", ""},
                   {"friction", ""},
                   {"hook_load", "N"},
                   {"surface_torque", "N m"}});
    for (const auto& row : broomstick(scene, settings))
      table.row({number(row.bit), row.operation, number(row.friction), number(row.hookLoad),
                 number(row.surfaceTorque)});
    table.writeInto(folder, "torque_drag_broomstick.csv");
    files += (files.empty() ? "" : ", ") + std::string("torque_drag_broomstick.csv");
  }
  if (!files.empty()) log::info("results     " + folder + ": " + files);
}

}  // namespace tooljoint::drillstring
