// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/MapFiles.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

#include "cases/figures/Settling.hpp"
#include "common/Text.hpp"
#include "common/report/Likewise.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/Csv.hpp"
#include "io/summary/SummaryUnits.hpp"
#include "study/engine/StudyFiles.hpp"

namespace tooljoint::study {

namespace {

std::vector<std::string> cells(const MapSettings& settings, const MapPoint& point,
                               const MapRow& row, std::size_t number) {
  std::vector<std::string> out{std::to_string(number)};
  for (std::size_t a = 0; a < settings.axes.size(); ++a) {
    const auto& axis = settings.axes[a];
    const auto& text = point.plan.sweep[a].second;
    const auto place = std::find(axis.dimension.values.begin(), axis.dimension.values.end(), text) -
                       axis.dimension.values.begin();
    out.push_back(
        axis.numbers.empty() ? text : formatNumber(axis.numbers[static_cast<std::size_t>(place)]));
  }
  for (const auto& value : settings.values) {
    const auto found = row.number(value.key);
    out.push_back(found ? formatNumber(*found) : "");
  }
  out.insert(out.end(), {row.status, formatNumber(row.cpu), formatNumber(row.wall), row.reason});
  return out;
}

struct Totals {
  std::size_t done = 0, failed = 0;
  double cpu = 0.0, wall = 0.0;
};

Totals totalsOf(const std::vector<MapRow>& rows) {
  Totals sum;
  for (const auto& row : rows) {
    sum.done += row.status == "done" ? 1 : 0;
    sum.failed += row.status == "failed" ? 1 : 0;
    sum.cpu += row.cpu;
    sum.wall += row.wall;
  }
  return sum;
}

double perPoint(double sum, const Totals& totals) {
  const auto count = totals.done + totals.failed;
  return count > 0 ? sum / static_cast<double>(count) : 0.0;
}

bool hasNotSettled(const MapRow& row) {
  return row.number(cases::bitSpeedGrowthKey).value_or(0.0) >= cases::unsettledGrowth;
}

}  // namespace

MapRange rangeOf(const MapValue& value, const std::vector<MapRow>& rows) {
  MapRange range;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto number = rows[i].number(value.key);
    if (!number) continue;
    if (range.known == 0 || *number < range.least) range.least = *number, range.leastPoint = i;
    if (range.known == 0 || *number > range.largest)
      range.largest = *number, range.largestPoint = i;
    ++range.known;
    range.unsafe += value.unsafe(*number) ? 1 : 0;
  }
  return range;
}

void stageMapTable(const MapPlan& plan, const std::vector<MapRow>& rows, io::OutputFolder& folder) {
  std::vector<io::Csv::Column> columns{{"point", ""}};
  for (const auto& axis : plan.settings.axes) columns.push_back({axis.dimension.name, axis.unit});
  for (const auto& value : plan.settings.values) columns.push_back({value.name, ""});
  columns.insert(columns.end(), {{"status", ""}, {"cpu", "s"}, {"wall", "s"}, {"reason", ""}});
  io::Csv table(columns);
  for (std::size_t i = 0; i < rows.size(); ++i)
    table.row(cells(plan.settings, plan.points[i], rows[i], i + 1));
  table.stage(folder.file("map.csv"));
}

void writeMap(const MapPlan& plan, const std::vector<MapRow>& rows, io::ResultsFile& file) {
  const auto& settings = plan.settings;
  io::Shape grid;
  for (const auto& axis : settings.axes) {
    const std::string path = "/axes/" + axis.dimension.name;
    const auto count = axis.dimension.values.size();
    grid.push_back(count);
    if (axis.numbers.empty())
      file.write(path, axis.dimension.values, "Points of " + axis.dimension.parameter);
    else
      file.write(path, axis.numbers, {count}, axis.unit.empty() ? "1" : axis.unit,
                 "Points of " + axis.dimension.parameter);
  }
  for (const auto& value : settings.values) {
    std::vector<double> numbers;
    std::vector<int> known;
    for (const auto& row : rows) {
      const auto number = row.number(value.key);
      numbers.push_back(number.value_or(0.0));
      known.push_back(number ? 1 : 0);
    }
    file.write("/values/" + value.name, numbers, grid, "1", value.key + ", 0 where not known");
    file.write("/known/" + value.name, known, grid, "1", "1 where the value is known");
  }
}

void summarise(const MapPlan& plan, const std::vector<MapRow>& rows, io::Summary& summary) {
  const auto totals = totalsOf(rows);
  summary.set("map.points", static_cast<long>(rows.size()));
  summary.set("map.done", static_cast<long>(totals.done));
  summary.set("map.failed", static_cast<long>(totals.failed));
  summary.set("map.unsettled",
              static_cast<long>(std::count_if(rows.begin(), rows.end(), hasNotSettled)));
  summary.set("map.cpu_per_point_s", perPoint(totals.cpu, totals));
  summary.set("map.wall_per_point_s", perPoint(totals.wall, totals));
  for (const auto& axis : plan.settings.axes)
    summary.append("map.axes", io::SummaryRow()
                                   .set("name", axis.dimension.name)
                                   .set("parameter", axis.dimension.parameter)
                                   .set("unit", axis.unit)
                                   .set("points", static_cast<long>(axis.dimension.values.size()))
                                   .set("numeric", !axis.numbers.empty()));
  for (const auto& value : plan.settings.values) {
    const auto range = rangeOf(value, rows);
    io::SummaryRow row;
    row.set("name", value.name).set("key", value.key).set("unit", io::unitOfKey(value.key));
    row.set("known", static_cast<long>(range.known));
    row.set("unsafe", static_cast<long>(range.unsafe));
    if (value.unsafeAbove) row.set("unsafe_above", *value.unsafeAbove);
    if (value.unsafeBelow) row.set("unsafe_below", *value.unsafeBelow);
    if (range.known > 0) row.set("min", range.least).set("max", range.largest);
    summary.append("map.values", row);
  }
}

std::string describe(const MapPlan& plan, const std::vector<MapRow>& rows) {
  std::string text;
  for (const auto& value : plan.settings.values) {
    const auto range = rangeOf(value, rows);
    if (range.known == 0) {
      text += fmt::format("map         {}: no point has it\n", value.name);
      continue;
    }
    const deck::PrintedUnit unit(io::unitOfKey(value.key));
    const std::string name = unit.name().empty() ? "" : " " + unit.name();
    text += fmt::format("map         {}: {:.4g}{} ({}) to {:.4g}{} ({})", value.name,
                        unit(range.least), name, plan.points[range.leastPoint].plan.label,
                        unit(range.largest), name, plan.points[range.largestPoint].plan.label);
    if (value.unsafeAbove || value.unsafeBelow)
      text += fmt::format("; {} of {} points unsafe", range.unsafe, range.known);
    text += "\n";
  }
  const auto totals = totalsOf(rows);
  return text + fmt::format("time        {:.3g} s wall, {:.3g} s CPU per point",
                            perPoint(totals.wall, totals), perPoint(totals.cpu, totals));
}

std::vector<std::string> missingPoints(const MapPlan& plan, const std::vector<MapRow>& rows) {
  LikewiseList out;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const std::string point =
        "Point " + std::to_string(i + 1) + " (" + plan.points[i].plan.label + ") ";
    if (rows[i].status == "failed")
      out.add("failed", rows[i].reason, point + "failed: " + rows[i].reason);
    if (rows[i].status == "pending") out.add(point, "", point + "is not there.");
    if (rows[i].status != "done") continue;
    for (const auto& value : plan.settings.values)
      if (!rows[i].number(value.key))
        out.add(value.key, "", point + "has no number " + value.key + ".");
  }
  return out.told("point");
}

std::string unsettledPoints(const MapPlan& plan, const std::vector<MapRow>& rows) {
  constexpr std::size_t mostNamed = 5;
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (hasNotSettled(rows[i])) labels.push_back(plan.points[i].plan.label);
  if (labels.empty()) return "";
  const auto count = labels.size();
  if (count > mostNamed) labels.resize(mostNamed);
  return fmt::format(
      "The bit has not settled at {} of {} points ({}{}): its vibration still grows, and the maps "
      "show its beginning. A point that counts as safe there may not be. Let the motions last "
      "longer (Transient/End Time, Output/Figures/Begin), or start them with a disturbance: a ramp "
      "of the Rotary Speed.",
      count, rows.size(), join(labels, "; "), count > mostNamed ? "; ..." : "");
}

void drawMap(const std::string& folder) { drawPictures("plot_map.py", "map_", folder); }

}  // namespace tooljoint::study
