// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rigid links and hinges that close a loop must lead back to where they began.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/Connections.hpp"

namespace tooljoint::coupling {

/// Where nodes stand from one another, as far as links say. A link between nodes whose distance
/// other links give otherwise would hold their rotations: u_to = u_from + theta x arm twice, with
/// two arms, leaves theta x (arm - arm') = 0.
class LinkLoops {
 public:
  using Node = std::pair<std::string, std::int64_t>;  ///< part (empty: any) and number

  explicit LinkLoops(const model::ComponentNames& names) : axes_(componentAxes(names)) {}

  /// `to` stands at `from` + arm. \param what  the link, for messages: "deck.xml: /a/Rigid Links/b"
  /// \throw ModelError: the links before lead elsewhere
  void add(const Node& from, const Node& to, const Vector3& arm, const std::string& what);

 private:
  /// The node that stands for all linked with this one, and the way from it to this one [m].
  std::pair<Node, Vector3> rootOf(const Node& node) const;
  bool turns(const Vector3& gap) const;

  ComponentAxes axes_;
  std::map<Node, std::pair<Node, Vector3>> from_;  ///< a linked node, and the way from it [m]
};

}  // namespace tooljoint::coupling
