// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Dofs of nodes as named in a deck, in any model of a case: loads and outputs of responses,
/// columns of measured logs.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <array>
#include <cstdint>
#include <string>

#include "cases/Case.hpp"
#include "deck/ListSpec.hpp"

namespace tooljoint::cases {

/// A component of a node as named in a deck.
struct NodeDof {
  std::string where;  ///< path of its list
  std::string part;   ///< "": only one node of the scene has this number
  int node = 0;
  std::string component;  ///< "" for the whole node
};

/// Declares `Part` and `Node`.
void declareNode(deck::ListSpec& list, const std::string& what);
NodeDof readNode(const Teuchos::ParameterList& list);

/// A row of the recovery of the models of a case.
struct NodeRow {
  std::int64_t number = 0;  ///< of the node in the scene
  int component = 0;
};

/// The row named in a deck. DeckError if the part, the node (or a unique node of this number) or
/// the component does not exist, or if all of the node is held.
NodeRow findRow(const RestingCase& rest, const model::SecondOrderModel& model, const NodeDof& dof);

/// The coefficients c of a displacement c'q, which are also those of a unit load there, dofs of the
/// model; zero if the model does not have the node or the dof is held.
Vector coefficients(const model::SecondOrderModel& model, const NodeRow& row);

/// Positions among the components of a node of the two translations normal to the axis of rotation
/// "x", "y" or "z", in the sense of the rotation; -1 for a translation that the nodes do not have.
std::array<int, 2> lateralComponents(const model::SecondOrderModel& model, const std::string& axis);

}  // namespace tooljoint::cases
