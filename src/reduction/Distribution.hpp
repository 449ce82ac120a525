// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which rank reduces which part, which parts are identical, and how a reduced part travels between ranks.
#pragma once

#include <string>
#include <vector>

#include "model/Substructure.hpp"
#include "reduction/Basis.hpp"
#include "reduction/Projection.hpp"

namespace tooljoint::reduction {

/// Everything the owner of a part computes. Loads, point rows and initial states are made from it on every rank.
struct ReducedCore {
  BasisResult basis;
  ProjectedMatrices matrices;
  BasisReport report;
};

/// Owner of each part: heaviest part first to the least loaded rank, ties to the lower index. The same on every rank.
std::vector<int> assignOwners(const std::vector<int>& weights, int ranks);

/// For each part the first part it is identical to (itself when there is none): same partition, same law names, same request, and
/// matrices in the part's own dofs (nodal frames: where the part lies does not matter) equal to |a_ij - b_ij| <= 1e-11 sqrt(r_i r_j),
/// r the largest entries of the rows of all terms of that law. Loads, labels, points and states may differ. The sum of the
/// sizes of all entries of the stiffness sorts the parts, so that n different parts are not compared n^2 / 2 times.
std::vector<int> findTwins(const std::vector<model::Substructure>& parts, const std::vector<ModeRequest>& requests);

/// A core as bytes, and back. Both ends must be the same program on the same kind of machine.
std::string pack(const ReducedCore& core);
ReducedCore unpack(const std::string& bytes);

}  // namespace tooljoint::reduction
