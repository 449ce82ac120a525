// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Drillstring`: components, their source, and their order.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "deck/Deck.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/assembly/Components.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// Settings of the list `Drillstring`.
struct StringSettings {
  ComponentLibrary library;             ///< of the file and of the deck itself
  std::vector<AssemblyEntry> assembly;  ///< from the surface down
  std::string assemblyWhere;            ///< position of the assembly in the deck, for messages
  std::optional<double> bitDepth;       ///< [m]; none: end of the assembly, or end of the well for
                                        ///< an assembly that fills
  std::string depthWhere;               ///< position of the depth in the deck, for messages
  deck::Given depth{"Bit Depth", "m"};  ///< how the deck gives it
  SegmentDefaults defaults;             ///< of components that do not set them
  double toolFace = 0.0;                ///< [rad]

  /// "deck.xml:10: /well/Drillstring/Bit Depth is 7900 ft", the beginning of a message.
  std::string bitAt(double bit) const;
};

/// Description of the list `Drillstring`.
deck::ListSpec drillstringParameters();

/// Settings of the deck's list `Drillstring`, component library included. Collective (the library
/// is read on rank 0). Throws DeckError with one line "file:line: path: sentence" per fault.
StringSettings readDrillstring(const deck::Deck& deck);

/// The meshed string in its well; see buildDrillString in Mesh.hpp. Its lower end is at the depth
/// `bit` [m] if given, otherwise at that of the settings. An assembly that fills gets as many
/// components as reach from there to the surface. DeckError if the assembly is shorter than the
/// depth.
DrillString buildDrillString(const StringSettings& settings, const well::Well& well,
                             std::optional<double> bit = std::nullopt);

}  // namespace tooljoint::drillstring
