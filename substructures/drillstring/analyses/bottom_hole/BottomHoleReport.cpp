// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>

#include "cases/run/AnalysisFiles.hpp"
#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"

namespace tooljoint::drillstring {
namespace {

/// Imbalance of forces or moments, and change with the length, above which a warning is given.
constexpr double largestDefect = 0.02, largestChange = 0.02;

double degrees(double angle) { return angle / constants::degree; }

const BottomHoleStation& mostBent(const BottomHoleState& state) {
  return *std::max_element(
      state.stations.begin(), state.stations.end(),
      [](const auto& a, const auto& b) { return a.moment.norm() < b.moment.norm(); });
}
const BottomHoleStation& mostStressed(const BottomHoleState& state) {
  return *std::max_element(state.stations.begin(), state.stations.end(),
                           [](const auto& a, const auto& b) { return a.vonMises < b.vonMises; });
}

class Report {
 public:
  Report(const Scene& scene, const BottomHoleSettings& settings, const BottomHoleSweep& sweep)
      : settings_(settings),
        sweep_(sweep),
        holeInclination_(scene.well.inclination(scene.string.length())) {}

  void print() const {
    const auto& length = sweep_.length;
    log::info(fmt::format("bottom-hole assembly: {} above the bit are modelled; {}",
                          metres(length.length),
                          length.checkedAgainst == length.length
                              ? std::string("that is the whole string")
                              : fmt::format("with {} force and tilt at the bit differ by {:.2g} %",
                                            metres(length.checkedAgainst), 100.0 * length.change)));
    log::info(
        "side force of the bit on the rock, tilt of the bit, sag of the survey tool: high side, "
        "right side");
    log::info(fmt::format("{:>5} {:>6} {:>9} {:>14} {:>14} {:>14} {:>8} {:>13} {:>6}", "incl.",
                          "WOB", "tool face", "side force", "tilt", "sag", "tangency", "moment",
                          "stress"));
    log::info(fmt::format("{:>5} {:>6} {:>9} {:>14} {:>14} {:>14} {:>8} {:>13} {:>6}", "deg",
                          force_.name(), "deg", force_.name(), "deg", "deg", length_.name(),
                          moment_.name() + " at " + length_.name(), stress_.name()));
    for (const auto& row : sweep_.rows) print(row);
    judge();
  }

  void write(io::OutputFolder& folder, io::ResultsFile& file) const {
    rowTable().stage(folder.file("bha.csv"));
    contactTable().stage(folder.file("bha_contacts.csv"));
    profileTable().stage(folder.file("bha_profile.csv"));
    writeRows(file);
    writeProfiles(file);
  }

  void summarise(io::Summary& summary) const {
    summary.set("bha.length", sweep_.length.length);
    summary.set("bha.checked_length", sweep_.length.checkedAgainst);
    summary.set("bha.length_change", sweep_.length.change);
    double force = 0.0, moment = 0.0;
    for (const auto& row : sweep_.rows) {
      force = std::max(force, row.state.forceDefect);
      moment = std::max(moment, row.state.momentDefect);
      summary.append("bha.rows", summaryRow(row));
    }
    summary.set("bha.missing", static_cast<long>(sweep_.missing.size()));
    summary.set("bha.force_defect", force);
    summary.set("bha.moment_defect", moment);
  }

 private:
  /// "12.3 m", or in the printed unit of length.
  std::string metres(double length) const {
    return fmt::format("{:.1f} {}", length_(length), length_.name());
  }
  double inclination(const BottomHoleRow& row) const {
    return row.point.inclination.value_or(holeInclination_);
  }

  std::string pair(const Sides& sides, double scale, int digits) const {
    const double step = std::pow(10.0, -digits);
    const auto rounded = [&](double value) {
      return std::round(value / scale / step) * step + 0.0;  // no -0
    };
    return fmt::format("{:.{}f}, {:.{}f}", rounded(sides.x()), digits, rounded(sides.y()), digits);
  }

  void print(const BottomHoleRow& row) const {
    const auto& state = row.state;
    const auto& bent = mostBent(state);
    log::info(fmt::format(
        "{:>5.1f} {:>6.1f} {:>9} {:>14} {:>14} {:>14} {:>8} {:>13} {:>6.0f}",
        degrees(inclination(row)), force_(row.point.weight),
        row.rotating ? "rotating" : fmt::format("{:.0f}", degrees(row.point.toolFace)),
        pair(state.sideForce, force_.factor(), 2), pair(state.tilt, constants::degree, 3),
        settings_.surveyTool ? pair(state.sag, constants::degree, 3) : "-",
        state.tangency >= 0.0 ? fmt::format("{:.1f}", length_(state.tangency)) : "-",
        fmt::format("{:.1f} at {:.1f}", moment_(bent.moment.norm()), length_(bent.fromBit)),
        stress_(mostStressed(state).vonMises)));
  }

  void judge() const {
    const auto& length = sweep_.length;
    if (length.change > largestChange)
      log::warn(fmt::format(
          "Force and tilt at the bit differ by {:.1f} % between {} and {} of string above the bit. "
          "{}",
          100.0 * length.change, metres(length.checkedAgainst), metres(length.length),
          settings_.length ? "Give a larger Length, or none."
                           : "The string of the deck ends there. Give a longer string."));
    double force = 0.0, moment = 0.0;
    int unstable = 0;
    for (const auto& row : sweep_.rows) {
      force = std::max(force, row.state.forceDefect);
      moment = std::max(moment, row.state.momentDefect);
      if (!row.state.stable) ++unstable;
    }
    log::info(
        fmt::format("balance     walls, bit, supports and pads against buoyed weight and weight on "
                    "bit: force {:.1e} of them, moment about the bit {:.1e} of its parts",
                    force, moment));
    if (std::max(force, moment) > largestDefect)
      log::warn(fmt::format(
          "Forces or moments do not balance: {:.1f} % and {:.1f} %. The analysis assumes small "
          "displacements. Use smaller bends, or a smaller Element Length.",
          100.0 * force, 100.0 * moment));
    for (const auto& one : sweep_.missing)
      log::warn(fmt::format(
          "No equilibrium was found, so no table has this state: {:.1f} {} on the bit{}{}. {}",
          force_(one.point.weight), force_.name(),
          one.point.inclination
              ? fmt::format(", inclination {:.1f} deg", *one.point.inclination / constants::degree)
              : "",
          one.rotating ? ", rotating" : "", one.reason));
    if (unstable > 0)
      log::warn(
          fmt::format("{} of {} states are unstable: the string buckles under that weight on bit.",
                      unstable, sweep_.rows.size()));
  }

  std::vector<io::Csv::Column> keys() const {
    return {{"inclination", "rad"}, {"weight_on_bit", "N"}, {"mode", ""}, {"tool_face", "rad"}};
  }
  /// A rotating string has no tool face.
  std::vector<std::string> keysOf(const BottomHoleRow& row) const {
    return {number(inclination(row)), number(row.point.weight),
            row.rotating ? "rotating" : "sliding", row.rotating ? "" : number(row.point.toolFace)};
  }
  static std::string number(double value) { return fmt::format("{:.10g}", value); }

  static void addColumns(std::vector<io::Csv::Column>& columns,
                         const std::vector<io::Csv::Column>& more) {
    columns.insert(columns.end(), more.begin(), more.end());
  }
  static void addValues(std::vector<std::string>& cells, const std::vector<double>& values) {
    for (const double value : values) cells.push_back(number(value));
  }

  io::Csv rowTable() const {
    auto columns = keys();
    addColumns(columns, {{"side_force_high", "N"},
                         {"side_force_right", "N"},
                         {"tilt_high", "rad"},
                         {"tilt_right", "rad"},
                         {"largest_moment", "N m"},
                         {"largest_moment_from_bit", "m"},
                         {"largest_von_mises", "Pa"},
                         {"largest_von_mises_from_bit", "m"},
                         {"force_defect", ""},
                         {"moment_defect", ""},
                         {"stable", ""},
                         {"tangency", "m"},
                         {"sag_high", "rad"},
                         {"sag_right", "rad"}});
    io::Csv table(columns);
    for (const auto& row : sweep_.rows) {
      const auto& state = row.state;
      const auto& bent = mostBent(state);
      const auto& stressed = mostStressed(state);
      auto cells = keysOf(row);
      addValues(cells, {state.sideForce.x(), state.sideForce.y(), state.tilt.x(), state.tilt.y(),
                        bent.moment.norm(), bent.fromBit, stressed.vonMises, stressed.fromBit,
                        state.forceDefect, state.momentDefect, state.stable ? 1.0 : 0.0});
      cells.push_back(state.tangency >= 0.0 ? number(state.tangency) : "");
      for (const double sag : {state.sag.x(), state.sag.y()})
        cells.push_back(settings_.surveyTool ? number(sag) : "");
      table.row(cells);
    }
    return table;
  }

  io::Csv contactTable() const {
    auto columns = keys();
    addColumns(columns, {{"gauge", ""},
                         {"from_bit", "m"},
                         {"force_high", "N"},
                         {"force_right", "N"},
                         {"force", "N"}});
    io::Csv table(columns);
    for (const auto& row : sweep_.rows)
      for (const auto& gauge : row.state.gauges) {
        auto cells = keysOf(row);
        cells.push_back(gauge.component);
        addValues(cells, {gauge.fromBit, gauge.force.x(), gauge.force.y(), gauge.force.norm()});
        table.row(cells);
      }
    return table;
  }

  io::Csv profileTable() const {
    auto columns = keys();
    addColumns(columns, {{"from_bit", "m"},
                         {"deflection_high", "m"},
                         {"deflection_right", "m"},
                         {"clearance", "m"},
                         {"wall_force_high", "N"},
                         {"wall_force_right", "N"},
                         {"moment_high", "N m"},
                         {"moment_right", "N m"},
                         {"axial_force", "N"},
                         {"torque", "N m"},
                         {"von_mises", "Pa"}});
    io::Csv table(columns);
    for (const auto& row : sweep_.rows)
      for (const auto& one : row.state.stations) {
        auto cells = keysOf(row);
        addValues(cells, {one.fromBit, one.deflection.x(), one.deflection.y(), one.clearance,
                          one.wallForce.x(), one.wallForce.y(), one.moment.x(), one.moment.y(),
                          one.axialForce, one.torque, one.vonMises});
        table.row(cells);
      }
    return table;
  }

  template <class Value>
  void column(io::ResultsFile& file, const std::string& name, const std::string& unit,
              const std::string& longName, const Value& value) const {
    std::vector<double> values;
    for (const auto& row : sweep_.rows) values.push_back(value(row));
    file.write("/rows/" + name, values, {values.size()}, unit, longName);
  }

  void writeRows(io::ResultsFile& file) const {
    using Row = BottomHoleRow;
    column(file, "inclination", "rad", "Inclination of the hole at the bit",
           [this](const Row& row) { return inclination(row); });
    column(file, "weight_on_bit", "N", "Weight on bit",
           [](const Row& row) { return row.point.weight; });
    column(file, "rotating", "1", "1 where the string turns, 0 where it slides",
           [](const Row& row) { return row.rotating ? 1.0 : 0.0; });
    column(file, "tool_face", "rad", "Tool face; where the string turns, that of its pads",
           [](const Row& row) { return row.point.toolFace; });
    for (const int side : {0, 1}) {
      const std::string of = side == 0 ? "_high" : "_right";
      const std::string to = side == 0 ? " to the high side" : " to the right side";
      column(file, "side_force" + of, "N", "Force of the bit on the rock" + to,
             [side](const Row& row) { return row.state.sideForce(side); });
      column(file, "tilt" + of, "rad", "Tilt of the bit" + to,
             [side](const Row& row) { return row.state.tilt(side); });
    }
  }

  template <class Value>
  void profile(io::ResultsFile& file, const std::string& name, const std::string& unit,
               const std::string& longName, const Value& value) const {
    std::vector<double> values;
    for (const auto& row : sweep_.rows)
      for (const auto& one : row.state.stations) values.push_back(value(one));
    const auto rows = sweep_.rows.size();
    file.write("/profile/" + name, values, {rows, values.size() / rows}, unit,
               longName + ", a row for each of bha.csv");
  }

  void writeProfiles(io::ResultsFile& file) const {
    using Station = BottomHoleStation;
    profile(file, "from_bit", "m", "Distance from the bit",
            [](const Station& one) { return one.fromBit; });
    profile(file, "clearance", "m", "Radial clearance",
            [](const Station& one) { return one.clearance; });
    profile(file, "axial_force", "N", "Effective tension",
            [](const Station& one) { return one.axialForce; });
    profile(file, "torque", "N m", "Torque", [](const Station& one) { return one.torque; });
    profile(file, "von_mises", "Pa", "Von Mises stress",
            [](const Station& one) { return one.vonMises; });
    for (const int side : {0, 1}) {
      const std::string of = side == 0 ? "_high" : "_right";
      const std::string to = side == 0 ? " to the high side" : " to the right side";
      profile(file, "deflection" + of, "m", "Deflection" + to,
              [side](const Station& one) { return one.deflection(side); });
      profile(file, "wall_force" + of, "N", "Force of the wall" + to,
              [side](const Station& one) { return one.wallForce(side); });
      profile(file, "moment" + of, "N m", "Bending moment that bends" + to,
              [side](const Station& one) { return one.moment(side); });
    }
  }

  io::SummaryRow summaryRow(const BottomHoleRow& row) const {
    const auto& state = row.state;
    const auto& bent = mostBent(state);
    io::SummaryRow one;
    one.set("inclination", inclination(row))
        .set("weight_on_bit", row.point.weight)
        .set("mode", row.rotating ? "rotating" : "sliding")
        .set("side_force_high", state.sideForce.x())
        .set("side_force_right", state.sideForce.y())
        .set("tilt_high", state.tilt.x())
        .set("tilt_right", state.tilt.y())
        .set("largest_moment", bent.moment.norm())
        .set("largest_moment_from_bit", bent.fromBit)
        .set("largest_von_mises", mostStressed(state).vonMises)
        .set("stable", state.stable);
    if (!row.rotating) one.set("tool_face", row.point.toolFace);
    if (state.tangency >= 0.0) one.set("tangency", state.tangency);
    if (settings_.surveyTool) one.set("sag_high", state.sag.x()).set("sag_right", state.sag.y());
    return one;
  }

  const deck::PrintedUnit length_{"m"}, force_{"kN"}, moment_{"kN m"}, stress_{"MPa"};
  const BottomHoleSettings& settings_;
  const BottomHoleSweep& sweep_;
  double holeInclination_;  ///< at the bit of the deck [rad]
};

}  // namespace

void reportBottomHole(const DrillstringCase& one, const std::string& folder, bool fresh) {
  const Scene& scene = one.scene();
  const auto settings = bottomHoleSettings(scene);
  cases::completeReport(
      one, folder, "bha",
      [&] {
        const auto kept = cases::analysisFolder(one, folder, "bha");
        return bottomHoleSweep(scene, settings, {one, kept, fresh});
      },
      [&](const BottomHoleSweep& sweep) { return Report(scene, settings, sweep); });
}

}  // namespace tooljoint::drillstring
