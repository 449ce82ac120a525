// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes of a chain with products and solves divided among ranks.
#pragma once

#include <memory>

#include "linalg/chains/ChainShare.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {

/// lowestModes() for a chain: matrices and modes are complete and equal on all ranks, each rank
/// computes its rows of products and solutions. K and M couple a node only to itself and to its two
/// neighbours. Collective.
EigenPairs lowestModesOfChain(const Sparse& K, const Sparse& M, int count,
                              const EigenOptions& options, std::shared_ptr<const ChainShare> share);

}  // namespace tooljoint::linalg
