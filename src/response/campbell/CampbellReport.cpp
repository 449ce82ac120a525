// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>

#include "cases/run/AnalysisFiles.hpp"
#include "cases/run/Run.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "response/Columns.hpp"
#include "response/SweepParameters.hpp"
#include "response/campbell/Campbell.hpp"
#include "response/campbell/ModeSearch.hpp"

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

Columns crossingTable(const CampbellDiagram& diagram, const CampbellSettings& settings,
                      bool estimated) {
  const auto& rows = diagram.crossings;
  const auto& lines = settings.lines;
  Columns table{{
      {"order", "1", "Order of the excitation, frequency = order x speed / 2 pi + offset",
       collect(rows, [&](const auto& r) { return lines[r.line].order; })},
      {"offset", "Hz", "Of the excitation",
       collect(rows, [&](const auto& r) { return lines[r.line].offset / twoPi; })},
      {"mode", "1", "Number of the mode", collect(rows, [](const auto& r) { return r.at.mode; })},
      {"speed", "rad/s", "Critical speed", collect(rows, [](const auto& r) { return r.at.speed; })},
      {"frequency", "Hz", "Frequency there",
       collect(rows, [](const auto& r) { return r.at.frequency(); })},
      {"damping", "1", "Damping ratio there",
       collect(rows, [](const auto& r) { return r.at.damping(); })},
      {"whirl", "1", "Whirl of the mode there; without refinement at the next speed of the diagram",
       collect(rows, [](const auto& r) { return r.at.whirl; })},
      {"refined", "1", "0: by linear interpolation",
       collect(rows, [](const auto& r) { return r.refined ? 1.0 : 0.0; })},
  }};
  if (estimated)
    table.columns.push_back({"estimate", "1",
                             "Estimated error of s at the next speed of the diagram",
                             collect(rows, [](const auto& r) { return r.at.error; })});
  return table;
}

Columns checkTable(const CampbellDiagram& diagram, bool estimated) {
  const auto& rows = diagram.checks;
  Columns table{{
      {"speed", "rad/s", "Rotary speed", collect(rows, [](const auto& r) { return r.speed; })},
      {"mode", "1", "Number of the mode, 0 for one that is not tracked",
       collect(rows, [](const auto& r) { return r.mode; })},
      {"full", "Hz", "Frequency of the full model",
       collect(rows, [](const auto& r) { return r.full.imag() / twoPi; })},
      {"reduced", "Hz", "Frequency of the reduced model",
       collect(rows, [](const auto& r) { return r.reduced.imag() / twoPi; })},
      {"error", "1", "|s - s_full| / |s_full|",
       collect(rows, [](const auto& r) { return r.error; })},
  }};
  if (estimated)
    table.columns.push_back({"estimate", "1", "The same estimated without the full model",
                             collect(rows, [](const auto& r) { return r.estimate; })});
  table.columns.push_back({"mac", "1", "Modal assurance criterion of both shapes",
                           collect(rows, [](const auto& r) { return r.mac; })});
  return table;
}

Columns stateTable(const CampbellDiagram& diagram) {
  const auto& rows = diagram.states;
  Columns table{
      {{"speed", "rad/s", "Rotary speed", collect(rows, [](const auto& r) { return r.speed; })}}};
  if (rows.empty()) return table;
  for (std::size_t i = 0; i < rows.front().figures.size(); ++i) {
    const auto& one = rows.front().figures[i];
    table.columns.push_back({one.name, one.unit, one.longName,
                             collect(rows, [i](const auto& r) { return r.figures[i].value; })});
  }
  return table;
}

const char* whirlWord(double whirl) {
  constexpr double clear = 0.1;  ///< of a circle
  return whirl > clear ? "forward" : whirl < -clear ? "backward" : "-";
}

/// Warns of a window without a mode.
void warnOfEmptiness(const CampbellDiagram& diagram) {
  if (diagram.rows.empty())
    log::warn(
        "The window of frequencies contains no vibrating mode, or its resonance is wider than the "
        "window. Give a wider one (Campbell/Lowest Frequency, Highest Frequency).");
}

/// The range of frequencies for which the diagram has all modes [Hz].
FrequencyWindow covered(const CampbellDiagram& diagram, const CampbellSettings& settings) {
  if (settings.window) return *settings.window;
  const auto [least, most] = std::minmax_element(
      diagram.rows.begin(), diagram.rows.end(),
      [](const auto& a, const auto& b) { return a.frequency() < b.frequency(); });
  if (least == diagram.rows.end()) return {};
  return {settings.target ? least->frequency() : 0.0, most->frequency()};
}

/// Range of all excitations at all speeds [Hz].
FrequencyWindow excited(const CampbellSettings& settings) {
  FrequencyWindow all{std::numeric_limits<double>::infinity(), 0.0};
  for (const auto& line : settings.lines)
    for (const double speed : settings.speeds) {
      const double f = std::abs(line.at(speed)) / twoPi;
      all = {std::min(all.lowest, f), std::max(all.highest, f)};
    }
  return all;
}

/// Critical speeds exist only for modes in the diagram. `complete`: the diagram has all modes.
void sayWhatIsCovered(const CampbellDiagram& diagram, const CampbellSettings& settings,
                      bool complete) {
  if (complete || settings.lines.empty() || diagram.rows.empty()) return;
  const auto modes = covered(diagram, settings), lines = excited(settings);
  if (lines.lowest > modes.highest || lines.highest < modes.lowest)
    log::warn(fmt::format(
        "Excitations have {:.3g} to {:.3g} Hz, but the modes of the diagram {:.3g} to {:.3g} Hz: "
        "it shows no critical speeds. Give Campbell/Lowest Frequency and Highest Frequency about "
        "the excitations.",
        lines.lowest, lines.highest, modes.lowest, modes.highest));
  else if (lines.lowest < modes.lowest || lines.highest > modes.highest)
    log::info(
        fmt::format("not looked for: critical speeds outside of {:.3g} to {:.3g} Hz, the "
                    "modes of the diagram; excitations have {:.3g} to {:.3g} Hz",
                    modes.lowest, modes.highest, lines.lowest, lines.highest));
}

void print(const CampbellDiagram& diagram, const CampbellSettings& settings, bool estimated,
           bool complete) {
  log::info(
      fmt::format("critical speeds from {} rpm, where a mode has the frequency of an excitation:",
                  rangeOf(settings.speeds, rpmPerRadianPerSecond)));
  if (diagram.crossings.empty()) log::info("  none in this range of speeds");
  if (!diagram.crossings.empty())
    log::info(fmt::format("  {:>7} {:>5} {:>12} {:>12} {:>11}  {:<9}{}", "with", "mode", "speed",
                          "frequency", "damping", "whirl", estimated ? " estimate" : ""));
  for (const auto& one : diagram.crossings)
    log::info(fmt::format("  {:>7} {:>5} {:>8.2f} rpm {:>9.4f} Hz {:>11.3e}  {:<9}{}{}",
                          settings.lines[one.line].name, one.at.mode,
                          one.at.speed * rpmPerRadianPerSecond, one.at.frequency(),
                          one.at.damping(), whirlWord(one.at.whirl),
                          estimated ? fmt::format(" {:8.1e}", one.at.error) : "",
                          one.refined ? "" : " (interpolated)"));
  sayWhatIsCovered(diagram, settings, complete);
  const auto worst =
      std::max_element(diagram.checks.begin(), diagram.checks.end(),
                       [](const auto& a, const auto& b) { return a.error < b.error; });
  if (worst != diagram.checks.end())
    log::info(fmt::format(
        "spot checks with the full model: largest error {:.1e} ({}), at {:.2f} rpm and "
        "{:.4f} Hz",
        worst->error,
        estimated ? fmt::format("estimate {:.1e}", worst->estimate) : "without an estimate",
        worst->speed * rpmPerRadianPerSecond, worst->full.imag() / twoPi));
}

/// A larger estimate or error, relative to |s|, causes a warning.
constexpr double tooCoarse = 0.01;

void warnOfCoarseness(const CampbellDiagram& diagram) {
  const auto worst =
      std::max_element(diagram.rows.begin(), diagram.rows.end(),
                       [](const auto& a, const auto& b) { return a.error < b.error; });
  const auto checked =
      std::max_element(diagram.checks.begin(), diagram.checks.end(),
                       [](const auto& a, const auto& b) { return a.error < b.error; });
  if (worst != diagram.rows.end() && worst->error > tooCoarse)
    log::warn(fmt::format(
        "The estimated error of mode {} of the reduced model is {:.1f} % at {:.2f} rpm. Keep more "
        "modes (Reduction/Mode Selection), or leave the list Reduction out.",
        worst->mode, 100.0 * worst->error, worst->speed * rpmPerRadianPerSecond));
  else if (checked != diagram.checks.end() && checked->error > tooCoarse)
    log::warn(fmt::format(
        "At a spot check at {:.2f} rpm the reduced model is off the mode of {:.4g} Hz of the full "
        "one by {:.1f} %. Keep more modes (Reduction/Mode Selection), or leave the list Reduction "
        "out.",
        checked->speed * rpmPerRadianPerSecond, checked->full.imag() / twoPi,
        100.0 * checked->error));
}

void warnOfGrowth(const CampbellDiagram& diagram) {
  const auto worst =
      std::min_element(diagram.rows.begin(), diagram.rows.end(),
                       [](const auto& a, const auto& b) { return a.damping() < b.damping(); });
  if (worst != diagram.rows.end() && grows(worst->s)) {
    const auto first = std::find_if(diagram.rows.begin(), diagram.rows.end(),
                                    [](const auto& row) { return grows(row.s); });
    std::string from =
        fmt::format("at {:.2f} rpm (mode {})", first->speed * rpmPerRadianPerSecond, first->mode);
    const auto limit = std::find_if(diagram.limits.begin(), diagram.limits.end(),
                                    [](const auto& one) { return one.begins; });
    if (limit != diagram.limits.end() && limit->at.speed <= first->speed)
      from = fmt::format("from {:.2f} rpm on (mode {}, {:.4g} Hz{})",
                         limit->at.speed * rpmPerRadianPerSecond, limit->at.mode,
                         limit->at.frequency(), limit->refined ? "" : ", interpolated");
    log::warn(
        fmt::format("Modes are unstable {}. The lowest damping ratio is {:.2e}: mode {} at "
                    "{:.2f} rpm.",
                    from, worst->damping(), worst->mode, worst->speed * rpmPerRadianPerSecond));
  }
  const auto& left = diagram.divergences;
  if (left.empty()) return;
  const auto fastest = std::max_element(
      left.begin(), left.end(), [](const auto& a, const auto& b) { return a.growth < b.growth; });
  log::warn(
      fmt::format("The state is left without vibration at {} of the speeds, at {:.2f} rpm "
                  "first; the fastest as exp({:.3g} t), at {:.2f} rpm. Modes that do not "
                  "vibrate are not in the diagram.",
                  left.size(), left.front().speed * rpmPerRadianPerSecond, fastest->growth,
                  fastest->speed * rpmPerRadianPerSecond));
}

void writeLines(const CampbellSettings& settings, io::ResultsFile& file) {
  std::vector<std::string> names;
  for (const auto& line : settings.lines) names.push_back(line.name);
  const auto count = names.size();
  file.write("/excitations", names, "Excitations");
  file.write("/orders", collect(settings.lines, [](const auto& line) { return line.order; }),
             {count}, "1", "Their frequencies over the rotary speed");
  file.write("/offsets",
             collect(settings.lines, [](const auto& line) { return line.offset / twoPi; }), {count},
             "Hz", "What their frequencies have beside that");
}

/// Group /shapes: a row for each shape in the order of the diagram.
void writeShapes(const RotatingCase& rotating, const CampbellDiagram& diagram,
                 io::ResultsFile& file) {
  const auto& shapes = diagram.shapes;
  if (shapes.empty()) return;
  Columns{{
              {"speed", "rad/s", "Rotary speed",
               collect(shapes, [](const auto& one) { return one.at.speed; })},
              {"mode", "1", "Number of the mode",
               collect(shapes, [](const auto& one) { return one.at.mode; })},
              {"frequency", "Hz", "Im s / 2 pi",
               collect(shapes, [](const auto& one) { return one.at.frequency(); })},
              {"damping", "1", "Damping ratio",
               collect(shapes, [](const auto& one) { return one.at.damping(); })},
              {"whirl", "1", "1: circles with the rotation, -1: against it, 0: lines",
               collect(shapes, [](const auto& one) { return one.at.whirl; })},
              {"excitation", "1", "Position of the excitation it meets, from 1; 0: none",
               collect(shapes, [](const auto& one) { return one.line + 1; })},
          }}
      .writeGroup("shapes", file);
  const auto& model = rotating.model();
  const std::size_t nodes = model.recoveryNodes.size(), width = model.componentNames.size();
  std::vector<double> re, im;
  for (const auto& one : shapes)
    for (Eigen::Index row = 0; row < one.shape.size(); ++row)
      re.push_back(one.shape[row].real()), im.push_back(one.shape[row].imag());
  const std::string what =
      " of the displacements, the largest of a node across the axis (any, where there is none) "
      "scaled to 1";
  file.write("/shapes/real", re, {shapes.size(), nodes, width}, "1", "Real parts" + what);
  file.write("/shapes/imaginary", im, {shapes.size(), nodes, width}, "1", "Imaginary parts" + what);
}

void summarise(const RotatingCase& rotating, const CampbellDiagram& diagram,
               const CampbellSettings& settings, io::Summary& summary) {
  summary.set("campbell.model", rotating.reduced() ? "reduced" : "full");
  summary.set("campbell.dofs", rotating.model().size());
  summary.set("campbell.states", std::max(1L, static_cast<long>(diagram.states.size())));
  summary.set("campbell.points", static_cast<long>(settings.speeds.size()));
  double least = 1.0, estimate = 0.0, error = 0.0;
  int modes = 0;
  for (const auto& row : diagram.rows) {
    least = std::min(least, row.damping());
    estimate = std::max(estimate, row.error);
    modes = std::max(modes, row.mode);
  }
  if (diagram.rows.empty()) least = 0.0;
  summary.set("campbell.modes", modes);
  summary.set("campbell.least_damping", least);
  if (rotating.estimated()) summary.set("campbell.largest_estimate", estimate);
  for (const auto& check : diagram.checks) error = std::max(error, check.error);
  if (!diagram.checks.empty()) summary.set("campbell.largest_error", error);
  if (!diagram.divergences.empty()) {
    double fastest = 0.0;
    for (const auto& one : diagram.divergences) fastest = std::max(fastest, one.growth);
    summary.set("campbell.fastest_divergence", fastest);
  }
  for (const auto& one : diagram.limits) {
    io::SummaryRow row;
    row.set("mode", one.at.mode)
        .set("speed_rpm", one.at.speed * rpmPerRadianPerSecond)
        .set("hz", one.at.frequency())
        .set("begins", one.begins);
    summary.append("campbell.stability_limits", row);
  }
  for (const auto& one : diagram.crossings) {
    io::SummaryRow row;
    row.set("excitation", settings.lines[one.line].name)
        .set("order", settings.lines[one.line].order)
        .set("mode", one.at.mode)
        .set("speed_rpm", one.at.speed * rpmPerRadianPerSecond)
        .set("hz", one.at.frequency())
        .set("damping", one.at.damping())
        .set("whirl", one.at.whirl);
    if (rotating.estimated()) row.set("estimate", one.at.error);
    summary.append("campbell.crossings", row);
  }
}

/// Limits the default number of modes to that of the model. DeckError if the deck gives more.
void limitModes(const cases::Case& one, CampbellSettings& settings, int dofs) {
  if (settings.window || settings.modes <= dofs) return;
  if (one.deck().gives("Campbell/Modes"))
    throw DeckError(one.deck().error(
        "Campbell/Modes", "is " + std::to_string(settings.modes) + ", but the model has " +
                              std::to_string(dofs) + " dofs. Give fewer modes."));
  settings.modes = dofs;
}

}  // namespace

void runCampbell(const cases::Case& one, const std::string& folder, bool fresh) {
  if (!one.list().isSublist("Campbell"))
    throw DeckError(one.deck().file() +
                    ": the deck has no list Campbell. Add one with the Highest Speed.");
  auto settings = readCampbell(one.list().sublist("Campbell"));
  cases::AnalysisFiles files(one, folder, "campbell");
  CampbellDiagram diagram;
  std::unique_ptr<RotatingStates> states;
  files.complete(
      [&] {
        cases::announce(one);
        states = std::make_unique<RotatingStates>(one, settings.friction, settings.stateOfEachSpeed,
                                                  settings.speeds.front());
        states->first().announceLaws(settings.speeds);
        states->first().announceHeldStates();
        limitModes(one, settings, states->first().model().size());
        diagram = campbell(*states, settings, {one, files.folder().folder(), fresh});
        print(diagram, settings, states->first().estimated(),
              settings.modes >= states->first().model().size());
        warnOfEmptiness(diagram);
        warnOfGrowth(diagram);
        warnOfCoarseness(diagram);
        logStageTimes();
      },
      [&](io::ResultsFile& file) {
        const auto& rotating = states->first();
        const bool estimated = rotating.estimated();
        rowTable(diagram, estimated).write("campbell", files.folder(), file);
        crossingTable(diagram, settings, estimated).write("crossings", files.folder(), file);
        checkTable(diagram, estimated).write("spot_checks", files.folder(), file);
        stateTable(diagram).write("states", files.folder(), file);
        writeLines(settings, file);
        rotating.rest().writeProfile(file);
        writeShapes(rotating, diagram, file);
        summarise(rotating, diagram, settings, files.summary());
      });
}

}  // namespace tooljoint::response
