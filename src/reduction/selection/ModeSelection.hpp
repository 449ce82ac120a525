// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck list "Reduction/Mode Selection": number of kept modes. The list has one parameter; its
/// name is the choice, its value the number, frequency, fraction or tolerance.
#pragma once

#include <string>

#include "deck/ListSpec.hpp"
#include "reduction/selection/ModeChoice.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::reduction {

/// Description of the list "Mode Selection".
deck::ListSpec modeSelection();

/// True when the list "Reduction" selects modes by the parameter `name` of "Mode Selection".
bool selectsModesBy(const Teuchos::ParameterList& reduction, const std::string& name);

/// Value of the tolerance `name` ("Frequency Tolerance" or "Motion Tolerance"); 0 when the list
/// "Reduction" does not give it.
double toleranceOf(const Teuchos::ParameterList& reduction, const std::string& name);

/// True when a tolerance selects the modes.
bool selectsModesByTolerance(const Teuchos::ParameterList& reduction);

/// The selection of the list "Reduction" (defaults filled in) for `parts` substructures. DeckError
/// when the list "Mode Selection" does not hold exactly one parameter (the two tolerances may be
/// given together), or when "Modes by Substructure" does not have `parts` entries. \param needed if
/// false, a deck without that list keeps no modes
ModeRule readModeSelection(const Teuchos::ParameterList& reduction, int parts, bool needed);

}  // namespace tooljoint::reduction
