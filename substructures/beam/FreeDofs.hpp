// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The unknowns of a string: the dofs of its nodes that nothing holds, numbered node by node.
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
  /// Of a dof its unknown, -1 where it is held; of an unknown its dof, its node and its place in
  /// the node.
  int unknown(int dof) const { return unknown_[at(dof)]; }
  int dof(int unknown) const { return dof_[at(unknown)]; }
  int node(int unknown) const { return dof(unknown) / perNode_; }
  int component(int unknown) const { return dof(unknown) % perNode_; }
  /// Unknowns of all dofs of the nodes `first` and `first + 1`, -1 where held.
  std::vector<int> ofElement(int first) const;

  /// The free entries of a vector of all dofs, and a vector of all dofs that has them at its free
  /// ones.
  Vector restrict(const Vector& full) const;
  void put(const Vector& x, Vector& full) const;

  /// Of model::ChainProblem.
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
