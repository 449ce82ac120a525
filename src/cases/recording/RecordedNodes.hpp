// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Nodes whose motion a run records: all nodes of a case, or those chosen in its list Output.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/Case.hpp"

namespace tooljoint::cases {

/// A case whose list Output may choose nodes, in the terms of its kind.
class NodeChoice {
 public:
  virtual ~NodeChoice() = default;
  /// Numbers of the chosen nodes, increasing; empty: all. DeckError for an unknown node.
  virtual std::vector<std::int64_t> recordedNodes() const = 0;
};

/// Numbers of the recorded nodes of any case, increasing; empty: all. DeckError.
std::vector<std::int64_t> recordedNodes(const Case& one);
/// Number of recorded nodes.
std::size_t recordedCount(const Case& one);

}  // namespace tooljoint::cases
