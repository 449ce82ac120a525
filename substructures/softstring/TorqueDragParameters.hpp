// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Torque and Drag`: at which depths of the bit, and for which operations.
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

/// Where the string with bending stiffness is computed beside the soft one.
enum class StiffDepths { None, Deepest, All };

struct TorqueDragSettings {
  std::vector<double> depths;           ///< of the bit [m]; empty: `count` of them, evenly spaced
  int count = 0;                        ///< from total depth / count to total depth
  std::vector<std::string> operations;  ///< names, from the list of the description
  double blockWeight = 0.0;             ///< [N]
  double jointLength = 0.0;             ///< over which a side force is summed [m]
  double reamingSpeed = 0.0;            ///< [m/s]
  double penetrationRate = 0.0;         ///< of drilling [m/s]
  std::optional<double> rotarySpeed;    ///< [rad/s]; none: that of the deck
  std::optional<double> yieldStrength;  ///< [Pa] of materials that give none
  std::optional<double> pumpPressure;   ///< [Pa]; none: what the flow needs
  StiffDepths stiff = StiffDepths::Deepest;
  std::optional<std::string> measured;  ///< table of measurements to fit friction to
  double hookLoadUncertainty = 0.0, torqueUncertainty = 0.0;  ///< of a measured value [N], [N m]
  std::vector<double> broomstick;  ///< friction coefficients of whole-hole curves
  bool afterRun = false;           ///< computed at the end of a run, too
  bool helix = true;               ///< side force of a string buckled into a helix
};

/// All operations there are.
std::vector<std::string> operationNames();

/// Description of the list `Torque and Drag`.
deck::ListSpec torqueDragParameters();

/// From the validated list.
TorqueDragSettings readTorqueDrag(const Teuchos::ParameterList& list);

/// The operations that the settings name.
/// \param rotarySpeed  of those that turn [rad/s]
/// \param weightOnBit  of those on bottom [N]; likewise the torque [N m]
std::vector<Operation> operations(const TorqueDragSettings& settings, double rotarySpeed,
                                  double weightOnBit, double torqueOnBit);

}  // namespace tooljoint::softstring
