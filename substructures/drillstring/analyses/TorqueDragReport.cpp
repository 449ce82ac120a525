// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <fmt/format.h>

#include "common/Constants.hpp"
#include "common/report/Log.hpp"
#include "io/Csv.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

namespace tooljoint::drillstring {
namespace {

/// Tables hold finite numbers alone: a margin of a string that nothing loads, and the loads at the
/// surface of one that locks up, are left empty.
std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "";
}
std::string depthOf(const Margin& margin) {
  return std::isfinite(margin.factor) ? number(margin.depth) : "";
}

std::string lockUp(double depth) { return depth >= 0.0 ? number(depth) : ""; }

io::Csv rowTable(const std::vector<TorqueDragProfile>& profiles) {
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
                 {"lock_up_depth", "m"}});
  for (const auto& profile : profiles) {
    const TorqueDragRow& row = profile.row;
    table.row({number(row.bit), row.operation, number(row.hookLoad), number(row.surfaceTorque),
               number(row.twist), number(row.stretch), number(row.neutralDepth),
               number(row.largestSideForce), number(row.sideForceDepth), number(row.yield.factor),
               depthOf(row.yield), number(row.sinusoidal.factor), depthOf(row.sinusoidal),
               number(row.helical.factor), depthOf(row.helical), lockUp(row.lockUpDepth)});
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

std::string text(double value, const char* unit, int digits) {
  return std::isfinite(value) ? fmt::format("{:.{}f}{}", value, digits, unit) : "-";
}

void print(const TorqueDragRow& row) {
  log::info(fmt::format("{:<18}{:>13}{:>15}{:>9}{:>14}{:>8}{:>8}{:>8}", row.operation,
                        text(row.hookLoad / 1e3, " kN", 1),
                        text(row.surfaceTorque / 1e3, " kN m", 2),
                        text(row.twist / constants::twoPi, "", 2),
                        text(row.largestSideForce / 1e3, " kN/m", 2), text(row.yield.factor, "", 2),
                        text(row.sinusoidal.factor, "", 2), text(row.helical.factor, "", 2)));
  if (row.lockUpDepth >= 0.0)
    log::warn(
        fmt::format("{} with the bit at {:.0f} m: the string locks up at {:.0f} m. No force "
                    "from the surface reaches the bit.",
                    row.operation, row.bit, row.lockUpDepth));
  else if (row.hookLoad < 0.0)
    log::warn(
        fmt::format("{} with the bit at {:.0f} m: the hook load is {:.1f} kN. The string has "
                    "to be pushed from the surface.",
                    row.operation, row.bit, row.hookLoad / 1e3));
}

}  // namespace

void reportTorqueDrag(const Scene& scene, const std::string& folder) {
  const auto profiles = torqueDrag(scene);
  double deepest = 0.0;
  for (const auto& profile : profiles) deepest = std::max(deepest, profile.row.bit);
  log::info(
      fmt::format("torque and drag, soft string, bit at {:.1f} m; margins are allowed over "
                  "present load",
                  deepest));
  log::info(fmt::format("{:<18}{:>13}{:>15}{:>9}{:>14}{:>8}{:>8}{:>8}", "operation", "hook load",
                        "surface torque", "turns", "side force", "yield", "sinus.", "helix"));
  for (const auto& profile : profiles)
    if (profile.row.bit == deepest) print(profile.row);
  if (folder.empty()) return;
  rowTable(profiles).writeInto(folder, "torque_drag.csv");
  profileTable(profiles, deepest).writeInto(folder, "torque_drag_profile.csv");
  log::info("results     " + folder + ": torque_drag.csv, torque_drag_profile.csv");
}

}  // namespace tooljoint::drillstring
