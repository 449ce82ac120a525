// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Division of the string into parts and choice of retained dofs. Deck list `Substructures`.
#pragma once

#include <limits>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "deck/ListSpec.hpp"
#include "substructures/drillstring/DrillString.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::drillstring {

/// A run of elements that forms one substructure.
struct PartRange {
  std::string name;
  int firstElement = 0;  ///< 0-based
  int lastElement = 0;   ///< 0-based, inclusive
};

/// Components that are retained at a retained node.
enum class Retain { Nodes, Contact, Translations };

/// Settings of the list `Substructures`.
struct PartitionRules {
  std::string where = "Substructures";  ///< path of the list, for messages
  std::string rule = "By component";
  double length = 0.0;        ///< "By length": shortest part [m]
  std::vector<int> cutNodes;  ///< "By nodes": 1-based
  Retain retain = Retain::Nodes;
  std::string retainedNodes = "Gap";
  double retainedGap = 0.008;  ///< [m]
  int minimumReducedRun = 1;   ///< inner nodes; shorter runs between retained nodes stay physical
  double keepFullBelow = std::numeric_limits<double>::infinity();  ///< depth [m]; all nodes from
                                                                   ///< there on stay physical
  std::vector<int> nodeList;                                       ///< "List": 1-based
  bool contactAtRetainedOnly = false;
  bool axialContact = false;  ///< contact acts on w too
};

/// Data of the static state for the rules.
struct NodeState {
  std::vector<double> gap;  ///< radial clearance left at each node [m]; <= 0 in contact; +inf if
                            ///< contact is impossible
  std::vector<char> candidate;  ///< laterally free nodes with a contact point
  std::vector<int> loadedDofs;  ///< 6 node + component of dofs that point loads, and the torque at
                                ///< the ends, act on, increasing
};

/// Description of the list `Substructures`.
deck::ListSpec partitionParameters();

/// Rules of a validated list. `explicitIntegrator` decides the default of `Retained Dofs`: whole
/// nodes for implicit integrators, translations for explicit ones, since retained rotations would
/// reduce their stable step.
PartitionRules readPartition(const Teuchos::ParameterList& list, bool explicitIntegrator);

/// The parts from top to bottom; each element belongs to one part. With "By cost" parts are unknown
/// before the static state, and the components are returned. Throws DeckError for cut nodes that do
/// not exist.
std::vector<PartRange> cutParts(const DrillString& string, const PartitionRules& rules);

/// Positions 6 node + component of the retained dofs of the parts, increasing. Interface nodes,
/// which are always kept whole, may be among them.
std::vector<int> retainedDofs(const DrillString& string, const PartitionRules& rules,
                              const NodeState& state);

/// Throws DeckError when the rules name a node the string does not have.
void requireKnownNodes(const DrillString& string, const PartitionRules& rules);

/// Nodes (0-based, increasing) that `Retained Nodes` chooses.
std::vector<int> chosenNodes(const DrillString& string, const PartitionRules& rules,
                             const NodeState& state);

}  // namespace tooljoint::drillstring
