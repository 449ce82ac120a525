// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Products with a large basis with mostly nonzero entries, by dense kernels and for some rows at a
/// time, without a second copy of the basis.
#pragma once

#include "common/Types.hpp"

namespace tooljoint::reduction {

/// Fraction of entries above which dense columns need no more memory than sparse ones.
inline constexpr double fullFrom = 0.1;

/// True if the basis has enough rows and entries for the functions below.
bool isLargeAndFull(const Sparse& Phi);

/// Phi' A Phi.
Matrix projectByRows(const Sparse& A, const Sparse& Phi);
/// |phi_j|' |A| |phi_j| of every column.
Vector absoluteEnergiesByRows(const Sparse& A, const Sparse& Phi);
/// Phi' Phi.
Matrix gramByRows(const Sparse& Phi);
/// Phi q, rows x columns of q.
Matrix timesByRows(const Sparse& Phi, const Matrix& q);

}  // namespace tooljoint::reduction
