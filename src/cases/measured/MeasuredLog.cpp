// SPDX-License-Identifier: BSD-3-Clause
#include "cases/measured/MeasuredLog.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <utility>

#include "cases/CaseLists.hpp"
#include "cases/imported/ImportedRecord.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/reading/FileName.hpp"
#include "deck/tables/LogTable.hpp"

namespace tooljoint::cases {

namespace {

using deck::Range;
using Teuchos::ParameterList;

constexpr const char* hookLoad = "Hook load";

std::vector<std::string> quantityNames() {
  std::vector<std::string> names;
  for (const auto& quantity : measuredQuantities()) names.push_back(quantity.name);
  return names;
}

deck::ListSpec columnParameters() {
  deck::ListSpec list("column",
                      "A column of the log and what it is compared with; the name is that "
                      "of the results.");
  list.text("Column", deck::Required{}, "Name of the column in the header, or of the curve.")
      .choice(
          "Quantity", deck::Required{}, quantityNames(),
          "Computed quantity. Hook load and Surface torque are those of the uppermost element "
          "(tension positive; torque positive against the rotation), Surface speed that of the "
          "first node; Weight on bit and Torque on bit are there with a list Bit. Displacement, "
          "Velocity and Acceleration are of a Component of a Node.")
      .text("Unit", deck::Optional{}, "Unit of the column where the file gives none.")
      .expert()
      .text("Part", deck::Optional{},
            "Name of the part; needed where parts number their nodes on their own.")
      .integer("Node", deck::Optional{}, Range::atLeast(1),
               "Node of a displacement, velocity or acceleration: of a string counted from the "
               "surface, of a part as its file numbers it.")
      .text("Component", deck::Optional{},
            "Component of that node; of a string u, v, w (along the string), theta_x, theta_y, "
            "theta_z in the frame of the hole.");
  return list;
}

/// Unit of a component of a node: displacement, velocity or acceleration.
std::string unitOfNode(const MeasuredColumn& column) {
  static const char* const rates[] = {"", "/s", "/s2"};
  return unitOf(column.dof.component) + rates[column.quantity.rates];
}

MeasuredColumn readColumn(const ParameterList& list, const std::string& name) {
  MeasuredColumn column;
  column.name = name;
  column.column = list.get<std::string>("Column");
  column.dof.where = list.name();
  if (list.isParameter("Unit")) column.unit = list.get<std::string>("Unit");
  const auto wanted = list.get<std::string>("Quantity");
  for (const auto& quantity : measuredQuantities())
    if (quantity.name == wanted) column.quantity = quantity;
  const bool ofNode = column.quantity.ofNode();
  for (const char* needed : {"Node", "Component"})
    if (ofNode != list.isParameter(needed))
      throw DeckError(list.name() + "/Quantity is " + inQuotes(wanted) + ", which " +
                      (ofNode ? std::string("needs the ") + needed + " of the measurement. Give it."
                              : std::string("has no ") + needed + ". Leave it out."));
  if (!ofNode) return column;
  column.dof = readNode(list);
  column.quantity.si = unitOfNode(column);
  column.quantity.usual = column.quantity.si == "m" ? "mm" : column.quantity.si;
  if (column.quantity.si.empty() || column.quantity.si[0] == '/')
    throw DeckError(list.name() + "/Component is " + inQuotes(column.dof.component) +
                    ", which is neither a translation nor a rotation and cannot be compared with a "
                    "measurement.");
  return column;
}

/// Rejects quantities of a string in other scenes, and of a bit in scenes without a bit law.
void requireComputed(const Case& one, const MeasuredColumn& column) {
  const auto path = std::string(measuredLogName) + "/Columns/" + column.name + "/Quantity";
  if (column.quantity.ofNode()) return;
  const auto refuse = [&](const std::string& why) {
    throw DeckError(one.deck().error(path, "is " + inQuotes(column.quantity.name) + ", " + why));
  };
  if (one.list().isSublist("Parts"))
    refuse(
        "which a scene of parts does not compute. Use Displacement, Velocity or Acceleration of a "
        "node.");
  if ((column.quantity.source == "weight_on_bit" || column.quantity.source == "torque_on_bit") &&
      !one.list().isSublist("Bit"))
    refuse("which is constant without a law of the bit. Add the list Bit.");
}

std::string columnList(const MeasuredLogSettings& settings) {
  std::vector<std::string> texts;
  for (const auto& column : settings.columns)
    texts.push_back(column.column + " with " + lower(column.quantity.name) +
                    (column.quantity.ofNode() ? " " + column.dof.component + " of node " +
                                                    std::to_string(column.dof.node)
                                              : ""));
  return join(texts, ", ");
}

const bool measuredLogRegistered = AnalysisLists::instance().add(
    {measuredLogName, measuredLogParameters,
     [](const ParameterList& list) { readMeasuredLog(list); },
     [](const Case& one) { return describe(loadMeasuredLog(one)) + " (tooljoint run)"; }});

}  // namespace

const std::vector<MeasuredQuantity>& measuredQuantities() {
  static const std::vector<MeasuredQuantity> quantities{
      {"Bit speed", "rad/s", "rpm", "bit_speed"},
      {"Surface speed", "rad/s", "rpm", "surface_speed"},
      {"Surface torque", "N m", "kN m", "surface_torque"},
      {hookLoad, "N", "kN", "hook_load"},
      {"Weight on bit", "N", "kN", "weight_on_bit"},
      {"Torque on bit", "N m", "kN m", "torque_on_bit"},
      {"Displacement", "", "", "", 0},
      {"Velocity", "", "", "", 1},
      {"Acceleration", "", "", "", 2},
  };
  return quantities;
}

deck::ListSpec measuredLogParameters() {
  deck::ListSpec list(measuredLogName,
                      "A measured log beside the motion: differences, stick-slip index and spectra "
                      "of measured and computed signals.");
  list.text("File", deck::Required{},
            "CSV file with units in its header, or LAS file (version 2.0); relative to the folder "
            "of the deck.")
      .text(
          "Time Column", deck::Optional{},
          "Name of the column of the time; by default Time, of a LAS file the index. Times of day "
          "(hh:mm:ss, also behind a date YYYY-MM-DD) count from the first row.")
      .text("Time Unit", deck::Optional{}, "Unit of the time where the file gives none.")
      .expert()
      .real("Time Offset", "s", 0.0, Range::any(), "Time of the motion at time 0 of the log.")
      .real("Begin", "s", deck::Optional{}, Range::any(),
            "Begin of the comparison, time of the motion; by default where both have begun.")
      .real("End", "s", deck::Optional{}, Range::any(),
            "End of the comparison; by default where the first of both ends.")
      .real("Block Weight", "N", 0.0, Range::nonNegative(),
            "Weight of block and top drive, taken off measured hook loads.")
      .integer("Segments", 3, Range::atLeast(1),
               "Segments of the spectra (Welch), overlapping by their halves: more of them are "
               "smoother and resolve less.")
      .expert()
      .integer("Peaks", 3, Range::atLeast(1), "Largest peaks of a spectrum that are listed.")
      .expert();
  deck::ListSpec columns("Columns", "Columns that are compared.");
  columns.namedLists(columnParameters());
  return list.list(columns);
}

MeasuredLogSettings readMeasuredLog(const ParameterList& list) {
  MeasuredLogSettings settings;
  settings.file = deck::fileName(list, "File");
  if (list.isParameter("Time Column")) settings.timeColumn = list.get<std::string>("Time Column");
  if (list.isParameter("Time Unit")) settings.timeUnit = list.get<std::string>("Time Unit");
  settings.offset = list.get<double>("Time Offset");
  if (list.isParameter("Begin")) settings.begin = list.get<double>("Begin");
  if (list.isParameter("End")) settings.end = list.get<double>("End");
  if (settings.begin && settings.end && !(*settings.begin < *settings.end))
    throw DeckError(list.name() + "/End is " + formatNumber(*settings.end) +
                    " s, not after Begin (" + formatNumber(*settings.begin) + " s). Raise it.");
  settings.blockWeight = list.get<double>("Block Weight");
  settings.spectra = {list.get<int>("Segments"), static_cast<std::size_t>(list.get<int>("Peaks"))};
  if (list.isSublist("Columns")) {
    const auto& columns = list.sublist("Columns");
    for (auto it = columns.begin(); it != columns.end(); ++it)
      if (it->second.isList())
        settings.columns.push_back(readColumn(columns.sublist(it->first), it->first));
  }
  if (settings.columns.empty())
    throw DeckError(list.name() +
                    "/Columns names no column. Add a list with Column and Quantity for each.");
  return settings;
}

MeasuredLog loadMeasuredLog(const Case& one) {
  MeasuredLog log;
  if (!one.list().isSublist(measuredLogName)) return log;
  if (!one.moves())
    throw DeckError(
        one.deck().error(measuredLogName,
                         "needs a motion to compare with, but the deck has no Transient list. Add "
                         "one, or leave this list out (--without \"Measured Log\")."));
  log.settings = readMeasuredLog(one.list().sublist(measuredLogName));
  const auto& settings = log.settings;
  const auto& transient = one.transient();
  const double start = transient.get<double>("Start Time");
  const double interval = transient.get<double>("Sampling Interval");
  const double last =
      start + interval * std::floor((transient.get<double>("End Time") - start) / interval + 1e-9);
  log.begin = std::max(start, settings.begin.value_or(start));
  log.end = std::min(last, settings.end.value_or(last));
  std::vector<deck::WantedColumn> wanted;
  for (const auto& column : settings.columns) {
    requireComputed(one, column);
    wanted.push_back({column.column, column.quantity.si, column.unit});
  }
  const auto found =
      deck::readLog(settings.file, {settings.timeColumn, "s", settings.timeUnit}, wanted);
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto& column = settings.columns[i];
    const double less = column.quantity.name == hookLoad ? settings.blockWeight : 0.0;
    SampledSignal signal;
    std::vector<double> inside;
    for (std::size_t k = 0; k < found[i].time.size(); ++k) {
      signal.time.push_back(found[i].time[k] + settings.offset);
      signal.value.push_back(found[i].value[k] - less);
      if (signal.time[k] >= log.begin && signal.time[k] <= log.end)
        inside.push_back(signal.time[k]);
    }
    if (inside.size() < 2 || inside.back() - inside.front() < 2.0 * interval)
      throw DeckError(one.deck().error(
          measuredLogName,
          fmt::format(
              "has {} samples of the column {} from {} to {} s, the window of the comparison. With "
              "the Time Offset the column lasts from {} to {} s. The comparison needs two samples "
              "at least two Sampling Intervals apart. Change Time Offset, Begin or End.",
              inside.size(), inQuotes(column.column), formatNumber(log.begin),
              formatNumber(log.end), formatNumber(signal.time.front()),
              formatNumber(signal.time.back()))));
    log.signals.push_back(std::move(signal));
  }
  return log;
}

std::string describe(const MeasuredLog& log) {
  return fmt::format("{}, {:.6g} to {:.6g} s: {}",
                     std::filesystem::path(log.settings.file).filename().string(), log.begin,
                     log.end, columnList(log.settings));
}

}  // namespace tooljoint::cases
