// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Joints of the deck list `Parts`: "left:tip = right:root".
#pragma once

#include <set>
#include <string>
#include <utility>
#include <vector>

#include "coupling/input/CouplingParameters.hpp"
#include "parts/file/PartFile.hpp"

namespace tooljoint::parts {

/// Joints of one text.
struct ReadJoint {
  std::vector<coupling::JointInput> joints;  ///< node by node
  std::vector<coupling::ReleaseInput>
      releases;         ///< components that parts have at a joined node, but not in a joined set
  std::set<int> mixed;  ///< parts in which a rotation would mix such components with joined ones
};

class JointReader {
 public:
  /// \param held   fixed dofs of the parts
  /// \param where  path of the parameter, for messages
  JointReader(const std::vector<PartContent>& parts,
              const std::set<std::pair<int, model::DofLabel>>& held, std::string where)
      : parts_(parts), held_(held), where_(std::move(where)) {}

  /// DeckError with the text: unknown part, node or set; sets of different lengths; a dof that is
  /// fixed on one side and free on the other; no common components.
  ReadJoint read(const std::string& text) const;

 private:
  struct Side {
    int part = 0;
    std::string text;
    std::vector<std::int64_t> nodes;
    std::vector<std::set<int>> joined;  ///< components per node named in the text
    std::vector<std::set<int>> had;     ///< components of the part at the node, fixed ones included
  };
  /// True if `some` contains some, but not all, of the components along three axes that the part
  /// has at node k.
  bool splitsTriple(const Side& side, std::size_t k, const std::set<int>& some) const;
  [[noreturn]] void fail(const std::string& text, const std::string& what) const;
  Side side(const std::string& text, const std::string& whole) const;

  const std::vector<PartContent>& parts_;
  const std::set<std::pair<int, model::DofLabel>>& held_;
  std::string where_;
};

}  // namespace tooljoint::parts
