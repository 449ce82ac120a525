// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A node as named in a deck, for loads at nodes.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <optional>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"

namespace tooljoint::loads {

/// By number, or by the measured depth of a node.
struct Place {
  std::optional<int> node;         ///< 1-based
  std::optional<double> position;  ///< arc length from the surface [m]
};

/// Declares `Node` and `Position`; `role` completes "Node ...": "it acts on".
void declarePlace(deck::ListSpec& list, const std::string& role);
/// From a validated list; DeckError when it names the place twice or not at all. `who` is the path
/// of the list in the deck.
Place readPlace(const Teuchos::ParameterList& list, const std::string& who);

/// Node number (1-based) of a place, given the arc length of every node [m]. DeckError when there
/// is no such node. A position must match a node within 1e-6 m; the message names the nearest node.
int nodeOf(const Place& place, const std::vector<double>& arcLength, const std::string& who);

}  // namespace tooljoint::loads
