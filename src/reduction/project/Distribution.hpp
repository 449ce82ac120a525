// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Assignment of parts to ranks, and exchange of reduced parts between ranks.
#pragma once

#include <string>
#include <vector>

#include "model/Substructure.hpp"
#include "reduction/ReductionMethod.hpp"
#include "reduction/project/Projection.hpp"

namespace tooljoint::reduction {

/// All data computed by the owner of a part. Every rank derives loads, point rows and initial
/// states from them.
struct ReducedCore {
  Basis basis;
  ProjectedMatrices matrices;
  BasisReport report;
};

/// Owner of each part: heaviest part first to the least loaded rank; equal parts by lower index.
/// The same on every rank.
std::vector<int> assignOwners(const std::vector<int>& weights, int ranks);

/// Parts on which all ranks work together: those with more than 20,000 dofs (below, communication
/// costs more than the division saves) and with more than a rank's share of all dofs.
std::vector<char> dividedParts(const std::vector<int>& weights, int ranks);

/// Converts a core to bytes, and back. Both ends must be the same program on the same kind of
/// machine.
std::string pack(const ReducedCore& core);
ReducedCore unpack(const std::string& bytes);

}  // namespace tooljoint::reduction
