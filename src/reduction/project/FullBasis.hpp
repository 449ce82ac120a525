// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Products with a large basis of which most entries are not zero, by dense kernels and some rows
/// at a time: they need no second copy of it.
#pragma once

#include "common/Types.hpp"

namespace tooljoint::reduction {

/// Share of entries from which dense columns are no longer than sparse ones.
inline constexpr double fullFrom = 0.1;

/// So many rows and so many entries that the functions below are the better ones.
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
