// SPDX-License-Identifier: BSD-3-Clause
#include "texts/LastScreen.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unistd.h>
#include <utility>
#include <vector>

#include "cases/run/DeckCommand.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/Terminal.hpp"
#include "io/ResultsReader.hpp"
#include "io/TextFile.hpp"
#include "texts/ScreenLines.hpp"

namespace tooljoint::texts {

namespace {

using screen::brief, screen::fixed, screen::line, screen::number, screen::padded, screen::quantity;
using screen::Json;
using terminal::Colour;

/// What a run is checked for, and the bound; tools/report/checks.py has the same (tests/terminal).
struct Check {
  const char* name;
  const char* value;
  const char* scale;  ///< null: the value is a share already
  double bound;
  const char* advice;
};

constexpr const char* shorterSteps = "half of Transient/Step";

constexpr std::array checks{
    Check{"balance of torque", "/static/torque_balance_defect", "/static/torque_scale", 1e-2,
          "--set \"Path/Pre-stress=Full tangent\""},
    Check{"residual of the static state", "/static/residual", nullptr, 1e-8, nullptr},
    Check{"balance of energy", "/transient/energy_residual", nullptr, 1e-2, shorterSteps},
    Check{"step error", "/transient/step_error", nullptr, 5e-2, shorterSteps},
    Check{"share of steps that did not converge", "/transient/unconverged_steps",
          "/transient/steps", 1e-3, shorterSteps},
};

struct Worst {
  const Check* check = nullptr;
  double value = 0.0;
};

/// The check that comes closest to its bound; none of a run without any.
Worst worstCheck(const Json& summary) {
  Worst worst;
  for (const auto& check : checks) {
    auto value = number(summary, check.value);
    if (!value) continue;
    if (check.scale != nullptr) {
      const auto scale = number(summary, check.scale);
      if (!scale || *scale == 0.0) continue;
      *value /= *scale;
    }
    const double share = std::abs(*value);
    if (worst.check == nullptr || share / check.bound > worst.value / worst.check->bound)
      worst = {&check, share};
  }
  return worst;
}

/// Torque [N m] that is none in the digits that are printed.
constexpr double noTorque = 5;

/// Hook load, surface torque and the largest side force of a string at rest.
void ofString(const Json& summary, const std::string& folder) {
  // exactly none where the string has no axial dofs
  if (const auto load = number(summary, "/static/hook_load"); load && *load != 0.0)
    line("hook load", quantity(*load, "kN", 1), "at rest, without block");
  if (const auto torque = number(summary, "/static/surface_torque"))
    line("surface torque", quantity(*torque, "kN m", 2),
         std::abs(*torque) < noTorque ? "at rest" : "at rest, against the rotation");
  const auto force = number(summary, "/static/max_normal_force");
  const auto node = number(summary, "/static/max_normal_force_node");
  if (!force || !node || *node < 1.0) return;  // nothing touches
  const io::ResultsReader results(folder + "/results.h5");
  const auto depth = results.rows("/model/s", static_cast<std::size_t>(*node) - 1, 1).front();
  line("largest side force", quantity(*force, "kN", 2),
       "at a measured depth of " + quantity(depth, "m", 1));
}

void ofMotion(const Json& summary) {
  const auto mean = number(summary, "/transient/bit_speed_rpm/mean");
  const auto least = number(summary, "/transient/bit_speed_rpm/min");
  const auto most = number(summary, "/transient/bit_speed_rpm/max");
  if (mean && least && most)
    line("bit speed", fixed(*mean, 1) + " rpm",
         fixed(*least, 1) + " to " + fixed(*most, 1) + " rpm");
  bool parts = false;
  for (const auto& [name, unit] :
       {std::pair{"displacement", " m"}, {"rotation", " rad"}, {"coordinate", ""}})
    if (const auto largest = number(summary, ("/transient/max_" + std::string(name)).c_str())) {
      line(name, brief(*largest, 3) + unit, "the largest component of all nodes");
      parts = true;
    }
  if (!parts) return;
  if (const auto energy = number(summary, "/transient/energy_residual"))
    line("energy balance", brief(100.0 * *energy, 2) + " %",
         "of the energy exchanged, lost (> 0) or made (< 0)");
}

/// "807 of 972 dofs", or "972 dofs".
std::string dofs(const Json& summary) {
  const auto all = number(summary, "/model/free_dofs");
  const auto reduced = number(summary, "/reduction/reduced_dofs");
  if (!all) return "";
  return (reduced ? fixed(*reduced, 0) + " of " : "") + fixed(*all, 0) + " dofs";
}

void ofChecks(const Json& summary) {
  const auto worst = worstCheck(summary);
  if (worst.check == nullptr) return;
  const bool met = worst.value <= worst.check->bound;
  line("worst check", terminal::coloured(padded(met ? "met" : "NOT MET"),
                                         met ? Colour::Green : Colour::Red, STDOUT_FILENO) +
                          worst.check->name + " " + brief(worst.value, 2) + ", bound " +
                          brief(worst.check->bound, 6));
}

/// Steps that follow their error have no length of their own.
std::string adviceOf(const Check& check, const Json& summary) {
  if (check.advice != shorterSteps) return check.advice;
  const auto name = summary.at("/transient/integrator"_json_pointer).get<std::string>();
  for (const char* adaptive : {"adaptive", "ARKODE", "CVODE"})
    if (name.find(adaptive) != std::string::npos)
      return "a tenth of Transient/" + name + "/Tolerance";
  return check.advice;
}

/// What to try next, a command each: what mends a check that is not met, else what shows more.
std::vector<std::string> next(const Json& summary, const std::string& folder,
                              const deck::Deck& deck) {
  const auto file = inShellQuotes(deck.file()), shown = inShellQuotes(folder),
             full = inShellQuotes(folder + "_full");
  const auto worst = worstCheck(summary);
  if (worst.check != nullptr && worst.value > worst.check->bound && worst.check->advice != nullptr)
    return {"the run again with " + adviceOf(*worst.check, summary) + " (" + worst.check->name +
            ")"};
  if (!number(summary, "/transient/steps"))
    return {"tooljoint " +
            std::string(number(summary, "/static/top_torque") ? "torque-drag " : "modes ") + file +
            cases::overrideSwitches(deck)};
  const auto ratio = number(summary, "/reduction/cost_ratio");
  if (ratio && *ratio < 1.0)
    return {"tooljoint run " + file + " --output " + full + cases::fullModelSwitches(deck),
            "tooljoint compare " + shown + " " + full};
  std::vector<std::string> more;
  // the report then shows torque, drag and buckling limits as well
  if (number(summary, "/static/top_torque") &&
      !summary.at("/torque_drag/rows"_json_pointer).is_array() && deck.gives("Contact/Friction") &&
      deck.gives("Loads"))
    more.push_back("tooljoint torque-drag " + file + " --output " + shown +
                   cases::overrideSwitches(deck));
  more.push_back("tooljoint paraview " + shown);
  return more;
}

}  // namespace

void lastScreen(const std::string& folder, const deck::Deck& deck) {
  if (log::quiet() || parallel::rank() != 0) return;
  const auto summary = Json::parse(io::readText(folder + "/summary.json"));
  screen::details(summary);
  log::info("");
  if (number(summary, "/static/hook_load")) ofString(summary, folder);
  ofMotion(summary);
  ofChecks(summary);
  if (const auto factor = number(summary, "/transient/real_time_factor"))
    line("speed", brief(*factor, 3) + " x real time", dofs(summary));
  else
    line("model", dofs(summary),
         "wall time " + fixed(number(summary, "/wall_s").value_or(0.0), 2) + " s");
  if (const auto count = summary.at("warnings").size(); count > 0)
    line("warnings", terminal::coloured(std::to_string(count), Colour::Yellow, STDOUT_FILENO) +
                         ", above and in the report");
  screen::openAndNext(folder, next(summary, folder, deck));
}

}  // namespace tooljoint::texts
