// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What all eigensolvers share: checks of the input, conventions and recomputed errors of the
/// result.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {

/// (A + A')/2. ModelError naming the dofs where |a_ij - a_ji| > 1e-9 of the size of their rows, or
/// an entry is not finite.
Sparse symmetricPart(const Sparse& A, const std::string& what, const DofNamer& name);

/// The same; where A is symmetric to the last bit, A itself, which must outlive the result.
std::shared_ptr<const Sparse> sharedSymmetricPart(const Sparse& A, const std::string& what,
                                                  const DofNamer& name);

/// The pivot of each dof in LDL' factors of the symmetric M; of a large one its diagonal entry.
/// ModelError naming the dof when M is not positive definite.
Vector definitePivots(const Sparse& M, const DofNamer& name);

/// 1 / sqrt(M_ii), which makes translations, rotations and modal coordinates comparable; dofs
/// without mass take part by their stiffness.
Vector unitMassScale(const Sparse& K, const Sparse& M);

/// unitMassScale to the nearest powers of two: scaling by them rounds nothing.
Vector binaryMassScale(const Sparse& K, const Sparse& M);

/// What rounding may leave of phi'K phi, as a fraction of |phi|'|K||phi|: eps for every entry of
/// the fullest row and for the few operations that made the entry (N. J. Higham, Accuracy and
/// Stability of Numerical Algorithms (2002), section 3.5), or half a unit of the last digit that a
/// text file has left of its entries.
double roundingOf(const Sparse& K);

/// phi'K phi = value is zero but for rounding: |value|, or |phi'K phi| as the shape gives it, is at
/// most roundingOf(K) |phi|'|K||phi|. Rigid-body motions are.
bool isRounding(double value, const Vector& phi, const Sparse& K);
/// The same for the columns of `shapes`.
std::vector<char> areRounding(const Vector& values, const Matrix& shapes, const Sparse& K);

/// Largest K_ii / M_ii, a lower bound of the largest eigenvalue of a positive definite pencil.
double eigenvalueScale(const Sparse& K, const Sparse& M);

/// Sorts by value, mass-normalises and fixes the signs.
void applyConventions(EigenPairs& modes, const Sparse& M);

/// Fills in residuals and orthogonality. ConvergenceError when they exceed the limits.
void recomputeErrors(EigenPairs& modes, const Sparse& K, const Sparse& M, double tolerance,
                     double orthogonality);

/// Number of modes to keep: `count`, or more when the next values are within `tolerance` (relative)
/// of the last one; values closer than `floor` are the same value (rigid-body modes). Returns
/// values.size() when no gap was found.
int keepWholePairs(const Vector& values, int count, double tolerance, double floor);

/// The first `count` modes.
void truncate(EigenPairs& modes, int count);

}  // namespace tooljoint::linalg
