// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Consistency check of loops of rigid links and hinges: their arms must add up to zero.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>

#include "coupling/input/ComponentAxes.hpp"
#include "coupling/input/Connections.hpp"

namespace tooljoint::coupling {

/// Relative positions of nodes according to links. A link between nodes whose distance already
/// follows differently from other links would hold their rotations: u_to = u_from + theta x arm
/// with two arms leaves theta x (arm - arm') = 0.
class LinkLoops {
 public:
  using Node = std::pair<std::string, std::int64_t>;  ///< part (empty: any) and number

  explicit LinkLoops(const model::ComponentNames& names) : axes_(componentAxes(names)) {}

  /// `to` is at `from` + arm.
  /// \param what  the link, for messages: "deck.xml: /a/Rigid Links/b"
  /// \throw ModelError: the previous links give another position
  void add(const Node& from, const Node& to, const Vector3& arm, const std::string& what);

 private:
  /// The node that represents all nodes linked with this one, and the vector from it to this one
  /// [m].
  std::pair<Node, Vector3> rootOf(const Node& node) const;
  bool turns(const Vector3& gap) const;

  ComponentAxes axes_;
  std::map<Node, std::pair<Node, Vector3>> from_;  ///< a linked node, and the vector from it [m]
};

}  // namespace tooljoint::coupling
