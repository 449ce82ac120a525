// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Block elimination of a part along its tree of substructures: K + tau M = L D L' with a block of
/// D for every substructure and separator.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "linalg/DenseKernels.hpp"
#include "linalg/factor/PartialFactor.hpp"
#include "reduction/multilevel/SubstructureTree.hpp"

namespace tooljoint::reduction {

/// A piece of the tree after the elimination of its subtree, with the dofs j of the piece, its
/// boundary b, and the Schur complement K of its subtree.
struct EliminatedPiece {
  linalg::PartialFactor sparse;  ///< of K_jj of a leaf
  Sparse coupling;               ///< K_jb of a leaf
  linalg::DenseCholesky dense;   ///< of K_jj of a separator
  Matrix static_;                ///< K_jj^-1 K_jb of a separator
  Matrix condensedMass;          ///< of a separator: dK_jj / dtau, its mass after condensation
  Sparse mass, massCoupling;     ///< M_jj, M_jb of the part
};

/// The elimination is distributed according to the tree. Collective: every rank passes the same.
class TreeFactor {
 public:
  /// Eliminates K + shift M, and K + (shift + step) M for the condensed masses, by a difference of
  /// Schur complements. K and M are symmetric, and K must outlive this object. ModelError for
  /// errors of MUMPS.
  TreeFactor(std::shared_ptr<const SubstructureTree> tree, const Sparse& K, const Sparse& M,
             double shift, double step);

  /// True if K + shift M is positive definite to working precision; otherwise nothing else may be
  /// called.
  bool definite() const { return definite_; }
  double shift() const { return shift_; }
  const SubstructureTree& tree() const { return *tree_; }
  /// A piece of this rank.
  const EliminatedPiece& piece(int number) const { return pieces_[at(number)]; }

  /// K_jj^-1 B of a piece of this rank.
  Matrix solvePiece(int number, const Matrix& B) const;
  /// K_jj of a piece of this rank, dense.
  Matrix denseStiffness(int number) const;
  /// -K_jj^-1 K_jb X_b of a piece of this rank: its static shape for a motion of its boundary.
  Matrix staticShape(int number, const Matrix& boundary) const;

  /// (K + shift M)^-1 B; every rank passes and gets all rows. Collective.
  Matrix solve(const Matrix& B) const;

  /// Sends the rows of X at the dofs of a piece from the ranks that own them to all ranks.
  /// Collective.
  void gather(Matrix& X) const;

 private:
  struct Update;
  bool eliminate(int number, const Sparse& K, const Sparse& M, double step,
                 std::vector<Update>& updates);
  bool eliminateLeaf(int number, const Sparse& K, double step, Update& update);
  bool eliminateSeparator(int number, const Sparse& K, const Sparse& M, double step,
                          std::vector<Update>& updates);
  void forward(int number, Matrix& X) const;
  void backward(int number, Matrix& X) const;

  std::shared_ptr<const SubstructureTree> tree_;
  const Sparse& K_;
  double shift_;
  bool definite_ = true;
  std::vector<EliminatedPiece> pieces_;
};

}  // namespace tooljoint::reduction
