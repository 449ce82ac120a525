// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Memory for factors: what is free, and the refusal where it is too little.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/Error.hpp"

namespace tooljoint::linalg {

/// A model is too large for the memory there is (exit code 3).
struct MemoryError : ModelError {
  using ModelError::ModelError;
};

/// Memory that this process may still take [MB]: the least of what Linux says is free, what the
/// limit of its address space leaves (ulimit -v), and what its control group leaves; none where
/// nothing tells. Memory that was freed, and that the C library keeps for later, is given back
/// before.
std::optional<long> freeMegabytes();

/// Throws MemoryError: the factors of a matrix with so many rows need more than there is.
/// \param available [MB]; none: not known
/// \param divided the need is that of one rank of several
[[noreturn]] void refuseMemory(Eigen::Index rows, long needed, std::optional<long> available,
                               bool divided = false);

}  // namespace tooljoint::linalg
