// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Numbers of MUMPS (Users' guide 5.5) and of how it is used here. Included by sources of factors
/// only.
#pragma once

namespace tooljoint::linalg::mumps {

/// Columns solved at a time: enough for level-3 BLAS, little memory beside the factors.
inline constexpr int blockOfColumns = 64;
/// Room beside the estimate of the analysis that pivoting may take [%], at first and at most.
inline constexpr int firstRoom = 30, mostRoom = 500;

/// Jobs.
inline constexpr int initialise = -1, finish = -2, analyse = 1, decompose = 2, substitute = 3;
/// Errors (section 8).
inline constexpr int realRoom = -8, noRoom = -9, singular = -10, noMemory = -13, notDefinite = -40;

}  // namespace tooljoint::linalg::mumps
