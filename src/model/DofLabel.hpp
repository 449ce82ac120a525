// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Kinds of degrees of freedom: a component of a node that parts may share, a modal coordinate of
/// one part, a mode of an interface, or a force between parts.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <tuple>
#include <vector>

#include "model/SharedList.hpp"

namespace tooljoint::model {

/// Label of one degree of freedom. Interface dofs of two parts are joined if their labels are
/// equal.
struct DofLabel {
  enum class Kind : std::uint8_t { Physical, Modal, Interface };
  static constexpr std::int32_t shared = -1;

  Kind kind = Kind::Physical;
  std::int64_t entity = 0;  ///< Physical: node number, 1-based as printed. Modal: part
                            ///< number, 0-based. Interface: number of the interface, 0-based.
  std::int32_t component =
      0;  ///< Physical: 0-based component of the node. Modal, Interface: mode number, 0-based.
  std::int32_t part = shared;  ///< Physical, in a coupled model: the part (0-based) that owns this
                               ///< dof although others have one of that label
  std::int8_t force = 0;  ///< 1, 2: not a displacement, but one of the two multipliers whose sum is
                          ///< the force between this dof of `part` and the rest

  static DofLabel physical(std::int64_t node, std::int32_t component) {
    return {Kind::Physical, node, component};
  }
  static DofLabel modal(std::int64_t part, std::int32_t mode) { return {Kind::Modal, part, mode}; }
  static DofLabel interfaceMode(std::int64_t interface, std::int32_t mode) {
    return {Kind::Interface, interface, mode};
  }
  DofLabel of(std::int32_t owner) const { return {kind, entity, component, owner, force}; }
  DofLabel joiningForce(std::int8_t which) const { return {kind, entity, component, part, which}; }
  friend bool operator==(const DofLabel& a, const DofLabel& b) { return a.key() == b.key(); }
  friend bool operator<(const DofLabel& a, const DofLabel& b) { return a.key() < b.key(); }

 private:
  std::tuple<Kind, std::int64_t, std::int32_t, std::int32_t, std::int8_t> key() const {
    return {kind, entity, component, part, force};
  }
};

/// Names of the physical components, e.g. {"u","v","w","theta_x","theta_y","theta_z"}.
using ComponentNames = SharedList<std::string>;

/// User's name for the node of a label: "node 4 of part "mast"" if parts from files have their own
/// numbers. Empty: "node 17", from the label.
using NodeNamer = std::function<std::string(const DofLabel&)>;

/// "theta_z of node 17", "theta_z of node 17 in part 2", "mode 3 of part 2", "the force on theta_z
/// of node 17 in part 2": for messages.
std::string describe(const DofLabel& label, const ComponentNames& names,
                     const NodeNamer& nodeName = {});

}  // namespace tooljoint::model
