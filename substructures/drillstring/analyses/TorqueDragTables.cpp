// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/TorqueDragTables.hpp"

#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <limits>
#include <string>
#include <utility>

#include "io/Csv.hpp"

namespace tooljoint::drillstring {
namespace {

using Profiles = std::vector<TorqueDragProfile>;
using Settings = softstring::TorqueDragSettings;

constexpr double nothing = std::numeric_limits<double>::quiet_NaN();

/// A quantity of all rows of a table. NaN and infinity mark undefined values: a margin of an
/// unloaded string, the surface loads of a string that locks up.
struct Column {
  std::string name, unit, longName;
  std::vector<double> values;
};

bool hasStiff(const TorqueDragProfile& profile) {
  return profile.stiff.has_value() && profile.stiff->found();
}

template <class Value>
Column column(const Profiles& profiles, const std::string& name, const std::string& unit,
              const std::string& longName, const Value& value) {
  Column one{name, unit, longName, {}};
  for (const auto& profile : profiles) one.values.push_back(value(profile) + 0.0);  // no -0
  return one;
}

/// A smallest margin, and its depth if it has one.
template <class Value>
void addMargin(std::vector<Column>& columns, const Profiles& profiles, const std::string& name,
               const std::string& longName, const Value& value) {
  columns.push_back(
      column(profiles, name, "1", longName, [&](const auto& one) { return value(one).factor; }));
  columns.push_back(
      column(profiles, name + "_depth", "m", "Measured depth of it", [&](const auto& one) {
        const Margin margin = value(one);
        return std::isfinite(margin.factor) ? margin.depth : nothing;
      }));
}

std::vector<Column> softColumns(const Profiles& profiles) {
  const auto of = [&](const char* name, const char* unit, const char* longName,
                      double TorqueDragRow::*member) {
    return column(profiles, name, unit, longName,
                  [member](const TorqueDragProfile& one) { return one.row.*member; });
  };
  std::vector<Column> columns{
      of("hook_load", "N", "Effective tension at the surface and block weight",
         &TorqueDragRow::hookLoad),
      of("surface_torque", "N m", "Torque at the surface", &TorqueDragRow::surfaceTorque),
      of("twist", "rad", "Twist of the surface ahead of the bit", &TorqueDragRow::twist),
      of("stretch", "m", "Stretch by effective tension", &TorqueDragRow::stretch),
      of("neutral_depth", "m", "Measured depth above which nothing is compressed",
         &TorqueDragRow::neutralDepth),
      of("side_force", "N/m", "Largest side force per length", &TorqueDragRow::largestSideForce),
      of("side_force_depth", "m", "Measured depth of it", &TorqueDragRow::sideForceDepth),
      column(profiles, "joint_force", "N", "Largest side force of a joint of pipe",
             [](const TorqueDragProfile& one) { return one.row.joint.factor; }),
      column(profiles, "joint_force_depth", "m", "Measured depth of its middle",
             [](const TorqueDragProfile& one) { return one.row.joint.depth; })};
  addMargin(columns, profiles, "yield_margin", "Yield strength over von Mises stress, least",
            [](const TorqueDragProfile& one) { return one.row.yield; });
  addMargin(columns, profiles, "sinusoidal_margin",
            "Sinusoidal buckling load over compression, least",
            [](const TorqueDragProfile& one) { return one.row.sinusoidal; });
  addMargin(columns, profiles, "helical_margin", "Helical buckling load over compression, least",
            [](const TorqueDragProfile& one) { return one.row.helical; });
  columns.push_back(column(profiles, "lock_up_depth", "m", "Measured depth where it locks up",
                           [](const TorqueDragProfile& one) {
                             return one.row.lockUpDepth >= 0.0 ? one.row.lockUpDepth : nothing;
                           }));
  return columns;
}

/// Columns of the string with bending stiffness, if it was computed.
std::vector<Column> stiffColumns(const Profiles& profiles, const Settings& settings) {
  std::vector<Column> columns;
  const auto add = [&](const char* name, const char* unit, const char* longName,
                       const auto& value) {
    columns.push_back(column(profiles, name, unit, longName, [&](const TorqueDragProfile& one) {
      return hasStiff(one) ? value(*one.stiff) : nothing;
    }));
  };
  columns.push_back(column(profiles, "stiff_locked_up", "1",
                           "Stiff string: 1 where it locks up, else 0", [](const auto& one) {
                             return !one.stiff ? nothing : one.stiff->locksUp ? 1.0 : 0.0;
                           }));
  add("stiff_buckled", "1", "Stiff string: 1 where its state is buckled, else 0",
      [](const StiffLoads& one) { return one.buckled ? 1.0 : 0.0; });
  add("stiff_hook_load", "N", "Stiff string: effective tension at the surface and block weight",
      [&](const StiffLoads& one) { return one.hookLoad + settings.blockWeight; });
  add("stiff_surface_torque", "N m", "Stiff string: torque at the surface",
      [](const StiffLoads& one) { return one.surfaceTorque; });
  add("stiff_twist", "rad", "Stiff string: twist of the surface ahead of the bit",
      [](const StiffLoads& one) { return one.twist; });
  add("stiff_stretch", "m", "Stiff string: stretch by effective tension",
      [](const StiffLoads& one) { return one.stretch; });
  add("stiff_contact_force", "N", "Stiff string: largest contact force of a node",
      [](const StiffLoads& one) { return largestContact(one).factor; });
  add("stiff_contact_force_depth", "m", "Measured depth of it",
      [](const StiffLoads& one) { return largestContact(one).depth; });
  add("stiff_joint_force", "N", "Stiff string: largest contact force of a joint of pipe",
      [](const StiffLoads& one) { return one.joint.factor; });
  add("stiff_joint_force_depth", "m", "Measured depth of its middle",
      [](const StiffLoads& one) { return one.joint.depth; });
  const auto margin = [&](const std::string& name, const std::string& longName,
                          Margin StiffLoads::*member) {
    addMargin(columns, profiles, name, longName, [member](const TorqueDragProfile& one) {
      return hasStiff(one) ? (*one.stiff).*member : Margin{nothing, 0.0};
    });
  };
  margin("stiff_yield_margin", "Stiff string: yield strength over von Mises stress, least",
         &StiffLoads::yield);
  margin("stiff_sinusoidal_margin",
         "Stiff string: sinusoidal buckling load over compression, least", &StiffLoads::sinusoidal);
  margin("stiff_helical_margin", "Stiff string: helical buckling load over compression, least",
         &StiffLoads::helical);
  return columns;
}

std::vector<Column> allColumns(const Profiles& profiles, const Settings& settings) {
  auto columns = softColumns(profiles);
  for (auto& one : stiffColumns(profiles, settings)) columns.push_back(std::move(one));
  return columns;
}

std::string number(double value) {
  return std::isfinite(value) ? fmt::format("{:.10g}", value) : "";
}

io::Csv rowTable(const Profiles& profiles, const Settings& settings) {
  const auto columns = allColumns(profiles, settings);
  std::vector<io::Csv::Column> header{{"bit_depth", "m"}, {"operation", ""}};
  for (const auto& one : columns) header.push_back({one.name, one.unit});
  io::Csv table(header);
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    std::vector<std::string> cells{number(profiles[i].row.bit), profiles[i].row.operation};
    for (const auto& one : columns) cells.push_back(number(one.values[i]));
    table.row(cells);
  }
  return table;
}

io::Csv profileTable(const Profiles& profiles, double bit) {
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

/// One line per node; loads of an element are listed at its upper node.
io::Csv stiffProfileTable(const Profiles& profiles, double bit) {
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

bool anyStiff(const Profiles& profiles) {
  return std::any_of(profiles.begin(), profiles.end(),
                     [](const auto& profile) { return profile.stiff.has_value(); });
}

/// Vectors of equal length along the string.
void writeAlong(const std::vector<Column>& columns, const std::string& group,
                io::ResultsFile& file) {
  for (const auto& one : columns)
    file.write(group + one.name, one.values, {one.values.size()}, one.unit, one.longName);
}

void writeProfile(const TorqueDragProfile& profile, io::ResultsFile& file) {
  const auto& loads = profile.loads;
  const std::string group = "/profile/" + profile.row.operation + "/";
  writeAlong({{"depth", "m", "Measured depth, from the bit up", loads.depth},
              {"tension", "N", "Effective tension", loads.tension},
              {"torque", "N m", "Torque", loads.torque},
              {"side_force", "N/m", "Side force per length", loads.sideForce},
              {"von_mises", "Pa", "Von Mises stress", profile.vonMises},
              {"sinusoidal_limit", "N", "Sinusoidal buckling load", profile.sinusoidal},
              {"helical_limit", "N", "Helical buckling load", profile.helical}},
             group, file);
  if (!hasStiff(profile)) return;
  const StiffLoads& stiff = *profile.stiff;
  writeAlong({{"depth", "m", "Measured depth of the nodes, from the surface", stiff.depth},
              {"contact_force", "N", "Contact force of the nodes", stiff.contactForce},
              {"tension", "N", "Effective tension of the elements", stiff.tension},
              {"torque", "N m", "Torque of the elements", stiff.torque},
              {"bending_moment", "N m", "Bending moment of the elements", stiff.moment},
              {"von_mises", "Pa", "Von Mises stress of the elements", stiff.vonMises}},
             group + "stiff/", file);
}

}  // namespace

/// The largest contact force of the stiff string and its depth.
Margin largestContact(const StiffLoads& stiff) {
  const auto largest = std::max_element(stiff.contactForce.begin(), stiff.contactForce.end());
  return {*largest, stiff.depth[static_cast<std::size_t>(largest - stiff.contactForce.begin())]};
}

double deepestBit(const Profiles& profiles) {
  double deepest = 0.0;
  for (const auto& profile : profiles) deepest = std::max(deepest, profile.row.bit);
  return deepest;
}

void stageTables(const Profiles& profiles, const Settings& settings, io::OutputFolder& folder) {
  const double deepest = deepestBit(profiles);
  rowTable(profiles, settings).stage(folder.file("torque_drag.csv"));
  profileTable(profiles, deepest).stage(folder.file("torque_drag_profile.csv"));
  if (anyStiff(profiles))
    stiffProfileTable(profiles, deepest).stage(folder.file("torque_drag_stiff_profile.csv"));
}

void writeDatasets(const Profiles& profiles, const Settings& settings, io::ResultsFile& file) {
  std::vector<std::string> operations;
  std::vector<double> bits;
  for (const auto& profile : profiles) {
    operations.push_back(profile.row.operation);
    bits.push_back(profile.row.bit);
  }
  file.write("/rows/bit_depth", bits, {bits.size()}, "m", "Measured depth of the bit");
  file.write("/rows/operation", operations, "Operation");
  for (auto& one : allColumns(profiles, settings)) {
    std::vector<int> known;
    for (double& value : one.values) {
      known.push_back(std::isfinite(value) ? 1 : 0);
      if (known.back() == 0) value = 0.0;
    }
    file.write("/rows/" + one.name, one.values, {one.values.size()}, one.unit,
               one.longName + ", 0 where not known");
    file.write("/known/" + one.name, known, {known.size()}, "1",
               "1 where " + one.name + " is known");
  }
  const double deepest = deepestBit(profiles);
  for (const auto& profile : profiles)
    if (profile.row.bit == deepest) writeProfile(profile, file);
}

void summarise(const Profiles& profiles, const Settings& settings, io::Summary& summary) {
  const double deepest = deepestBit(profiles);
  const auto columns = allColumns(profiles, settings);
  long locked = 0, missing = 0;
  for (std::size_t i = 0; i < profiles.size(); ++i) {
    const auto& profile = profiles[i];
    locked += profile.row.lockUpDepth >= 0.0 ? 1 : 0;
    missing += profile.stiff && !profile.stiff->found() ? 1 : 0;
    if (profile.row.bit != deepest) continue;
    io::SummaryRow row;
    row.set("operation", profile.row.operation);
    for (const auto& one : columns)
      if (std::isfinite(one.values[i])) row.set(one.name, one.values[i]);
    summary.append("torque_drag.rows", row);
  }
  summary.set("torque_drag.bit_depth", deepest);
  summary.set("torque_drag.depths", static_cast<long>(settings.depths.size()));
  summary.set("torque_drag.locked_up", locked);
  summary.set("torque_drag.missing", missing);
}

}  // namespace tooljoint::drillstring
