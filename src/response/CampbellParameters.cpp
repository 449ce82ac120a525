// SPDX-License-Identifier: BSD-3-Clause
#include <Teuchos_Array.hpp>
#include <fmt/format.h>

#include "cases/CaseLists.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "response/Campbell.hpp"
#include "response/SweepParameters.hpp"

namespace tooljoint::response {

deck::ListSpec campbellParameters() {
  deck::ListSpec list("Campbell",
                      "Damped modes against the rotary speed, followed by their shapes, and the "
                      "critical speeds: what `tooljoint campbell` computes.");
  list.real("Lowest Speed", "rad/s", 0.0, deck::Range::nonNegative(), "First rotary speed.")
      .real("Highest Speed", "rad/s", deck::Required{}, deck::Range::positive(),
            "Last rotary speed.")
      .integer("Points", 41, deck::Range::atLeast(2), "Speeds, evenly spaced.")
      .integer("Modes", 12, deck::Range::atLeast(1),
               "Vibrating modes followed, the lowest ones at every speed.")
      .realArray("Orders", "", std::vector<double>{1.0, 2.0, 3.0}, deck::Range::positive(),
                 "Excitation frequencies over the rotary speed: 1 unbalance, 3 a bit of three "
                 "cones, blades, lobes of a motor. Where a mode meets one there is a critical "
                 "speed.");
  declareCommon(list);
  return list;
}

CampbellSettings readCampbell(const Teuchos::ParameterList& list) {
  CampbellSettings settings;
  settings.speeds = evenly(list, "Lowest Speed", "Highest Speed");
  settings.modes = list.get<int>("Modes");
  settings.orders = list.get<Teuchos::Array<double>>("Orders").toVector();
  settings.friction = wantsFriction(list);
  settings.spotChecks = list.get<int>("Spot Checks");
  settings.axis = list.get<std::string>("Axis");
  return settings;
}

namespace {

std::string describe(const cases::Case& one) {
  const auto settings = readCampbell(one.list().sublist("Campbell"));
  std::vector<std::string> orders;
  for (const double order : settings.orders) orders.push_back(formatNumber(order) + "x");
  return std::to_string(settings.modes) + " modes at " + std::to_string(settings.speeds.size()) +
         " speeds up to " +
         fmt::format("{:.6g}", settings.speeds.back() * constants::rpmPerRadianPerSecond) +
         " rpm, crossings with " + join(orders, ", ") +
         (settings.friction ? ", with" : ", without") + " friction; " +
         (one.reduces()
              ? "reduced model, full model at " + std::to_string(settings.spotChecks) + " speeds"
              : "full model") +
         " (tooljoint campbell)";
}

const bool registered = cases::AnalysisLists::instance().add(
    {"Campbell", campbellParameters, [](const Teuchos::ParameterList& list) { readCampbell(list); },
     describe});

}  // namespace
}  // namespace tooljoint::response
