// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Memory for factors: free memory, and the error if it is not enough.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "common/Error.hpp"

namespace tooljoint::linalg {

/// A model is too large for the available memory (exit code 3).
struct MemoryError : ModelError {
  using ModelError::ModelError;
};

/// Memory available to this process [MB]: the least of the memory that Linux reports free, the rest
/// of its address space limit (ulimit -v), and the rest of its control group; empty if all are
/// unknown. Freed memory that the C library keeps is returned first.
std::optional<long> freeMegabytes();

/// Throws MemoryError: the factors of a matrix with this many rows need more than the available
/// memory.
/// \param available [MB]; empty: not known
/// \param divided `needed` is that of one rank of several
[[noreturn]] void refuseMemory(Eigen::Index rows, long needed, std::optional<long> available,
                               bool divided = false);

}  // namespace tooljoint::linalg
