// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Torque and Drag`: bit depths and operations of the analysis.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "substructures/softstring/SoftString.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::softstring {

/// Bit depths at which the stiff string is computed in addition to the soft one.
enum class StiffDepths { None, Deepest, All };

struct TorqueDragSettings {
  std::vector<double> depths;           ///< of the bit [m]; empty: `count` of them, evenly spaced
  int count = 0;                        ///< from total depth / count to total depth
  std::vector<std::string> operations;  ///< names, from the list of the description
  double blockWeight = 0.0;             ///< [N]
  double jointLength = 0.0;             ///< length over which a side force is summed [m]
  double reamingSpeed = 0.0;            ///< [m/s]
  double penetrationRate = 0.0;         ///< of drilling [m/s]
  std::optional<double> rotarySpeed;    ///< [rad/s]; none: the speed of the deck
  std::optional<double> yieldStrength;  ///< [Pa] of materials that give none
  std::optional<double> pumpPressure;   ///< [Pa]; none: the pressure that the flow needs
  StiffDepths stiff = StiffDepths::Deepest;
  std::optional<std::string> measured;  ///< table of measurements to fit friction to
  double hookLoadUncertainty = 0.0, torqueUncertainty = 0.0;  ///< of a measured value [N], [N m]
  std::vector<double> broomstick;  ///< friction coefficients of whole-hole curves
  bool afterRun = false;           ///< also computed at the end of a run
  bool helix = true;               ///< side force of a string buckled into a helix
};

/// Names of all available operations.
std::vector<std::string> operationNames();

/// Description of the list `Torque and Drag`.
deck::ListSpec torqueDragParameters();

/// From the validated list.
TorqueDragSettings readTorqueDrag(const Teuchos::ParameterList& list);

/// The operations named in the settings.
/// \param rotarySpeed  of operations with rotation [rad/s]
/// \param weightOnBit  of operations on bottom [N]; likewise the torque [N m]
std::vector<Operation> operations(const TorqueDragSettings& settings, double rotarySpeed,
                                  double weightOnBit, double torqueOnBit);

}  // namespace tooljoint::softstring
