// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static answers of the interior of a part while its kept dofs are held, also of interiors that
/// are still free to move then.
#pragma once

#include <memory>

#include "linalg/trilinos/DirectSolver.hpp"
#include "reduction/part/ConstraintModes.hpp"
#include "reduction/vectors/FreeInterfaceModes.hpp"

namespace tooljoint::reduction {

/// K_II^-1 of a part. Rigid-body modes of the free part that vanish on all kept dofs are mechanisms
/// N of the interior: then K_II is singular, and the self-equilibrated generalised inverse is taken
/// in its place,
///
///     [K_II  M_II N; N' M_II  0] (x, mu) = (f, 0):   x is M-orthogonal to N, and the part of f
///     that would move N is balanced by its inertia.
class InteriorStatics {
 public:
  /// Factors. ModelError, naming part and dof, when K_II is singular otherwise.
  /// \param K constantStiffness of the part
  InteriorStatics(const model::Substructure& part, const Partition& partition, const Sparse& K,
                  const FreeInterfaceModes& modes);

  /// Interior x columns of the loads.
  Matrix solve(const Matrix& loads) const;
  /// phi_C = -K_II^-1 K_IC with the full K, as reduction::constraintModes.
  ConstraintModes constraintModes() const;
  /// N, interior x mechanisms, M-orthonormal; usually without columns.
  const Matrix& mechanisms() const { return mechanisms_; }
  /// The other rigid-body modes of the free part, those that move kept dofs, dofs of the part x
  /// modes.
  const Matrix& carriers() const { return carriers_; }

 private:
  void findMechanisms(const FreeInterfaceModes& modes);
  void factor(const model::Substructure& part);

  Partition partition_;
  Sparse KII_, KIC_, MII_;
  Matrix mechanisms_, carriers_;
  std::unique_ptr<linalg::DirectSolver> solver_;
  Vector keptMass_;  ///< sqrt of the diagonal of M
};

/// A with dense borders: [A U; W' 0], U and W scaled to the size of A.
Sparse bordered(const Sparse& A, const Matrix& U, const Matrix& W);

}  // namespace tooljoint::reduction
