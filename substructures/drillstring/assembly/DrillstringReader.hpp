// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Drillstring`: components, where they come from, and their order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/Deck.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// What the list `Drillstring` says.
struct StringSettings {
  ComponentLibrary library;             ///< of the file and of the deck itself
  std::vector<AssemblyEntry> assembly;  ///< from the surface down
  std::string assemblyWhere;            ///< where the assembly stands in the deck, for messages
  std::optional<double> bitDepth;       ///< [m]; none: where the assembly ends, or the end of the
                                        ///< well for one that fills
  std::string depthWhere;               ///< where the depth stands in the deck, for messages
  deck::Given depth{"Bit Depth", "m"};  ///< how the deck gives it
  SegmentDefaults defaults;             ///< of components that give none
  double toolFace = 0.0;                ///< [rad]

  /// "deck.xml:10: /well/Drillstring/Bit Depth is 7900 ft", the beginning of a message.
  std::string bitAt(double bit) const;
};

/// Description of the list `Drillstring`.
deck::ListSpec drillstringParameters();

/// Settings of the deck's list `Drillstring`, component library included. Collective (the library
/// is read on rank 0). Throws DeckError with one line "file:line: path: sentence" per fault.
StringSettings readDrillstring(const deck::Deck& deck);

/// The meshed string in its well, with its lower end at the depth `bit` [m] where one is given,
/// else that of the settings: see buildDrillString in Mesh.hpp. An assembly that fills gets as many
/// components as reach from there to the surface. DeckError: the assembly is shorter than the
/// depth.
DrillString buildDrillString(const StringSettings& settings, const well::Well& well,
                             std::optional<double> bit = std::nullopt);

}  // namespace tooljoint::drillstring
