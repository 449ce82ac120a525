// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Held dofs. Deck list `Supports`.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "substructures/drillstring/DrillString.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::drillstring {

/// One flag per dof of a node: u, v, w, theta_x, theta_y, theta_z.
using DofFlags = std::array<bool, 6>;

/// A support at a single node.
struct NamedSupport {
  std::string name;
  int node = 0;  ///< 1-based
  DofFlags dofs{};
  std::string path = {};  ///< of its list in the deck, for messages
};

/// Settings of the list `Supports`; the defaults are those of a deck without the list.
struct SupportSettings {
  DofFlags top = {true, true, true, false, false, true};
  DofFlags bit = {true, true, false, false, false, false};
  std::vector<NamedSupport> named;
  bool lateral = true;    ///< u, v, theta_x, theta_y are modelled
  bool axial = true;      ///< w is modelled
  bool torsional = true;  ///< theta_z is modelled

  /// One flag per dof of the string, 6 per node: held by a support, or of a family that is not
  /// modelled. Throws DeckError when a named support is at a node that does not exist.
  std::vector<char> held(int nodes) const;
};

/// 6 flags per node: held by a support, or because no element at the node has the dof. DeckError as
/// SupportSettings::held.
std::vector<char> heldDofs(const SupportSettings& supports, const DrillString& string);

/// Description of the list `Supports`.
deck::ListSpec supportParameters();

/// Settings of a validated list `Supports`. Throws DeckError for an unknown dof or family, with the
/// most similar name.
SupportSettings readSupports(const Teuchos::ParameterList& list);

/// "u v theta_z" -> flags; "" and "none" hold nothing, "all" holds everything. `where` begins the
/// sentence of a DeckError.
DofFlags parseDofs(const std::string& text, const std::string& where);

}  // namespace tooljoint::drillstring
