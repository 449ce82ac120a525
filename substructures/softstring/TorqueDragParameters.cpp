// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/TorqueDragParameters.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <array>

namespace tooljoint::softstring {
namespace {

/// Definition of an operation: the axial speed, down positive, is `direction` times one of the
/// settings. (Without rotation any speed gives the same loads.)
struct Kind {
  const char* name;
  double TorqueDragSettings::*speed;
  double direction;
  bool turns;
  bool onBottom;
};
constexpr std::array kinds{
    Kind{"Trip out", &TorqueDragSettings::reamingSpeed, -1.0, false, false},
    Kind{"Trip in", &TorqueDragSettings::reamingSpeed, 1.0, false, false},
    Kind{"Rotate off bottom", &TorqueDragSettings::reamingSpeed, 0.0, true, false},
    Kind{"Drill rotating", &TorqueDragSettings::penetrationRate, 1.0, true, true},
    Kind{"Drill sliding", &TorqueDragSettings::penetrationRate, 1.0, false, true},
    Kind{"Back-ream", &TorqueDragSettings::reamingSpeed, -1.0, true, false},
    Kind{"Ream", &TorqueDragSettings::reamingSpeed, 1.0, true, false},
};

/// Largest number of bit depths of one analysis: the profiles of six operations take about 240 kB
/// per depth.
constexpr int mostDepths = 2000;

}  // namespace

std::vector<std::string> operationNames() {
  std::vector<std::string> names;
  for (const Kind& kind : kinds) names.emplace_back(kind.name);
  return names;
}

deck::ListSpec torqueDragParameters() {
  deck::ListSpec list(
      "Torque and Drag",
      "Hook load and surface torque against the depth of the bit by the soft-string "
      "model: what `tooljoint torque-drag` computes. Weight and torque on bit come "
      "from Loads, friction (Dynamic) from Contact, buoyancy from Mud.");
  list.integer("Count", 20, deck::Range::between(1, mostDepths),
               "Number of bit depths, evenly spaced from the surface to the bit of the deck.");
  list.realArray("Depths", "m", deck::Optional{}, deck::Range::positive(),
                 "Bit depths, in place of Count.");
  list.textArray("Operations", operationNames(), operationNames(),
                 "The operation: what is done with the string.");
  list.real("Block Weight", "N", 0.0, deck::Range::nonNegative(),
            "Weight of block, hook and top drive, which the hook load includes.");
  list.real("Rotary Speed", "rad/s", deck::Optional{}, deck::Range::positive(),
            "Speed of the operations that turn; without it that of the list Rotary Speed after its "
            "start, else, or where that is 0, 120 rpm.");
  list.real("Reaming Speed", "m/s", 0.05, deck::Range::positive(),
            "Axial speed of Ream and Back-ream, which turn at the same time.")
      .expert();
  list.real("Rate Of Penetration", "m/s", 0.005, deck::Range::positive(),
            "Axial speed of drilling.");
  list.real("Yield Strength", "Pa", deck::Optional{}, deck::Range::positive(),
            "Yield strength of components whose material gives none, e.g. 931 MPa for S-135; "
            "without any no margin to yield.");
  list.real("Pump Pressure", "Pa", deck::Optional{}, deck::Range::nonNegative(),
            "Pressure of the mud inside the string over that in the annulus, at the surface: part "
            "of the margin to yield. Without it what the friction of Mud/Flow Rate takes down the "
            "string and up the annulus, so that no pressure is left at the bit.")
      .expert();
  list.real("Joint Length", "m", 9.45, deck::Range::positive(),
            "Length of a joint of pipe: side forces are summed over it, since its tool joint bears "
            "them.")
      .expert();
  list.boolean("After Run", false,
               "Computes this at the end of `tooljoint run`, too: its report shows torque, drag "
               "and buckling limits with the motion.")
      .expert();
  list.choice("Stiff String", std::string("Deepest Bit"), {"None", "Deepest Bit", "All Depths"},
              "Depths at which the string with bending stiffness, clearance and contact (Static) "
              "is computed in addition to the soft string.");
  list.text(
          "Measured", deck::Optional{},
          "CSV file of measured hook loads and surface torques (columns bit depth, operation, hook "
          "load, surface torque, units in the header), to which friction coefficients and block "
          "weight are fitted. Relative to the folder of the deck.")
      .expert();
  list.real("Hook Load Uncertainty", "N", 1e4, deck::Range::positive(),
            "Weight of the error of a measured hook load in the fit.")
      .expert();
  list.real("Torque Uncertainty", "N m", 1e3, deck::Range::positive(),
            "Weight of the error of a measured surface torque in the fit.")
      .expert();
  list.realArray(
      "Broomstick", "", deck::Optional{}, deck::Range::nonNegative(),
      "Friction coefficients, each of which gives curves of hook load and torque with it "
      "in the whole hole.");
  list.boolean("Helical Contact", true,
               "Adds the side force of a string buckled into a helix, which leads to lock-up.")
      .expert();
  return list;
}

TorqueDragSettings readTorqueDrag(const Teuchos::ParameterList& list) {
  TorqueDragSettings settings;
  settings.count = list.get<int>("Count");
  if (list.isParameter("Depths"))
    settings.depths = list.get<Teuchos::Array<double>>("Depths").toVector();
  settings.operations = list.get<Teuchos::Array<std::string>>("Operations").toVector();
  settings.blockWeight = list.get<double>("Block Weight");
  settings.jointLength = list.get<double>("Joint Length");
  settings.reamingSpeed = list.get<double>("Reaming Speed");
  settings.penetrationRate = list.get<double>("Rate Of Penetration");
  if (list.isParameter("Rotary Speed")) settings.rotarySpeed = list.get<double>("Rotary Speed");
  if (list.isParameter("Yield Strength"))
    settings.yieldStrength = list.get<double>("Yield Strength");
  if (list.isParameter("Pump Pressure")) settings.pumpPressure = list.get<double>("Pump Pressure");
  const auto& stiff = list.get<std::string>("Stiff String");
  settings.stiff = stiff == "None"          ? StiffDepths::None
                   : stiff == "Deepest Bit" ? StiffDepths::Deepest
                                            : StiffDepths::All;
  if (list.isParameter("Measured")) settings.measured = list.get<std::string>("Measured");
  settings.hookLoadUncertainty = list.get<double>("Hook Load Uncertainty");
  settings.torqueUncertainty = list.get<double>("Torque Uncertainty");
  if (list.isParameter("Broomstick"))
    settings.broomstick = list.get<Teuchos::Array<double>>("Broomstick").toVector();
  settings.afterRun = list.get<bool>("After Run");
  settings.helix = list.get<bool>("Helical Contact");
  return settings;
}

std::vector<Operation> operations(const TorqueDragSettings& settings, double rotarySpeed,
                                  double weightOnBit, double torqueOnBit) {
  std::vector<Operation> found;
  for (const std::string& name : settings.operations) {
    const Kind& kind = *std::find_if(kinds.begin(), kinds.end(),
                                     [&](const Kind& one) { return one.name == name; });
    found.push_back({name, kind.direction * settings.*kind.speed, kind.turns ? rotarySpeed : 0.0,
                     kind.onBottom ? weightOnBit : 0.0, kind.onBottom ? torqueOnBit : 0.0});
  }
  return found;
}

}  // namespace tooljoint::softstring
