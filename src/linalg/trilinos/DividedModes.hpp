// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes of a chain whose products and solves ranks divide among themselves.
#pragma once

#include <memory>

#include "linalg/chains/ChainShare.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {

/// lowestModes(): matrices and modes are whole and alike on all ranks, each of which has its rows
/// of products and solutions. K and M couple a node to itself and to the two beside it only.
/// Collective.
EigenPairs lowestModesOfChain(const Sparse& K, const Sparse& M, int count,
                              const EigenOptions& options, std::shared_ptr<const ChainShare> share);

}  // namespace tooljoint::linalg
