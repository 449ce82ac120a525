// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/MapParameters.hpp"

#include <Teuchos_Array.hpp>
#include <cmath>
#include <cstdlib>
#include <set>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "io/summary/Summary.hpp"
#include "io/summary/SummaryKeys.hpp"

namespace tooljoint::study {
namespace {

using deck::ListSpec;
using deck::Range;
using Texts = std::vector<std::string>;

/// Largest number of points of one map.
constexpr double mostPoints = 1e4;
/// Lists that apply to the whole map, and lists of other commands.
const std::set<std::string> wholeMap{"Map", "Study", "Output"};
/// Parts of summary.json that a run writes.
constexpr const char* filledByRuns[] = {"model.", "path.", "static.", "reduction.", "transient."};

struct Quantity {
  double number = 0.0;
  std::string unit;
};

/// "60 rpm" as number and unit; null for a text that does not begin with a number.
std::optional<Quantity> quantity(const std::string& text) {
  char* end = nullptr;
  const double number = std::strtod(text.c_str(), &end);
  if (end == text.c_str() || !std::isfinite(number)) return std::nullopt;
  return Quantity{number, trim(end)};
}

std::string write(double number, const std::string& unit) {
  return formatNumber(number) + (unit.empty() ? "" : " " + unit);
}

class MapReader {
 public:
  MapSettings read(const Teuchos::ParameterList& list) {
    MapSettings s;
    if (list.isParameter("Time Limit")) s.timeLimit = list.get<double>("Time Limit");
    s.pictures = list.get<bool>("Pictures");
    forEach(list, "Grid", [&](const std::string& name, const auto& one) {
      s.axes.push_back(readAxis(name, one));
    });
    forEach(list, "Values", [&](const std::string& name, const auto& one) {
      s.values.push_back(readValue(name, one));
    });
    checkWhole(s);
    if (!faults_.empty()) throw DeckError(join(faults_, "\n"));
    return s;
  }

 private:
  template <class Take>
  static void forEach(const Teuchos::ParameterList& list, const char* kind, const Take& take) {
    const auto& all = list.sublist(kind);
    for (auto it = all.begin(); it != all.end(); ++it)
      if (all.isSublist(all.name(it))) take(all.name(it), all.sublist(all.name(it)));
  }

  void fault(const std::string& path, const std::string& sentence) {
    faults_.push_back(path + " " + sentence);
  }

  MapAxis readAxis(const std::string& name, const Teuchos::ParameterList& list) {
    const std::string path = "Map/Grid/" + name;
    MapAxis axis;
    axis.dimension = {name, trim(list.get<std::string>("Parameter")), {}};
    auto& target = axis.dimension.parameter;
    if (!target.empty() && target[0] == '/') target = target.substr(1);
    if (const auto first = split(target, '/')[0]; wholeMap.count(first) > 0)
      fault(path + "/Parameter", "is " + target +
                                     ", which belongs to the whole map. Change it in the deck "
                                     "itself.");
    readPoints(list, path, axis.dimension.values);
    readNumbers(path, axis);
    return axis;
  }

  /// Values, or From, To and Count.
  void readPoints(const Teuchos::ParameterList& list, const std::string& path, Texts& values) {
    const bool listed = list.isParameter("Values");
    int ends = 0;
    for (const char* name : {"From", "To", "Count"}) ends += list.isParameter(name) ? 1 : 0;
    if (listed ? ends > 0 : ends < 3)
      return fault(path, std::string("needs its points once: Values, or From, To and Count; it "
                                     "has ") +
                             (listed      ? "both."
                              : ends == 0 ? "neither."
                                          : "a part of the latter."));
    if (listed) {
      values = list.get<Teuchos::Array<std::string>>("Values").toVector();
      if (values.size() < 2)
        fault(path + "/Values", "has " + std::to_string(values.size()) +
                                    (values.size() == 1 ? " point" : " points") +
                                    "; an axis of a map has two or more.");
      return;
    }
    const auto from = quantity(list.get<std::string>("From")),
               to = quantity(list.get<std::string>("To"));
    const int count = list.get<int>("Count");
    if (!from || !to)
      return fault(path + (from ? "/To" : "/From"),
                   "is " + inQuotes(list.get<std::string>(from ? "To" : "From")) +
                       ", which does not begin with a number. Write \"60 rpm\", or give Values.");
    if (from->unit != to->unit)
      return fault(path + "/To", "has the unit " + inQuotes(to->unit) + ", From has " +
                                     inQuotes(from->unit) + ". Use one unit.");
    for (int i = 0; i < count; ++i)
      values.push_back(
          write(from->number + (to->number - from->number) * i / (count - 1), from->unit));
  }

  void readNumbers(const std::string& path, MapAxis& axis) {
    std::set<std::string> units;
    std::set<std::string> seen;
    for (const auto& text : axis.dimension.values) {
      if (!seen.insert(text).second)
        fault(path, "has the point " + inQuotes(text) + " twice. Leave one out.");
      const auto value = quantity(text);
      if (!value) continue;
      axis.numbers.push_back(value->number);
      units.insert(value->unit);
    }
    if (axis.numbers.size() < axis.dimension.values.size()) return axis.numbers.clear();
    if (units.size() > 1)
      fault(path, "mixes the units " + quotedList({units.begin(), units.end()}) +
                      ". Use one unit for all points of an axis.");
    else if (!units.empty())
      axis.unit = *units.begin();
  }

  MapValue readValue(const std::string& name, const Teuchos::ParameterList& list) {
    MapValue value{name, trim(list.get<std::string>("Key")), std::nullopt, std::nullopt};
    if (list.isParameter("Unsafe Above")) value.unsafeAbove = list.get<double>("Unsafe Above");
    if (list.isParameter("Unsafe Below")) value.unsafeBelow = list.get<double>("Unsafe Below");
    if (value.unsafeAbove && value.unsafeBelow && *value.unsafeBelow > *value.unsafeAbove)
      fault("Map/Values/" + name, "has Unsafe Below above Unsafe Above: no value would be safe.");
    Texts known;
    for (const auto& key : io::Summary::keys())
      for (const char* part : filledByRuns)
        if (key.rfind(part, 0) == 0 && key.find("[]") == std::string::npos) known.push_back(key);
    for (const auto& key : known)
      if (key == value.key) return value;
    if (const auto now = io::renamedKey(value.key); !now.empty()) {
      fault("Map/Values/" + name + "/Key",
            "is " + inQuotes(value.key) + ", which is now called " + inQuotes(now) + ".");
      return value;
    }
    const auto near = closest(value.key, known);
    fault("Map/Values/" + name + "/Key",
          "is " + inQuotes(value.key) + ", which a run does not leave in summary.json." +
              (near.empty() ? " docs/file-formats.md lists its keys."
                            : " Did you mean " + inQuotes(near) + "?"));
    return value;
  }

  void checkWhole(const MapSettings& s) {
    if (s.axes.size() < 2)
      fault("Map/Grid", "has " + std::to_string(s.axes.size()) +
                            (s.axes.size() == 1 ? " axis" : " axes") +
                            "; a map has two or more. Add a list with Parameter and Values.");
    if (s.values.empty())
      fault("Map/Values", "is empty: there is nothing to map. Add a list with a Key.");
    std::set<std::string> parameters, names;
    double points = 1.0;
    for (const auto& axis : s.axes) {
      points *= static_cast<double>(axis.dimension.values.size());
      names.insert(axis.dimension.name);
      if (!parameters.insert(axis.dimension.parameter).second)
        fault("Map/Grid/" + axis.dimension.name + "/Parameter",
              "is " + axis.dimension.parameter + ", which is on another axis already.");
    }
    for (const auto& value : s.values)
      if (names.count(value.name) > 0)
        fault("Map/Values/" + value.name, "has the name of an axis. Name it otherwise.");
    if (points > mostPoints)
      fault("Map/Grid", "makes " + countText(points) + " points; a map has at most " +
                            countText(mostPoints) + ". Take fewer points on an axis.");
  }

  Texts faults_;
};

ListSpec axisParameters() {
  return ListSpec("Axis", "An axis of the grid, named as you like: the name of its column.")
      .text("Parameter", deck::Required{},
            "Path of a parameter of the deck: Loads/Weight On Bit, Rotary Speed/Exponential/Final "
            "Speed ...")
      .textArray("Values", deck::Optional{}, {},
                 "Its points, each written as behind --set PATH=; or From, To and Count.")
      .text("From", deck::Optional{}, "First point, with its unit: \"60 rpm\".")
      .text("To", deck::Optional{}, "Last point, in the same unit.")
      .integer("Count", deck::Optional{}, Range::atLeast(2), "Number of points, evenly spaced.");
}

ListSpec valueParameters() {
  return ListSpec("Value",
                  "The mapped quantity; the name is free and names its column and picture.")
      .text("Key", deck::Required{},
            "A number of summary.json: transient.figures.stick_slip_index, static.top_torque ...")
      .real("Unsafe Above", "", deck::Optional{}, Range::any(),
            "Larger values are marked as unsafe; in the unit of the key.")
      .real("Unsafe Below", "", deck::Optional{}, Range::any(),
            "Smaller values are marked as unsafe.")
      .expert();
}

}  // namespace

std::size_t MapSettings::points() const {
  std::size_t count = 1;
  for (const auto& axis : axes) count *= axis.dimension.values.size();
  return count;
}

ListSpec mapParameters() {
  ListSpec spec("Map",
                "Numbers of summary.json over a grid of parameters of the deck (tooljoint map; "
                "other commands leave it aside).");
  spec.real("Time Limit", "s", deck::Optional{}, Range::positive(),
            "CPU time after which a point is given up and counts as failed.")
      .expert()
      .boolean("Pictures", true, "Draw the maps when all points are done.")
      .expert();
  ListSpec grid("Grid",
                "The axes, one list for each; the first two span the pictures, each point of the "
                "others has one of its own.");
  grid.namedLists(axisParameters());
  ListSpec values("Values", "Mapped quantities, one list for each.");
  values.namedLists(valueParameters());
  return spec.requiredList(grid).requiredList(values);
}

MapSettings readMap(const Teuchos::ParameterList& list) { return MapReader().read(list); }

}  // namespace tooljoint::study
