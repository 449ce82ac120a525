// SPDX-License-Identifier: BSD-3-Clause
#include "texts/AnalysisScreens.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <vector>

#include "cases/run/DeckCommand.hpp"
#include "common/Constants.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Detail.hpp"
#include "common/report/Log.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/TextFile.hpp"
#include "texts/ScreenLines.hpp"

namespace tooljoint::texts {

namespace {

using screen::brief, screen::fixed, screen::line, screen::number, screen::quantity;

constexpr double frequentError = 1e-2;  ///< vibration error that studies are usually judged at

std::string text(const screen::Json& row, const char* key) {
  return row.at(key).get<std::string>();
}

std::string percent(double share) { return brief(100.0 * share, 3) + " %"; }

/// SI values, "1 to 2 kN", in the unit that they are printed in.
std::string inUnit(const std::vector<double>& values, const std::string& unit, int digits) {
  const deck::PrintedUnit printed(unit);
  std::string out;
  for (const double value : values)
    out += (out.empty() ? "" : " to ") + brief(printed(value), digits);
  return printed.name().empty() ? out : out + " " + printed.name();
}

/// A row and its number of this key; none where all are null. `better(a, b)`: a is to be shown.
struct Extreme {
  const screen::Json* row = nullptr;
  double value = 0.0;
};

Extreme extreme(const screen::Json& rows, const char* key,
                const std::function<bool(double, double)>& better) {
  Extreme found;
  for (const auto& row : rows) {
    if (!row.at(key).is_number()) continue;
    const auto value = row.at(key).get<double>();
    if (found.row == nullptr || better(value, found.value)) found = {&row, value};
  }
  return found;
}

bool larger(double a, double b) { return a > b; }
bool smaller(double a, double b) { return a < b; }
bool longer(double a, double b) { return std::abs(a) > std::abs(b); }

/// A line for the row whose number is extreme; none without any.
void extremeLine(const std::string& name, const Extreme& found, const std::string& value,
                 const std::string& remark) {
  if (found.row != nullptr) line(name, value, remark);
}

void ofTorqueDrag(const screen::Json& summary) {
  const auto& group = summary.at("torque_drag");
  const auto& rows = group.at("rows");
  const auto at = [](const Extreme& found) {
    return found.row == nullptr ? std::string() : text(*found.row, "operation");
  };
  const auto most = extreme(rows, "hook_load", larger), least = extreme(rows, "hook_load", smaller);
  extremeLine("largest hook load", most, quantity(most.value, "kN", 1), at(most));
  extremeLine("least hook load", least, quantity(least.value, "kN", 1), at(least));
  const auto torque = extreme(rows, "surface_torque", longer);
  extremeLine("surface torque", torque, quantity(torque.value, "kN m", 2), at(torque));
  for (const auto& [name, key] : {std::pair{"yield margin", "yield_margin"},
                                  {"sinusoidal margin", "sinusoidal_margin"},
                                  {"helical margin", "helical_margin"}}) {
    const auto margin = extreme(rows, key, smaller);
    extremeLine(name, margin, brief(margin.value, 3), at(margin));
  }
  if (const auto stuck = number(summary, "/torque_drag/locked_up"); stuck && *stuck > 0.0)
    line("locked up", fixed(*stuck, 0) + (*stuck == 1.0 ? " row" : " rows"),
         "the string cannot be moved so");
}

void ofBottomHole(const screen::Json& summary) {
  const auto& rows = summary.at("/bha/rows"_json_pointer);
  const auto at = [](const Extreme& found) {
    return found.row == nullptr ? std::string()
                                : text(*found.row, "mode") + " under " +
                                      quantity(found.row->at("weight_on_bit"), "kN", 1);
  };
  const auto force = extreme(rows, "side_force_high", longer);
  extremeLine("side force at the bit", force, quantity(force.value, "kN", 2),
              "to the high side, " + at(force));
  const auto tilt = extreme(rows, "tilt_high", longer);
  extremeLine("tilt of the bit", tilt, quantity(tilt.value, "deg", 3),
              "to the high side, " + at(tilt));
  const auto moment = extreme(rows, "largest_moment", longer);
  extremeLine("bending moment", moment, quantity(moment.value, "kN m", 2), at(moment));
  const auto stress = extreme(rows, "largest_von_mises", larger);
  extremeLine("von Mises stress", stress, quantity(stress.value, "MPa", 1), at(stress));
  if (const auto change = number(summary, "/bha/length_change"))
    line("length", quantity(*number(summary, "/bha/length"), "m", 1),
         "force and tilt change by " + percent(*change) + " with " +
             quantity(*number(summary, "/bha/checked_length"), "m", 1));
}

void ofBuckling(const screen::Json& summary) {
  for (const auto& [name, path, remark] :
       {std::tuple{"first buckling", "/buckling/limit", "weight on bit of the straight string"},
        {"unstable from", "/buckling/unstable_from", "weight on bit of the crooked string"},
        {"sinusoidal limit", "/buckling/theory/sinusoidal", "theory"},
        {"helical limit", "/buckling/theory/helical", "theory"},
        {"last weight on bit", "/buckling/last_weight_on_bit", "end of the path"}})
    if (const auto weight = number(summary, path)) line(name, quantity(*weight, "kN", 2), remark);
  line("jumps", std::to_string(summary.at("/buckling/jumps"_json_pointer).size()),
       "to another state");
}

void ofCampbell(const screen::Json& summary) {
  const auto& group = summary.at("campbell");
  line("speeds", fixed(*number(summary, "/campbell/points"), 0),
       fixed(*number(summary, "/campbell/modes"), 0) + " modes of " +
           fixed(*number(summary, "/campbell/dofs"), 0) + " dofs");
  if (const auto damping = number(summary, "/campbell/least_damping"))
    line("least damping ratio", percent(*damping));
  const auto& crossings = group.at("crossings");
  line("critical speeds", std::to_string(crossings.size()));
  const auto least = extreme(crossings, "damping", smaller);
  if (least.row != nullptr)
    line("least damped", fixed(least.row->at("speed_rpm"), 1) + " rpm",
         text(*least.row, "excitation") + ", " + fixed(least.row->at("hz"), 3) + " Hz, damping " +
             percent(least.value));
  const auto limit = extreme(group.at("stability_limits"), "speed_rpm", smaller);
  extremeLine("growing from", limit, fixed(limit.value, 1) + " rpm",
              "first speed at which a mode begins or ends to grow");
  if (const auto estimate = number(summary, "/campbell/largest_estimate"))
    line("estimated error", percent(*estimate), "of the reduced model");
}

void ofResponse(const screen::Json& summary) {
  std::map<std::string, screen::Json> peaks;  // metres and radians do not compare
  for (const auto& peak : summary.at("/response/peaks"_json_pointer))
    peaks.try_emplace(text(peak, "unit"), screen::Json::array()).first->second.push_back(peak);
  line("points", fixed(*number(summary, "/response/points"), 0),
       fixed(*number(summary, "/response/dofs"), 0) + " dofs");
  for (const auto& [unit, rows] : peaks)
    if (const auto peak = extreme(rows, "amplitude", larger); peak.row != nullptr)
      line("largest peak", inUnit({peak.value}, unit, 4),
           text(*peak.row, "output") + " at " + fixed(peak.row->at("speed_rpm"), 1) + " rpm, " +
               fixed(peak.row->at("hz"), 3) + " Hz");
  if (const auto moment = number(summary, "/response/bending_moment"))
    line("bending moment", quantity(*moment, "kN m", 3),
         "amplitude at a measured depth of " +
             quantity(*number(summary, "/response/bending_depth"), "m", 1));
  if (const auto speed = number(summary, "/response/contact_speed_rpm"))
    line("wall reached from", fixed(*speed, 1) + " rpm", "an open node would touch");
  if (const auto estimate = number(summary, "/response/largest_estimate"))
    line("estimated error", percent(*estimate), "of the largest amplitude");
}

void ofModes(const screen::Json& summary) {
  line("modes", fixed(*number(summary, "/modes/count"), 0));
  for (const auto& [name, path] : {std::pair{"lowest frequency", "/modes/lowest_hz"},
                                   {"highest frequency", "/modes/highest_hz"}})
    if (const auto hz = number(summary, path)) line(name, brief(*hz, 6) + " Hz");
  if (const auto error = number(summary, "/modes/largest_error"))
    line("error by reduction", percent(*error), "the largest of these frequencies");
  if (const auto estimate = number(summary, "/modes/largest_estimate"))
    line("its estimate", percent(*estimate), "without the full model");
  if (const auto growing = number(summary, "/modes/growing"))
    line("growing modes", fixed(*growing, 0), "of the damped ones");
}

void ofStudy(const screen::Json& summary) {
  int done = 0, failed = 0;
  auto methods = screen::Json::array(), full = screen::Json::array(), reduced = methods;
  for (const auto& row : summary.at("study")) {
    if (text(row, "kind") != "method") continue;
    failed += text(row, "status") == "failed" ? 1 : 0;
    if (text(row, "status") != "done") continue;
    ++done;
    methods.push_back(row);
    if (!row.at("vibration_error").is_number() ||
        row.at("vibration_error").get<double>() > frequentError)
      continue;
    (text(row, "model") == "full" ? full : reduced).push_back(row);
  }
  line("runs", std::to_string(done), std::to_string(failed) + " failed");
  if (const auto own = number(summary, "/reference/self_error/vibration_error"))
    line("reference", percent(*own), "vibration error of its own");
  const auto best = extreme(methods, "vibration_error", smaller);
  extremeLine("most accurate", best, percent(best.value),
              best.row == nullptr ? "" : text(*best.row, "label"));
  const std::string bound = "below " + percent(frequentError) + " error: ";
  for (const auto& [name, rows] :
       {std::pair{"fastest full", &full}, {"fastest reduced", &reduced}}) {
    const auto fastest = extreme(*rows, "cpu_per_simulated_s", smaller);
    if (fastest.row != nullptr)
      line(name, brief(fastest.value, 3) + " s/s", bound + text(*fastest.row, "label"));
    else
      line(name, "none", bound + "no such run");
  }
}

void ofMap(const screen::Json& summary) {
  const auto points = *number(summary, "/map/points");
  line("points", fixed(points, 0),
       fixed(*number(summary, "/map/done"), 0) + " done, " +
           fixed(*number(summary, "/map/failed"), 0) + " failed");
  constexpr std::size_t most = 4;  // values that are shown
  const auto& values = summary.at("/map/values"_json_pointer);
  for (std::size_t i = 0; i < std::min(values.size(), most); ++i) {
    const auto& value = values[i];
    if (!value.at("min").is_number()) continue;
    const bool judged =
        value.at("unsafe_above").is_number() || value.at("unsafe_below").is_number();
    line(text(value, "name"),
         inUnit({value.at("min").get<double>(), value.at("max").get<double>()}, text(value, "unit"),
                3),
         judged ? std::to_string(value.at("unsafe").get<long>()) + " of " +
                      std::to_string(value.at("known").get<long>()) + " points unsafe"
                : "");
  }
}

struct Screen {
  void (*numbers)(const screen::Json&);
  const char* next;  ///< command that takes the same deck
  const char* switches;
  const char* list;  ///< of the deck, which the next command does not read
};

/// What an analysis shows, and what to try next.
const std::map<std::string, Screen>& screens() {
  static const std::map<std::string, Screen> known{
      {"torque_drag", {ofTorqueDrag, "bha", "", "Torque and Drag"}},
      {"bha", {ofBottomHole, "torque-drag", "", "Bottom-Hole Assembly"}},
      {"buckling", {ofBuckling, "torque-drag", "", "Buckling"}},
      {"campbell", {ofCampbell, "run", "", "Campbell"}},
      {"response", {ofResponse, "run", "", "Response"}},
      {"modes", {ofModes, "run", "", ""}},
      {"study", {ofStudy, "check", " --cost", ""}},
      {"map", {ofMap, "run", "", "Map"}}};
  return known;
}

}  // namespace

void analysisScreen(const std::string& analysis, const std::string& folder,
                    const deck::Deck& deck) {
  if (log::quiet() || parallel::rank() != 0) return;
  const auto summary = screen::Json::parse(io::readText(folder + "/summary.json"));
  screen::details(summary);
  if (const auto wall = number(summary, "/wall_s"))
    log::detail("wall time   " + fixed(*wall, 2) + " s");
  log::info("");
  const auto& shown = screens().at(analysis);
  shown.numbers(summary);
  if (const auto count = summary.at("warnings").size(); count > 0)
    line("warnings", std::to_string(count), "above and in the report");
  screen::openAndNext(folder,
                      {std::string("tooljoint ") + shown.next + " " + inShellQuotes(deck.file()) +
                       cases::overrideSwitches(deck, shown.list) + shown.switches});
}

}  // namespace tooljoint::texts
