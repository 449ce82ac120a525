// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"
#include "substructures/drillstring/scene/Stages.hpp"

namespace tooljoint::drillstring {
namespace {

/// Torque out of balance by more of its scale is said.
constexpr double worthAWarning = 0.02;

/// Tables hold finite numbers alone: a margin of a string that nothing loads, and the loads at the
/// surface of one that locks up, are left empty.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "";
}
std::string depthOf(const Margin& margin) {
  return std::isfinite(margin.factor) ? number(margin.depth) : "";
}

std::string lockUp(double depth) { return depth >= 0.0 ? number(depth) : ""; }

bool hasStiff(const TorqueDragProfile& profile) {
  return profile.stiff.has_value() && profile.stiff->found();
}

/// The largest contact force of the stiff string and where it acts.
Margin largestContact(const StiffLoads& stiff) {
  const auto largest = std::max_element(stiff.contactForce.begin(), stiff.contactForce.end());
  return {*largest, stiff.depth[static_cast<std::size_t>(largest - stiff.contactForce.begin())]};
}

/// Least margin to yield of the stiff string, at the middle of an element; infinite without a yield
/// strength.
Margin stiffYield(const StiffLoads& stiff, const softstring::TorqueDragSettings& settings) {
  const auto most = std::max_element(stiff.vonMises.begin(), stiff.vonMises.end());
  const auto e = static_cast<std::size_t>(most - stiff.vonMises.begin());
  if (!settings.yieldStrength || !(*most > 0.0))
    return {std::numeric_limits<double>::infinity(), 0.0};
  return {*settings.yieldStrength / *most, 0.5 * (stiff.depth[e] + stiff.depth[e + 1])};
}

std::vector<std::string> stiffCells(const TorqueDragProfile& profile,
                                    const softstring::TorqueDragSettings& settings) {
  constexpr std::size_t columns = 8;
  if (!hasStiff(profile)) return std::vector<std::string>(columns);
  const StiffLoads& stiff = *profile.stiff;
  const Margin contact = largestContact(stiff), yield = stiffYield(stiff, settings);
  return {number(stiff.hookLoad + settings.blockWeight),
          number(stiff.surfaceTorque),
          number(stiff.twist),
          number(stiff.stretch),
          number(contact.factor),
          number(contact.depth),
          number(yield.factor),
          depthOf(yield)};
}

io::Csv rowTable(const std::vector<TorqueDragProfile>& profiles,
                 const softstring::TorqueDragSettings& settings) {
  io::Csv table({{"bit_depth", "m"},
                 {"operation", ""},
                 {"hook_load", "N"},
                 {"surface_torque", "N m"},
                 {"twist", "rad"},
                 {"stretch", "m"},
                 {"neutral_depth", "m"},
                 {"side_force", "N/m"},
                 {"side_force_depth", "m"},
                 {"yield_margin", ""},
                 {"yield_margin_depth", "m"},
                 {"sinusoidal_margin", ""},
                 {"sinusoidal_margin_depth", "m"},
                 {"helical_margin", ""},
                 {"helical_margin_depth", "m"},
                 {"lock_up_depth", "m"},
                 {"stiff_hook_load", "N"},
                 {"stiff_surface_torque", "N m"},
                 {"stiff_twist", "rad"},
                 {"stiff_stretch", "m"},
                 {"stiff_contact_force", "N"},
                 {"stiff_contact_force_depth", "m"},
                 {"stiff_yield_margin", ""},
                 {"stiff_yield_margin_depth", "m"}});
  for (const auto& profile : profiles) {
    const TorqueDragRow& row = profile.row;
    std::vector<std::string> cells{number(row.bit),
                                   row.operation,
                                   number(row.hookLoad),
                                   number(row.surfaceTorque),
                                   number(row.twist),
                                   number(row.stretch),
                                   number(row.neutralDepth),
                                   number(row.largestSideForce),
                                   number(row.sideForceDepth),
                                   number(row.yield.factor),
                                   depthOf(row.yield),
                                   number(row.sinusoidal.factor),
                                   depthOf(row.sinusoidal),
                                   number(row.helical.factor),
                                   depthOf(row.helical),
                                   lockUp(row.lockUpDepth)};
    for (auto& cell : stiffCells(profile, settings)) cells.push_back(std::move(cell));
    table.row(std::move(cells));
  }
  return table;
}

io::Csv profileTable(const std::vector<TorqueDragProfile>& profiles, double bit) {
  io::Csv table({{"operation", ""},
                 {"depth", "m"},
                 {"tension", "N"},
                 {"torque", "N m"},
                 {"side_force", "N/m"},
                 {"von_mises", "Pa"},
                 {"sinusoidal_limit", "N"},
                 {"helical_limit", "N"}});
  for (const auto& profile : profiles) {
    if (profile.row.bit != bit) continue;
    for (std::size_t i = 0; i < profile.loads.depth.size(); ++i)
      table.row({profile.row.operation, number(profile.loads.depth[i]),
                 number(profile.loads.tension[i]), number(profile.loads.torque[i]),
                 number(profile.loads.sideForce[i]), number(profile.vonMises[i]),
                 number(profile.sinusoidal[i]), number(profile.helical[i])});
  }
  return table;
}

/// A line a node; loads of an element stand at its upper node.
io::Csv stiffProfileTable(const std::vector<TorqueDragProfile>& profiles, double bit) {
  io::Csv table({{"operation", ""},
                 {"depth", "m"},
                 {"contact_force", "N"},
                 {"tension", "N"},
                 {"torque", "N m"},
                 {"bending_moment", "N m"},
                 {"von_mises", "Pa"}});
  for (const auto& profile : profiles) {
    if (profile.row.bit != bit || !hasStiff(profile)) continue;
    const StiffLoads& stiff = *profile.stiff;
    for (std::size_t i = 0; i < stiff.depth.size(); ++i) {
      const auto ofElement = [&](const std::vector<double>& values) {
        return i < values.size() ? number(values[i]) : std::string();
      };
      table.row({profile.row.operation, number(stiff.depth[i]), number(stiff.contactForce[i]),
                 ofElement(stiff.tension), ofElement(stiff.torque), ofElement(stiff.moment),
                 ofElement(stiff.vonMises)});
    }
  }
  return table;
}

std::string text(double value, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}", value, digits) : "-";
}
/// An SI value in the unit it is printed in.
std::string text(double value, const char* usual, int digits) {
  const deck::PrintedUnit unit(usual);
  return std::isfinite(value) ? text(unit(value), digits) + " " + unit.name() : "-";
}

void print(const TorqueDragRow& row) {
  log::info(fmt::format("{:<18}{:>13}{:>15}{:>9}{:>14}{:>8}{:>8}{:>8}", row.operation,
                        text(row.hookLoad, "kN", 1), text(row.surfaceTorque, "kN m", 2),
                        text(row.twist / constants::twoPi, 2),
                        text(row.largestSideForce, "kN/m", 2), text(row.yield.factor, 2),
                        text(row.sinusoidal.factor, 2), text(row.helical.factor, 2)));
  if (row.lockUpDepth >= 0.0)
    log::warn(
        fmt::format("{} with the bit at {}: the string locks up at {}. No force from the surface "
                    "reaches the bit.",
                    row.operation, text(row.bit, "m", 0), text(row.lockUpDepth, "m", 0)));
  else if (row.hookLoad < 0.0)
    log::warn(
        fmt::format("{} with the bit at {}: the hook load is {}. The string has to be pushed from "
                    "the surface.",
                    row.operation, text(row.bit, "m", 0), text(row.hookLoad, "kN", 1)));
}

/// "+1.2 %" of the soft string's value.
std::string beside(double stiff, double soft) {
  if (!std::isfinite(soft) || soft == 0.0) return "-";
  return fmt::format("{:+.1f} %", 100.0 * (stiff / soft - 1.0));
}

void printStiff(const Scene& scene, const TorqueDragProfile& profile,
                const softstring::TorqueDragSettings& settings) {
  const TorqueDragRow& row = profile.row;
  const StiffLoads& stiff = *profile.stiff;
  if (!stiff.found())
    return log::warn(fmt::format("{} with the bit at {}: the stiff string has no result. {}",
                                 row.operation, text(row.bit, "m", 0), stiff.failure));
  const double hookLoad = stiff.hookLoad + settings.blockWeight;
  log::info(fmt::format(
      "{:<18}{:>13}{:>9}{:>15}{:>9}{:>9}{:>14}{:>8}", row.operation, text(hookLoad, "kN", 1),
      beside(hookLoad, row.hookLoad), text(stiff.surfaceTorque, "kN m", 2),
      beside(stiff.surfaceTorque, row.surfaceTorque), text(stiff.twist / constants::twoPi, 2),
      text(largestContact(stiff).factor, "kN", 2), text(stiffYield(stiff, settings).factor, 2)));
  if (stiff.torqueDefect > worthAWarning && prestressRemark(scene).empty())
    log::warn(
        fmt::format("{} with the bit at {}: the torque of the stiff string is out of balance by "
                    "{:.1f} %. Use shorter elements where the well bends most.",
                    row.operation, text(row.bit, "m", 0), 100.0 * stiff.torqueDefect));
}

}  // namespace

void reportTorqueDrag(const Scene& scene, const std::string& folder) {
  const auto settings = torqueDragSettings(scene);
  const auto profiles = torqueDrag(scene);
  double deepest = 0.0;
  for (const auto& profile : profiles) deepest = std::max(deepest, profile.row.bit);
  log::info(
      fmt::format("torque and drag, soft string, bit at {}; margins are allowed over present load",
                  text(deepest, "m", 1)));
  log::info(fmt::format("{:<18}{:>13}{:>15}{:>9}{:>14}{:>8}{:>8}{:>8}", "operation", "hook load",
                        "surface torque", "turns", "side force", "yield", "sinus.", "helix"));
  for (const auto& profile : profiles)
    if (profile.row.bit == deepest) print(profile.row);
  const bool stiff = std::any_of(profiles.begin(), profiles.end(),
                                 [](const auto& profile) { return profile.stiff.has_value(); });
  if (stiff) {
    log::info("the string with bending stiffness, clearance and contact beside it");
    log::info(fmt::format("{:<18}{:>13}{:>9}{:>15}{:>9}{:>9}{:>14}{:>8}", "operation", "hook load",
                          "", "surface torque", "", "turns", "contact", "yield"));
    for (const auto& profile : profiles)
      if (profile.stiff && (profile.row.bit == deepest || !profile.stiff->found()))
        printStiff(scene, profile, settings);
    if (const auto remark = prestressRemark(scene); !remark.empty()) log::warn(remark);
  }
  if (folder.empty()) return;
  std::string files = "torque_drag.csv, torque_drag_profile.csv";
  rowTable(profiles, settings).writeInto(folder, "torque_drag.csv");
  profileTable(profiles, deepest).writeInto(folder, "torque_drag_profile.csv");
  if (stiff) {
    stiffProfileTable(profiles, deepest).writeInto(folder, "torque_drag_stiff_profile.csv");
    files += ", torque_drag_stiff_profile.csv";
  }
  log::info("results     " + folder + ": " + files);
}

}  // namespace tooljoint::drillstring
