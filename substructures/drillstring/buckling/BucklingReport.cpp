// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "cases/run/AnalysisFiles.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "substructures/drillstring/buckling/BucklingPath.hpp"

namespace tooljoint::drillstring {
namespace {

/// "102.96 kN": an SI value in its printed unit, with this number of decimals.
std::string quantity(double si, const char* usual, int decimals) {
  const deck::PrintedUnit unit(usual);
  return fmt::format("{:.{}f} {}", unit(si), decimals, unit.name());
}
/// Rows of the table on the screen.
constexpr int printedRows = 20;

/// A column of buckling.csv, dataset of /path and key of summary.json's rows.
struct Column {
  const char* name;
  const char* unit;
  const char* longName;
  /// None: an empty cell, 0 in the file.
  std::optional<double> (*value)(const BucklingState&);
};

const Column columns[] = {
    {"weight_on_bit", "N", "Weight on bit",
     [](const BucklingState& s) { return std::optional(s.weight); }},
    {"branch", "", "Jumps to other states before",
     [](const BucklingState& s) { return std::optional(double(s.branch)); }},
    {"negative_pivots", "", "Negative pivots of the tangent; 0: stable",
     [](const BucklingState& s) { return std::optional(double(s.negativePivots)); }},
    {"bit_advance", "m", "Displacement of the bit down the hole",
     [](const BucklingState& s) { return std::optional(s.bitAdvance); }},
    {"shortening", "m", "Share of bending in it, up the hole",
     [](const BucklingState& s) { return std::optional(s.shortening); }},
    {"largest_deflection", "m", "Largest distance from the axis of the hole",
     [](const BucklingState& s) { return std::optional(s.lateral); }},
    {"contact_nodes", "", "Nodes at the wall",
     [](const BucklingState& s) { return std::optional(double(s.contacts)); }},
    {"largest_contact_force", "N", "Largest contact force of a node",
     [](const BucklingState& s) { return std::optional(s.largestContact); }},
    {"total_contact_force", "N", "Sum of the contact forces",
     [](const BucklingState& s) { return std::optional(s.totalContact); }},
    {"half_waves", "", "Half waves across the hole; 0: not buckled",
     [](const BucklingState& s) { return std::optional(double(s.halfWaves)); }},
    {"half_wave_length", "m", "Median length of a half wave; 0: fewer than two zeros",
     [](const BucklingState& s) { return s.halfWaveLength; }},
    {"turns", "", "Turns about the axis of the hole, net",
     [](const BucklingState& s) { return std::optional(s.turns); }},
    {"compression", "N", "Mean compression of the middle half",
     [](const BucklingState& s) { return std::optional(s.middle.compression); }},
    {"contact_force", "N/m", "Contact force per length of the middle half",
     [](const BucklingState& s) { return std::optional(s.middle.contactForce); }},
    {"helical_contact_force", "N/m", "The same of a helix, r F^2/(4 E I)",
     [](const BucklingState& s) { return std::optional(s.middle.helicalContactForce); }},
    {"strain", "", "Shortening by bending per length of the middle half",
     [](const BucklingState& s) { return std::optional(s.middle.shortening); }},
    {"helical_strain", "", "The same of a helix, r^2 F/(4 E I)",
     [](const BucklingState& s) { return std::optional(s.middle.helicalShortening); }},
    {"pitch", "m", "Length of a turn in the middle half where it winds one way, else 0",
     [](const BucklingState& s) { return s.middle.pitch; }},
    {"helical_pitch", "m", "The same of a helix, sqrt(8 pi^2 E I/F)", [](const BucklingState& s) {
       return s.middle.helicalPitch > 0.0 ? std::optional(s.middle.helicalPitch) : std::nullopt;
     }}};

std::string number(std::optional<double> value) {
  return value && std::isfinite(*value) ? fmt::format("{:.10g}", *value) : std::string();
}

class Report {
 public:
  Report(const BucklingSettings& settings, const BucklingPath& path)
      : settings_(settings), path_(path) {}

  void print() const {
    const auto& theory = path_.theory;
    log::info(fmt::format("crookedness {}, a turn in {}", deck::printed(path_.crookedness, "mm", 3),
                          deck::printed(path_.pitch, "m", 3)));
    log::info(fmt::format("limit       the straight string {} {}",
                          path_.limitIsSmooth ? "lies in half waves, without a negative pivot,"
                                              : "has a negative pivot",
                          path_.limit
                              ? "from " + quantity(*path_.limit, "kN", 2) + " on the bit on"
                              : "nowhere up to " + quantity(most(), "kN", 2) + " on the bit"));
    log::info(fmt::format(
        "formulas    sinusoidal {}, helical {}, sinusoidal no longer {}{}",
        inKilo(theory.sinusoidal), inKilo(theory.helical), inKilo(theory.spontaneous),
        theory.finiteLength > 0.0 ? fmt::format("; hinged at both ends {} with {} half waves",
                                                inKilo(theory.finiteLength), theory.finiteHalfWaves)
                                  : ""));
    printStates();
    judge();
  }

  void write(io::OutputFolder& folder, io::ResultsFile& file) const {
    table().stage(folder.file("buckling.csv"));
    profile().stage(folder.file("buckling_profile.csv"));
    for (const auto& column : columns) {
      std::vector<double> values;
      for (const auto& state : path_.states) values.push_back(column.value(state).value_or(0.0));
      file.write(std::string("/path/") + column.name, values, {values.size()},
                 *column.unit == 0 ? "1" : column.unit, column.longName);
    }
    file.write("/states/depth", path_.depth, {path_.depth.size()}, "m", "Depth of the nodes");
    for (const int side : {0, 1})
      states(file, side == 0 ? "deflection_high" : "deflection_right", "m",
             side == 0 ? "Deflection to the high side" : "Deflection to the right side",
             [side](const BucklingState& s, int n) { return s.displacement(side, n); });
    states(file, "contact_force", "N", "Contact force",
           [](const BucklingState& s, int n) { return s.contactForce(n); });
  }

  void summarise(io::Summary& summary) const {
    const auto finite = [&](const char* key, double value) {
      if (std::isfinite(value) && value > 0.0) summary.set(key, value);
    };
    summary.set("buckling.end", endName());
    summary.set("buckling.explanation", path_.report.end == statics::PathEnd::Reached
                                            ? "The path reached its end at " +
                                                  quantity(path_.report.parameter, "kN", 2) +
                                                  " on the bit."
                                            : path_.report.explanation);
    summary.set("buckling.steps", path_.report.steps);
    summary.set("buckling.halved_steps", path_.report.failedSteps);
    summary.set("buckling.last_weight_on_bit", path_.report.parameter);
    summary.set("buckling.crookedness", path_.crookedness);
    summary.set("buckling.crookedness_pitch", path_.pitch);
    if (path_.limit) summary.set("buckling.limit", *path_.limit);
    if (const auto* first = firstUnstable()) summary.set("buckling.unstable_from", first->weight);
    finite("buckling.theory.sinusoidal", path_.theory.sinusoidal);
    finite("buckling.theory.helical", path_.theory.helical);
    finite("buckling.theory.spontaneous", path_.theory.spontaneous);
    finite("buckling.theory.finite_length", path_.theory.finiteLength);
    if (path_.theory.finiteLength > 0.0)
      summary.set("buckling.theory.finite_half_waves", path_.theory.finiteHalfWaves);
    for (const auto weight : jumps()) {
      io::SummaryRow row;
      summary.append("buckling.jumps", row.set("weight_on_bit", weight));
    }
  }

 private:
  double most() const {
    double weight = 0.0;
    for (const auto& state : path_.states) weight = std::max(weight, state.weight);
    return weight;
  }

  static std::string inKilo(double force) {
    return std::isfinite(force) && force > 0.0 ? quantity(force, "kN", 2) : "none";
  }

  const BucklingState* firstUnstable() const {
    for (const auto& state : path_.states)
      if (state.negativePivots > 0) return &state;
    return nullptr;
  }

  /// Weights under which the string jumped [N].
  std::vector<double> jumps() const {
    std::vector<double> found;
    for (std::size_t i = 1; i < path_.states.size(); ++i)
      if (path_.states[i].branch > path_.states[i - 1].branch)
        found.push_back(path_.states[i].weight);
    return found;
  }

  const char* endName() const {
    switch (path_.report.end) {
      case statics::PathEnd::Reached:
        return "reached";
      case statics::PathEnd::Returned:
        return "returned";
      case statics::PathEnd::Steps:
        return "steps";
      case statics::PathEnd::Stopped:
      case statics::PathEnd::Failed:
        break;
    }
    return "failed";
  }

  void printStates() const {
    log::info(
        "contact force and shortening per length are those of the middle half of the compressed "
        "part, "
        "beside those of a helix");
    log::info(fmt::format("{:>8} {:>10} {:>9} {:>6} {:>8} {:>7} {:>6} {:>15} {:>17}", "WOB", "bit",
                          "deflected", "walls", "largest", "pivots", "waves", "contact, helix",
                          "strain, helix"));
    const deck::PrintedUnit force("kN"), length("mm"), perLength("N/m");
    log::info(fmt::format("{:>8} {:>10} {:>9} {:>6} {:>8} {:>7} {:>6} {:>15} {:>17}", force.name(),
                          length.name(), length.name(), "nodes", force.name(), "", "",
                          perLength.name(), "1e-6"));
    const int count = static_cast<int>(path_.states.size());
    const int stride = std::max(1, count / printedRows);
    for (int i = 0; i < count; ++i) {
      const auto& state = path_.states[at(i)];
      const bool jumped = i > 0 && state.branch > path_.states[at(i - 1)].branch;
      if (jumped) log::info("         the string jumps");
      if (i % stride != 0 && i + 1 != count && !jumped) continue;
      log::info(fmt::format(
          "{:>8.2f} {:>10.3f} {:>9.2f} {:>6} {:>8.3f} {:>7} {:>6} {:>7.1f} {:>7.1f} {:>8.2f} "
          "{:>8.2f}",
          force(state.weight), length(state.bitAdvance), length(state.lateral), state.contacts,
          force(state.largestContact), state.negativePivots, state.halfWaves,
          perLength(state.middle.contactForce), perLength(state.middle.helicalContactForce),
          1e6 * state.middle.shortening, 1e6 * state.middle.helicalShortening));
    }
  }

  void judge() const {
    log::info(fmt::format("path        {} steps by LOCA, {} more tried again in half",
                          path_.report.steps, path_.report.failedSteps));
    const auto* first = firstUnstable();
    if (first != nullptr && settings_.atLimit == LimitRule::Follow)
      log::warn(
          fmt::format("The path has unstable states from {} on the bit on; a real string does not "
                      "stay in them. Set \"At A Limit\" to \"Jump\" to find the stable states.",
                      quantity(first->weight, "kN", 2)));
  }

  io::Csv table() const {
    std::vector<io::Csv::Column> heads;
    for (const auto& column : columns) heads.push_back({column.name, column.unit});
    io::Csv csv(heads);
    for (const auto& state : path_.states) {
      std::vector<std::string> cells;
      for (const auto& column : columns) cells.push_back(number(column.value(state)));
      csv.row(cells);
    }
    return csv;
  }

  /// The last state.
  io::Csv profile() const {
    io::Csv csv({{"depth", "m"},
                 {"deflection_high", "m"},
                 {"deflection_right", "m"},
                 {"contact_force", "N"},
                 {"compression_below", "N"}});
    if (path_.states.empty()) return csv;
    const auto& state = path_.states.back();
    for (int n = 0; n < static_cast<int>(path_.depth.size()); ++n)
      csv.row({number(path_.depth[at(n)]), number(state.displacement(0, n)),
               number(state.displacement(1, n)), number(state.contactForce(n)),
               n < state.compression.size() ? number(state.compression(n)) : std::string()});
    return csv;
  }

  template <class Value>
  void states(io::ResultsFile& file, const std::string& name, const std::string& unit,
              const std::string& longName, const Value& value) const {
    std::vector<double> values;
    for (const auto& state : path_.states)
      for (int n = 0; n < static_cast<int>(path_.depth.size()); ++n)
        values.push_back(value(state, n));
    file.write("/states/" + name, values, {path_.states.size(), path_.depth.size()}, unit,
               longName + ", a row for each of buckling.csv");
  }

  const BucklingSettings& settings_;
  const BucklingPath& path_;
};

}  // namespace

void reportBuckling(const DrillstringCase& one, const std::string& folder, bool fresh) {
  const Scene& scene = one.scene();
  const auto settings = bucklingSettings(scene);
  const BucklingPath path = cases::completeReport(
      one, folder, "buckling",
      [&] {
        const auto kept = cases::analysisFolder(one, folder, "buckling");
        return bucklingPath(scene, settings, {one, kept, fresh});
      },
      [&](const BucklingPath& states) { return Report(settings, states); });
  if (path.report.end != statics::PathEnd::Reached)
    throw ConvergenceError(
        fmt::format("The states of the string were computed up to {} on the bit only. ",
                    quantity(path.report.parameter, "kN", 2)) +
        path.report.explanation +
        " The tables have the states up to there. Give a smaller Largest Step, a larger "
        "Crookedness, more Max Steps or a smaller Last Weight On Bit in the list Buckling.");
}

}  // namespace tooljoint::drillstring
