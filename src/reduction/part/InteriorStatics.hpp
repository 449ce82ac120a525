// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static responses of the interior of a part with fixed boundary dofs, also for interiors that are
/// mechanisms.
#pragma once

#include <memory>

#include "reduction/part/PartView.hpp"
#include "reduction/vectors/InteriorVectors.hpp"

namespace tooljoint::reduction {

/// K_II^-1 of a part. Rigid-body modes of the free part that vanish on all boundary dofs are
/// mechanisms N of the interior. K_II is then singular and is replaced by the self-equilibrated
/// generalised inverse,
///
///     [K_II  M_II N; N' M_II  0] (x, mu) = (f, 0):
///
/// x is M-orthogonal to N, and inertia balances the part of f that would move N.
class InteriorStatics {
 public:
  /// \param modes  freeInterfaceModes of the part
  /// ModelError with part and dof if K_II is singular for another reason.
  InteriorStatics(const PartView& part, const InteriorVectors& modes);

  /// Interior x columns of the loads.
  Matrix solve(const Matrix& loads) const;
  /// phi_C = -K_II^-1 K_IC with the full K, as reduction::constraintModes.
  ConstraintModes constraintModes() const;
  /// N, interior x mechanisms, M-orthonormal; usually without columns.
  const Matrix& mechanisms() const { return mechanisms_; }
  /// The other rigid-body modes of the free part, which move boundary dofs; dofs of the part x
  /// modes.
  const Matrix& carriers() const { return carriers_; }

 private:
  void findMechanisms(const InteriorVectors& modes);
  void factor();

  PartView part_;
  Matrix mechanisms_, carriers_;
  std::unique_ptr<linalg::DirectSolver> solver_;  ///< with mechanisms; otherwise the solver of the
                                                  ///< part is used
};

/// Zero-energy modes of a block that touches no boundary dof, mass-orthonormal. Empty if the block
/// does not float.
Matrix floatingModes(const InteriorBlock& block);

/// A with dense borders: [A U; W' 0], with U and W scaled to the size of A.
Sparse bordered(const Sparse& A, const Matrix& U, const Matrix& W);

}  // namespace tooljoint::reduction
