// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/loads/Place.hpp"

#include <algorithm>
#include <cmath>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::loads {

void declarePlace(deck::ListSpec& list, const std::string& role) {
  using deck::Range;
  list.integer("Node", deck::Optional{}, Range::atLeast(1),
               "Node " + role + ", counted from 1 at the surface; give this or Position.");
  list.real("Position", "m", deck::Optional{}, Range::nonNegative(),
            "Measured depth of the node " + role + "; give this or Node.");
}

Place readPlace(const Teuchos::ParameterList& list, const std::string& who) {
  Place place;
  if (list.isParameter("Node")) place.node = list.get<int>("Node");
  if (list.isParameter("Position")) place.position = list.get<double>("Position");
  if (place.node.has_value() == place.position.has_value()) {
    throw DeckError(who + " needs either Node or Position, not " +
                    (place.node ? "both." : "none of them."));
  }
  return place;
}

namespace {

constexpr double nodeTolerance = 1e-6;  // m

}  // namespace

int nodeOf(const Place& place, const std::vector<double>& arcLength, const std::string& who) {
  const int nodes = static_cast<int>(arcLength.size());
  if (place.node) {
    if (*place.node >= 1 && *place.node <= nodes) return *place.node;
    throw DeckError(who + " names node " + std::to_string(*place.node) +
                    ", but the string has nodes 1 to " + std::to_string(nodes) + ".");
  }
  const double wanted = place.position.value();
  const auto nearest = std::min_element(
      arcLength.begin(), arcLength.end(),
      [wanted](double a, double b) { return std::abs(a - wanted) < std::abs(b - wanted); });
  const int node = static_cast<int>(nearest - arcLength.begin()) + 1;
  if (nearest != arcLength.end() && std::abs(*nearest - wanted) <= nodeTolerance) return node;
  throw DeckError(who + " names the position " + formatNumber(wanted) +
                  " m, where no node is; the nearest is node " + std::to_string(node) + " at " +
                  formatNumber(*nearest) + " m.");
}

}  // namespace tooljoint::loads
