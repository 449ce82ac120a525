// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The unknowns of a string: its free (not held) nodal dofs, numbered node by node.
#pragma once

#include <vector>

#include "common/Index.hpp"
#include "common/RowRange.hpp"

namespace tooljoint::beam {

class FreeDofs {
 public:
  /// \param held  not 0 where a dof is held; perNode dofs for each node
  FreeDofs(int perNode, const std::vector<char>& held);

  int size() const { return sizeOf(dof_); }
  /// unknown(): unknown of a dof, -1 if the dof is held. The others take an unknown: its dof, its
  /// node and its component in the node.
  int unknown(int dof) const { return unknown_[at(dof)]; }
  int dof(int unknown) const { return dof_[at(unknown)]; }
  int node(int unknown) const { return dof(unknown) / perNode_; }
  int component(int unknown) const { return dof(unknown) % perNode_; }
  /// Unknowns of all dofs of the nodes `first` and `first + 1`, -1 for held dofs.
  std::vector<int> ofElement(int first) const;

  /// restrict(): the free entries of a vector of all dofs. put(): writes them into such a vector.
  Vector restrict(const Vector& full) const;
  void put(const Vector& x, Vector& full) const;

  /// As in model::ChainProblem.
  std::vector<int> firstOfNodes() const;
  /// Nodes begin ... end - 1.
  struct Nodes {
    int begin, end;
  };
  Nodes nodesOf(RowRange rows) const { return {node(rows.begin), node(rows.end - 1) + 1}; }

 private:
  int perNode_;
  std::vector<int> unknown_;  ///< of each dof
  std::vector<int> dof_;      ///< of each unknown
};

}  // namespace tooljoint::beam
