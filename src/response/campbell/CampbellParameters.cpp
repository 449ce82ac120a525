// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_Array.hpp>
#include <algorithm>
#include <fmt/format.h>

#include "cases/CaseLists.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "response/SweepParameters.hpp"
#include "response/campbell/Campbell.hpp"

namespace tooljoint::response {

deck::ListSpec campbellParameters() {
  deck::ListSpec list("Campbell",
                      "Damped modes against the rotary speed, tracked by their shapes, and the "
                      "critical speeds: what `tooljoint campbell` computes.");
  list.real("Lowest Speed", "rad/s", 0.0, deck::Range::nonNegative(), "First rotary speed.")
      .real("Highest Speed", "rad/s", deck::Required{}, deck::Range::positive(),
            "Last rotary speed.")
      .integer("Points", 41, deck::Range::atLeast(2), "Speeds, evenly spaced.")
      .integer("Modes", 12, deck::Range::atLeast(1),
               "Vibrating modes tracked at every speed: the lowest ones, or those nearest "
               "Target Frequency.")
      .real("Target Frequency", "Hz", deck::Optional{}, deck::Range::positive(),
            "The modes nearest this frequency are tracked, not the lowest ones.")
      .expert()
      .real("Lowest Frequency", "Hz", 0.0, deck::Range::nonNegative(),
            "Lower end of a window of frequencies; with Highest Frequency.")
      .real("Highest Frequency", "Hz", deck::Optional{}, deck::Range::positive(),
            "Upper end of a window: all vibrating modes in it are tracked, whatever Modes says, "
            "but those whose resonance is wider than the window.")
      .real("Shape Speed", "rad/s", deck::Optional{}, deck::Range::nonNegative(),
            "The nearest speed of the diagram has the shapes of its modes written, beside those "
            "at critical speeds. Default: the last speed.")
      .expert()
      .choice("Static State", std::string("One"), {"One", "Each Speed"},
              "State about which the equations are linearised: one state, that of the start, or "
              "the state of steady rotation at each speed, with its contacts, friction and law of "
              "the bit. The latter costs a static state, and a reduction, at every speed.")
      .realArray("Orders", "", std::vector<double>{1.0, 2.0, 3.0}, deck::Range::positive(),
                 "Excitation frequencies over the rotary speed: 1 unbalance, 3 a bit of three "
                 "cones. Where a mode meets one there is a critical speed.")
      .integer("Blades", deck::Optional{}, deck::Range::atLeast(1),
               "Blades of the bit: their passing adds an excitation of Blades times the speed of "
               "the bit.")
      .real("Motor Speed", "rad/s", 0.0, deck::Range::nonNegative(),
            "Speed of the bit over that of the string, of a mud motor between them. Adds an "
            "excitation with the speed of the bit.")
      .expert()
      .integer("Motor Lobes", deck::Optional{}, deck::Range::atLeast(1),
               "Lobes of the motor's rotor: its centre goes round Motor Lobes times in a turn of "
               "the rotor, at the same frequency whatever the rotary speed.")
      .expert();
  declareCommon(list);
  return list;
}

namespace {

/// Orders of the string, then those of bit and motor.
void readLines(const Teuchos::ParameterList& list, CampbellSettings& settings) {
  auto orders = list.get<Teuchos::Array<double>>("Orders").toVector();
  std::sort(orders.begin(), orders.end());
  auto& lines = settings.lines;
  for (const double order : orders) lines.push_back({formatNumber(order) + "x", order, 0.0});
  const double motor = list.get<double>("Motor Speed");
  if (motor > 0.0) lines.push_back({"bit", 1.0, motor});
  if (list.isParameter("Blades")) {
    const int blades = list.get<int>("Blades");
    lines.push_back({"blades", static_cast<double>(blades), blades * motor});
  }
  if (!list.isParameter("Motor Lobes")) return;
  if (!(motor > 0.0))
    throw DeckError(list.name() +
                    "/Motor Lobes has no effect without Motor Speed. Give the speed of the bit "
                    "over that of the string.");
  lines.push_back({"motor", 0.0, list.get<int>("Motor Lobes") * motor});
}

void readWindow(const Teuchos::ParameterList& list, CampbellSettings& settings) {
  const double lowest = list.get<double>("Lowest Frequency");
  const bool window = list.isParameter("Highest Frequency");
  if (list.isParameter("Shape Speed")) settings.shapeSpeed = list.get<double>("Shape Speed");
  if (list.isParameter("Target Frequency")) settings.target = list.get<double>("Target Frequency");
  if (!window && lowest > 0.0)
    throw DeckError(list.name() +
                    "/Lowest Frequency has no effect without Highest Frequency. Give both ends of "
                    "the window, or leave it out.");
  if (!window) return;
  if (settings.target)
    throw DeckError(list.name() +
                    " has both Highest Frequency and Target Frequency. Give one: a window of "
                    "frequencies, or the frequency that the modes are nearest to.");
  settings.window = {lowest, list.get<double>("Highest Frequency")};
  if (!(settings.window->width() > 0.0))
    throw DeckError(list.name() + "/Highest Frequency is " +
                    formatNumber(settings.window->highest) + " Hz, but Lowest Frequency is " +
                    formatNumber(lowest) + " Hz. Give a larger one.");
}

}  // namespace

CampbellSettings readCampbell(const Teuchos::ParameterList& list) {
  CampbellSettings settings;
  settings.speeds = evenly(list, "Lowest Speed", "Highest Speed", "rad/s");
  settings.modes = list.get<int>("Modes");
  readWindow(list, settings);
  readLines(list, settings);
  settings.friction = wantsFriction(list);
  settings.stateOfEachSpeed = list.get<std::string>("Static State") == "Each Speed";
  settings.spotChecks = list.get<int>("Spot Checks");
  settings.axis = list.get<std::string>("Axis");
  return settings;
}

namespace {

std::string modesText(const CampbellSettings& settings) {
  if (settings.window)
    return "modes from " + formatNumber(settings.window->lowest) + " to " +
           formatNumber(settings.window->highest) + " Hz";
  return std::to_string(settings.modes) + " modes" +
         (settings.target ? " nearest " + formatNumber(*settings.target) + " Hz" : "");
}

std::string describe(const cases::Case& one) {
  const auto settings = readCampbell(one.list().sublist("Campbell"));
  std::vector<std::string> lines;
  for (const auto& line : settings.lines) lines.push_back(line.name);
  return modesText(settings) + " at " + std::to_string(settings.speeds.size()) + " speeds up to " +
         fmt::format("{:.6g}", settings.speeds.back() * constants::rpmPerRadianPerSecond) +
         " rpm, crossings with " + join(lines, ", ") +
         (settings.friction ? ", with" : ", without") + " friction, about " +
         (settings.stateOfEachSpeed ? "the static state of each speed; " : "one static state; ") +
         (one.reduces()
              ? "reduced model, full model at " + std::to_string(settings.spotChecks) + " speeds"
              : "full model") +
         " (tooljoint campbell)";
}

const bool campbellParametersRegistered = cases::AnalysisLists::instance().add(
    {"Campbell", campbellParameters, [](const Teuchos::ParameterList& list) { readCampbell(list); },
     describe, "no Campbell list: give its Highest Speed (tooljoint campbell)"});

}  // namespace
}  // namespace tooljoint::response
