// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which rank reduces which part, and how a reduced part travels between ranks.
#pragma once

#include <string>
#include <vector>

#include "model/Substructure.hpp"
#include "reduction/ReductionMethod.hpp"
#include "reduction/project/Projection.hpp"

namespace tooljoint::reduction {

/// Everything the owner of a part computes. Loads, point rows and initial states are made from it
/// on every rank.
struct ReducedCore {
  Basis basis;
  ProjectedMatrices matrices;
  BasisReport report;
};

/// Owner of each part: heaviest part first to the least loaded rank, ties to the lower index. The
/// same on every rank.
std::vector<int> assignOwners(const std::vector<int>& weights, int ranks);

/// Parts on which all ranks work at once: those of more than 20,000 dofs (below, messages cost what
/// the division wins) and of more than a rank's share of all dofs.
std::vector<char> dividedParts(const std::vector<int>& weights, int ranks);

/// A core as bytes, and back. Both ends must be the same program on the same kind of machine.
std::string pack(const ReducedCore& core);
ReducedCore unpack(const std::string& bytes);

}  // namespace tooljoint::reduction
