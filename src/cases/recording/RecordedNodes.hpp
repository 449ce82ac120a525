// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whose motion a run records: all nodes of a case, or those that its list Output chooses.
#pragma once

#include <cstdint>
#include <vector>

#include "cases/Case.hpp"

namespace tooljoint::cases {

/// A case whose list Output may choose nodes, in the words of its kind.
class NodeChoice {
 public:
  virtual ~NodeChoice() = default;
  /// Numbers of the chosen nodes, increasing; empty: all. DeckError for a node that is not there.
  virtual std::vector<std::int64_t> recordedNodes() const = 0;
};

/// Numbers of the recorded nodes of any case, increasing; empty: all. DeckError.
std::vector<std::int64_t> recordedNodes(const Case& one);
/// How many nodes are recorded.
std::size_t recordedCount(const Case& one);

}  // namespace tooljoint::cases
