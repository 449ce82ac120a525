// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Results for parts, computed by the ranks that own them, or by all ranks together.
#pragma once

#include <vector>

#include "common/Message.hpp"
#include "reduction/project/Distribution.hpp"

namespace tooljoint::reduction {

/// result[p] = compute(p, ranks) of every part, for all ranks. It is computed on the rank that owns
/// the part, or on all ranks together if the part is larger than the share of a rank
/// (dividedParts). Collective.
template <class Result, class Compute>
std::vector<Result> shareOut(const std::vector<model::Substructure>& parts,
                             const Compute& compute) {
  std::vector<int> weights;
  for (const auto& part : parts) weights.push_back(part.model.size());
  const auto divided = dividedParts(weights, parallel::size());
  const auto owners = assignOwners(weights, parallel::size());
  std::vector<Result> results(parts.size());
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (divided[p] != 0) results[p] = compute(p, parallel::Ranks::All);
  parallel::agree([&] {
    for (std::size_t p = 0; p < parts.size(); ++p)
      if (divided[p] == 0 && owners[p] == parallel::rank())
        results[p] = compute(p, parallel::Ranks::Own);
  });
  for (std::size_t p = 0; p < parts.size(); ++p)
    if (divided[p] == 0) parallel::broadcast(results[p], owners[p]);
  return results;
}

}  // namespace tooljoint::reduction
