// SPDX-License-Identifier: BSD-3-Clause
#include "cases/recording/RecordedNodes.hpp"

#include <string>

#include "common/Error.hpp"

namespace tooljoint::cases {

std::vector<std::int64_t> recordedNodes(const Case& one) {
  if (const auto* choice = dynamic_cast<const NodeChoice*>(&one)) return choice->recordedNodes();
  if (one.list().isSublist("Output"))
    for (const char* name : {"Depths", "Nodes"})
      if (one.list().sublist("Output").isParameter(name))
        throw DeckError(one.deck().error(std::string("Output/") + name,
                                         "chooses nodes, which this kind of case cannot."));
  return {};
}

std::size_t recordedCount(const Case& one) {
  const auto chosen = recordedNodes(one).size();
  return chosen > 0 ? chosen : static_cast<std::size_t>(one.nodes());
}

}  // namespace tooljoint::cases
