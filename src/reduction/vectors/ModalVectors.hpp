// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fixed-interface bases from any interior vectors. The vectors are made mass-orthonormal and
/// diagonalise the stiffness of their span (Rayleigh and Ritz), so that every such basis has the
/// structure of Craig-Bampton.
#pragma once

#include <string>
#include <vector>

#include "reduction/ReductionMethod.hpp"
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

/// Basis::modeKind of columns with dependent coordinates (ReductionMethod::dependentCoordinates):
/// estimates treat them as truncated, since they cannot respond to a residual.
inline const std::string followingKind = "tied residual";

/// Vectors that are orthonormal in the inner product of a mass matrix, in the order they came.
class OrthonormalSet {
 public:
  /// `tolerance`: a vector whose mass norm is reduced by more than this factor depends on the
  /// previous ones. `who` begins error messages.
  OrthonormalSet(const Sparse& mass, double tolerance, std::string who);

  /// Adds the new part of `vector` (Gram-Schmidt, twice); false if there is none, or if it has no
  /// mass. ModelError when the mass is indefinite.
  bool add(const Vector& vector);
  /// The same; `factor` becomes the coefficients in the resulting set: vector = basis() factor.
  bool add(const Vector& vector, Vector& factor);

  const Matrix& basis() const { return basis_; }
  int size() const { return static_cast<int>(basis_.cols()); }
  /// sqrt(v' M v).
  double norm(const Vector& v) const;

 private:
  Sparse mass_;
  Sparse absolute_;  ///< |M|, entry by entry
  double tolerance_;
  std::string who_;
  Matrix basis_;     ///< n x size
  Matrix weighted_;  ///< M basis
};

/// Adds the Ritz vectors of sym(K) in the span of M-orthonormal columns Q, on one group: Q y with
/// (Q' K Q) y = lambda y, by increasing lambda; the entry of largest magnitude of each is positive.
/// Raises the orthogonality to max |Phi' M Phi - I|.
void addRitzVectors(const Sparse& symmetricK, const Sparse& M, const Matrix& Q, int group,
                    const std::string& kind, InteriorVectors& to);

/// Appends the new part of the columns of X (interior x columns), orthonormalised against the modal
/// columns of `basis`, as modal columns of `kind`; returns their number. With `rotate`, if
/// stiffness couples the new columns with the others, all modal columns become Ritz vectors of the
/// larger span. Without `rotate` they are unchanged, and the basis is no longer `orthonormal`.
int appendVectors(const PartView& part, const Matrix& X, const std::string& kind, double tolerance,
                  bool rotate, Basis& basis);

/// `part` with the boundary of its basis, which may have more dofs than that of the part.
PartView viewOf(const PartView& part, const Basis& basis);

/// The constraint modes of a basis, dofs of the part x boundary dofs.
Sparse constraintColumns(const Basis& basis);
/// Modal columns of a basis on the interior.
Sparse modalColumns(const Basis& basis);
/// Inertia of the constraint modes: L = M_IC + M_II psi, interior x boundary dofs.
Matrix constraintInertia(const PartView& part, const Basis& basis);

}  // namespace tooljoint::reduction
