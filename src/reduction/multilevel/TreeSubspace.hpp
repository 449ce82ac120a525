// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The subspace of automated multilevel substructuring (J. K. Bennighof and R. B. Lehoucq, SIAM J.
/// Sci. Comput. 25 (2004) 2084-2106): fixed-interface modes of the substructures, and interface
/// modes of the separators with their static shapes in the subtrees below.
#pragma once

#include <vector>

#include "linalg/InverseLanczos.hpp"
#include "reduction/multilevel/TreeFactor.hpp"

namespace tooljoint::reduction {

/// Columns T of the subspace by piece; T' (K + shift M) T = 1 because the elimination decouples the
/// pieces. All functions are collective.
class TreeSubspace {
 public:
  explicit TreeSubspace(const TreeFactor& factor);

  /// Takes the lowest `count` modes of each piece.
  void takeLowest(int count);
  /// Takes all modes of each piece with lambda + shift below `bound`.
  void takeBelow(double bound);

  int size() const { return size_; }
  /// True if every piece has all of its modes.
  bool complete() const { return complete_; }
  /// Ritz vectors y of T'MT y = y / (lambda + shift), y'y = 1.
  linalg::RitzVectors ritz(const linalg::RitzRequest& request) const;
  /// T Y, all dofs on every rank, from the modes of the pieces and the factors.
  Matrix recover(const Matrix& Y) const;

 private:
  void take(const linalg::RitzRequest& request);
  void number();
  Matrix projectedMass() const;
  std::vector<int> columnsAbove(int piece) const;
  Matrix onBoundary(int piece, const std::vector<Matrix>& shapes, Eigen::Index columns) const;

  const TreeFactor& factor_;
  std::vector<linalg::RitzVectors> modes_;  ///< of the pieces of this rank
  std::vector<int> count_, first_;          ///< columns of every piece
  int size_ = 0;
  bool complete_ = false;
  Matrix mass_;  ///< T'MT
};

}  // namespace tooljoint::reduction
