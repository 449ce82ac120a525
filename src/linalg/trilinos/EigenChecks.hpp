// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Common parts of all eigensolvers: checks of the input, conventions and recomputed errors of the
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

/// The same; if A is bitwise symmetric, A itself, which must outlive the result.
std::shared_ptr<const Sparse> sharedSymmetricPart(const Sparse& A, const std::string& what,
                                                  const DofNamer& name);

/// Pivot of each dof in LDL' factors of the symmetric M; for a large M its diagonal entry.
/// ModelError naming the dof if M is not positive definite.
Vector definitePivots(const Sparse& M, const DofNamer& name);

/// 1 / sqrt(M_ii), which makes translations, rotations and modal coordinates comparable; massless
/// dofs are scaled by their stiffness.
Vector unitMassScale(const Sparse& K, const Sparse& M);

/// unitMassScale rounded to powers of two: scaling by them has no rounding errors.
Vector binaryMassScale(const Sparse& K, const Sparse& M);

/// Rounding error of phi'K phi as a fraction of |phi|'|K||phi|: eps for every entry of the fullest
/// row and for the few operations that computed the entry (N. J. Higham, Accuracy and Stability of
/// Numerical Algorithms (2002), section 3.5), or half a unit of the last digit of entries read from
/// a text file.
double roundingOf(const Sparse& K);

/// Whether phi'K phi = value is zero up to rounding: |value|, or |phi'K phi| computed from the
/// shape, is at most roundingOf(K) |phi|'|K||phi|. This holds for rigid-body motions.
bool isRounding(double value, const Vector& phi, const Sparse& K);
/// The same for the columns of `shapes`.
std::vector<char> areRounding(const Vector& values, const Matrix& shapes, const Sparse& K);

/// Largest K_ii / M_ii, a lower bound of the largest eigenvalue of a positive definite pencil.
double eigenvalueScale(const Sparse& K, const Sparse& M);

/// Sorts by value, mass-normalises and fixes the signs.
void applyConventions(EigenPairs& modes, const Sparse& M);

/// Sets residuals and orthogonality. ConvergenceError if they exceed the limits.
void recomputeErrors(EigenPairs& modes, const Sparse& K, const Sparse& M, double tolerance,
                     double orthogonality);

/// Number of modes to keep: `count`, or more if the next values are within `tolerance` (relative)
/// of the last one. Values closer than `floor` are equal (rigid-body modes). Returns values.size()
/// if there is no gap.
int keepWholePairs(const Vector& values, int count, double tolerance, double floor);

/// The first `count` modes.
void truncate(EigenPairs& modes, int count);

}  // namespace tooljoint::linalg
