// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a degree of freedom is: a component of a node that parts may share, or a modal coordinate of one part.
#pragma once

#include <cstdint>
#include <string>
#include <tuple>
#include <vector>

namespace tooljoint::model {

/// Label of one degree of freedom. Interface dofs of two parts are joined when their labels are equal.
struct DofLabel {
  enum class Kind : std::uint8_t { Physical, Modal };
  Kind kind = Kind::Physical;
  std::int64_t entity = 0;     ///< Physical: node number, 1-based as a person sees it. Modal: part number, 0-based.
  std::int32_t component = 0;  ///< Physical: 0-based component of the node. Modal: mode number, 0-based.

  static DofLabel physical(std::int64_t node, std::int32_t component) { return {Kind::Physical, node, component}; }
  static DofLabel modal(std::int64_t part, std::int32_t mode) { return {Kind::Modal, part, mode}; }
  friend bool operator==(const DofLabel& a, const DofLabel& b) {
    return a.kind == b.kind && a.entity == b.entity && a.component == b.component;
  }
  friend bool operator<(const DofLabel& a, const DofLabel& b) {
    return std::tie(a.kind, a.entity, a.component) < std::tie(b.kind, b.entity, b.component);
  }
};

/// Names of the physical components, e.g. {"u","v","w","theta_x","theta_y","theta_z"}.
using ComponentNames = std::vector<std::string>;

/// "theta_z of node 17", "mode 3 of part 2": for messages.
std::string describe(const DofLabel& label, const ComponentNames& names);

}  // namespace tooljoint::model
