// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fixed-interface bases of any interior vectors: they are made mass-orthonormal and diagonalise
/// the stiffness of their span (Rayleigh and Ritz), so that every such basis has the structure of
/// Craig-Bampton.
#pragma once

#include <string>
#include <vector>

#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/methods/ReductionMethod.hpp"
#include "reduction/part/ConstraintModes.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"

namespace tooljoint::reduction {

/// Basis::modeKind of columns whose coordinates follow the others
/// (ReductionMethod::dependentCoordinates): estimates count them as left out, since they are not
/// free to answer a residual.
inline const std::string followingKind = "tied residual";

/// A modal column: `shape` on interior dofs of one group, zero everywhere else.
struct ModalVector {
  double eigenvalue = 0;  ///< omega^2, or the Ritz value
  int group = 0;          ///< index into the groups it was made with
  Vector shape;
  double residual = 0;  ///< relative, of the equation that defines it
  std::string kind;
  std::string why = "asked for";
  std::string name = {};  ///< "vector k" when empty
};

/// Vectors that are orthonormal in the inner product of a mass matrix, in the order they came.
class OrthonormalSet {
 public:
  /// `tolerance`: a vector whose mass norm falls by more than this factor is dependent on those
  /// before it. `who` begins error messages.
  OrthonormalSet(Sparse mass, double tolerance, std::string who);

  /// Adds what is new in `vector` (Gram-Schmidt, twice); false when nothing is, or when it moves no
  /// mass. ModelError when the mass is indefinite.
  bool add(const Vector& vector);
  /// The same; `factor` becomes the coefficients on the set as it is afterwards: vector = basis()
  /// factor.
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

/// Ritz vectors of sym(K) in the span of M-orthonormal columns Q: Q y with (Q' K Q) y = lambda y,
/// by increasing lambda; the entry of largest magnitude of each is positive. `defect` becomes max
/// |Phi' M Phi - I|.
std::vector<ModalVector> ritzVectors(const Sparse& symmetricK, const Sparse& M, const Matrix& Q,
                                     int group, const std::string& kind, double& defect);

/// Zero-energy modes of a link that touches no kept dof, mass-orthonormal: the ways it floats.
/// Empty when it does not.
Matrix floatingModes(const Sparse& symmetricK, const Sparse& M, const linalg::DofNamer& name);

/// Phi = [1 0; psi V]: constraint modes and the given vectors, sorted by eigenvalue. `groups[g]`
/// are indices into Partition::interior.
Basis fixedInterfaceBasis(const model::Substructure& part, const Partition& partition,
                          const ConstraintModes& constraint,
                          const std::vector<std::vector<int>>& groups,
                          std::vector<ModalVector> vectors);

/// What is new in the columns of X (interior x columns), orthonormalised against the modal columns
/// of `basis`, becomes further modal columns of `kind`; their number. With `rotate`, all modal
/// columns become Ritz vectors of the larger span where the new ones are coupled with them by
/// stiffness; without, they are left as they are, and the basis is no longer `orthonormal`.
int appendVectors(const model::Substructure& part, const Matrix& X, const std::string& kind,
                  double tolerance, bool rotate, Basis& basis);

/// Modal columns of a basis on the interior.
Matrix modalColumns(const Basis& basis);

/// Dofs of the part for indices into Partition::interior.
std::vector<int> positionsOf(const Partition& partition, const std::vector<int>& interior);

/// Names of the dofs of the part at these positions, for messages.
linalg::DofNamer namer(const model::Substructure& part, std::vector<int> positions);

}  // namespace tooljoint::reduction
