// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "cases/run/AnalysisFiles.hpp"
#include "cases/run/Run.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "response/Campbell.hpp"
#include "response/Columns.hpp"

namespace tooljoint::response {

namespace {

using constants::rpmPerRadianPerSecond;
using constants::twoPi;

Columns rowTable(const CampbellDiagram& diagram, bool estimated) {
  const auto& rows = diagram.rows;
  Columns table{{
      {"speed", "rad/s", "Rotary speed", collect(rows, [](const auto& r) { return r.speed; })},
      {"mode", "1", "Number of the mode, kept along the speeds",
       collect(rows, [](const auto& r) { return r.mode; })},
      {"frequency", "Hz", "Im s / 2 pi",
       collect(rows, [](const auto& r) { return r.frequency(); })},
      {"damping", "1", "Damping ratio -Re s / |s|",
       collect(rows, [](const auto& r) { return r.damping(); })},
      {"growth", "1/s", "Re s", collect(rows, [](const auto& r) { return r.s.real(); })},
      {"whirl", "1", "1: circles with the rotation, -1: against it, 0: lines",
       collect(rows, [](const auto& r) { return r.whirl; })},
      {"mac", "1", "Modal assurance criterion with the mode at the speed before",
       collect(rows, [](const auto& r) { return r.mac; })},
  }};
  if (estimated)
    table.columns.push_back({"estimate", "1", "Estimated error of s of the reduced model",
                             collect(rows, [](const auto& r) { return r.error; })});
  return table;
}

Columns crossingTable(const CampbellDiagram& diagram, bool estimated) {
  const auto& rows = diagram.crossings;
  Columns table{{
      {"order", "1", "Frequency over rotary speed",
       collect(rows, [](const auto& r) { return r.order; })},
      {"mode", "1", "Number of the mode", collect(rows, [](const auto& r) { return r.at.mode; })},
      {"speed", "rad/s", "Critical speed", collect(rows, [](const auto& r) { return r.at.speed; })},
      {"frequency", "Hz", "Frequency there",
       collect(rows, [](const auto& r) { return r.at.frequency(); })},
      {"damping", "1", "Damping ratio there",
       collect(rows, [](const auto& r) { return r.at.damping(); })},
      {"whirl", "1", "Of the mode at the nearest speed of the diagram",
       collect(rows, [](const auto& r) { return r.at.whirl; })},
      {"refined", "1", "0: by linear interpolation",
       collect(rows, [](const auto& r) { return r.refined ? 1.0 : 0.0; })},
  }};
  if (estimated)
    table.columns.push_back({"estimate", "1",
                             "Estimated error of s at the nearest speed of the diagram",
                             collect(rows, [](const auto& r) { return r.at.error; })});
  return table;
}

Columns checkTable(const CampbellDiagram& diagram) {
  const auto& rows = diagram.checks;
  return {{
      {"speed", "rad/s", "Rotary speed", collect(rows, [](const auto& r) { return r.speed; })},
      {"mode", "1", "Number of the mode, 0 for one that is not followed",
       collect(rows, [](const auto& r) { return r.mode; })},
      {"full", "Hz", "Frequency of the full model",
       collect(rows, [](const auto& r) { return r.full.imag() / twoPi; })},
      {"reduced", "Hz", "Frequency of the reduced model",
       collect(rows, [](const auto& r) { return r.reduced.imag() / twoPi; })},
      {"error", "1", "|s - s_full| / |s_full|",
       collect(rows, [](const auto& r) { return r.error; })},
      {"estimate", "1", "The same estimated without the full model",
       collect(rows, [](const auto& r) { return r.estimate; })},
      {"mac", "1", "Modal assurance criterion of both shapes",
       collect(rows, [](const auto& r) { return r.mac; })},
  }};
}

const char* whirlWord(double whirl) {
  constexpr double clear = 0.1;  ///< of a circle
  return whirl > clear ? "forward" : whirl < -clear ? "backward" : "-";
}

void print(const CampbellDiagram& diagram, bool estimated) {
  log::info("critical speeds, Im s = order x speed:");
  if (diagram.crossings.empty()) log::info("  none in this range of speeds");
  if (!diagram.crossings.empty())
    log::info(fmt::format("  {:>7} {:>5} {:>12} {:>12} {:>11}  {:<9}{}", "order", "mode", "speed",
                          "frequency", "damping", "whirl", estimated ? " estimate" : ""));
  for (const auto& one : diagram.crossings)
    log::info(fmt::format(
        "  {:>6}x {:>5} {:>8.2f} rpm {:>9.4f} Hz {:>11.3e}  {:<9}{}{}", formatNumber(one.order),
        one.at.mode, one.at.speed * rpmPerRadianPerSecond, one.at.frequency(), one.at.damping(),
        whirlWord(one.at.whirl), estimated ? fmt::format(" {:8.1e}", one.at.error) : "",
        one.refined ? "" : " (interpolated)"));
  const auto worst =
      std::max_element(diagram.checks.begin(), diagram.checks.end(),
                       [](const auto& a, const auto& b) { return a.error < b.error; });
  if (worst != diagram.checks.end())
    log::info(
        fmt::format("spot checks with the full model: largest error {:.1e} (estimate {:.1e}), at "
                    "{:.2f} rpm and "
                    "{:.4f} Hz",
                    worst->error, worst->estimate, worst->speed * rpmPerRadianPerSecond,
                    worst->full.imag() / twoPi));
}

/// Of |s|: a larger estimate is worth a warning.
constexpr double tooCoarse = 0.01;

void warnOfCoarseness(const CampbellDiagram& diagram) {
  const auto worst =
      std::max_element(diagram.rows.begin(), diagram.rows.end(),
                       [](const auto& a, const auto& b) { return a.error < b.error; });
  if (worst != diagram.rows.end() && worst->error > tooCoarse)
    log::warn(fmt::format(
        "The estimated error of mode {} of the reduced model is {:.1f} % at {:.2f} rpm. Keep more "
        "modes (Reduction/Mode Selection), or leave the list Reduction out.",
        worst->mode, 100.0 * worst->error, worst->speed * rpmPerRadianPerSecond));
}

/// Damped modes whose damping ratio is below this grow, beyond rounding.
constexpr double growing = -1e-8;

void warnOfGrowth(const CampbellDiagram& diagram) {
  const auto worst =
      std::min_element(diagram.rows.begin(), diagram.rows.end(),
                       [](const auto& a, const auto& b) { return a.damping() < b.damping(); });
  if (worst == diagram.rows.end() || worst->damping() >= growing) return;
  const auto first = std::find_if(diagram.rows.begin(), diagram.rows.end(),
                                  [](const auto& row) { return row.damping() < growing; });
  log::warn(fmt::format(
      "Modes grow, from {:.2f} rpm on (mode {}); the least damping ratio is {:.2e}, of mode {} at "
      "{:.2f} rpm.",
      first->speed * rpmPerRadianPerSecond, first->mode, worst->damping(), worst->mode,
      worst->speed * rpmPerRadianPerSecond));
}

void summarise(const RotatingCase& rotating, const CampbellDiagram& diagram,
               const CampbellSettings& settings, io::Summary& summary) {
  summary.set("campbell.model", rotating.reduced() ? "reduced" : "full");
  summary.set("campbell.dofs", rotating.model().size());
  summary.set("campbell.points", static_cast<long>(settings.speeds.size()));
  double least = 1.0, estimate = 0.0, error = 0.0;
  int modes = 0;
  for (const auto& row : diagram.rows) {
    least = std::min(least, row.damping());
    estimate = std::max(estimate, row.error);
    modes = std::max(modes, row.mode);
  }
  summary.set("campbell.modes", modes);
  summary.set("campbell.least_damping", least);
  if (rotating.estimated()) summary.set("campbell.largest_estimate", estimate);
  for (const auto& check : diagram.checks) error = std::max(error, check.error);
  if (!diagram.checks.empty()) summary.set("campbell.largest_error", error);
  for (const auto& one : diagram.crossings) {
    io::SummaryRow row;
    row.set("order", one.order)
        .set("mode", one.at.mode)
        .set("speed_rpm", one.at.speed * rpmPerRadianPerSecond)
        .set("hz", one.at.frequency())
        .set("damping", one.at.damping())
        .set("whirl", one.at.whirl);
    if (rotating.estimated()) row.set("estimate", one.at.error);
    summary.append("campbell.crossings", row);
  }
}

}  // namespace

void runCampbell(const cases::Case& one, const std::string& folder) {
  if (!one.list().isSublist("Campbell"))
    throw DeckError(one.deck().file() +
                    ": the deck has no list Campbell. Add one with the Highest Speed.");
  const auto settings = readCampbell(one.list().sublist("Campbell"));
  cases::AnalysisFiles files(one, folder, "campbell");
  CampbellDiagram diagram;
  std::unique_ptr<RotatingCase> rotating;
  files.complete(
      [&] {
        cases::announce(one);
        rotating = std::make_unique<RotatingCase>(one, settings.friction);
        rotating->announceLaws();
        diagram = campbell(*rotating, settings);
        print(diagram, rotating->estimated());
        warnOfGrowth(diagram);
        warnOfCoarseness(diagram);
        log::info("times       " + stageTimes());
      },
      [&](io::ResultsFile& file) {
        const bool estimated = rotating->estimated();
        rowTable(diagram, estimated).write("campbell", files.folder(), file);
        crossingTable(diagram, estimated).write("crossings", files.folder(), file);
        checkTable(diagram).write("spot_checks", files.folder(), file);
        file.write("/orders", settings.orders, {settings.orders.size()}, "1",
                   "Excitation frequencies over the rotary speed");
        summarise(*rotating, diagram, settings, files.summary());
      });
}

}  // namespace tooljoint::response
