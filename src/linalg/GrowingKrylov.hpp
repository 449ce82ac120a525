// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Block Krylov space of an unsymmetric operator, real or complex. It grows until it contains the
/// wanted eigenvalues and is never restarted.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// Ritz pairs A z = nu z, |z| = 1.
struct RitzPairs {
  Eigen::VectorXcd values;        ///< nu; a real operator has exact conjugate pairs
  Eigen::MatrixXcd coefficients;  ///< c in the directions of the space: z = V c
  Vector residuals;               ///< |A z - nu z| / |nu|
};

/// Block Arnoldi with full orthogonalisation. Repeated eigenvalues and Jordan chains need no
/// special treatment, because nothing is discarded and no Schur form is reordered. A restart (G. W.
/// Stewart, SIAM J. Matrix Anal. Appl. 23 (2002) 601-614) would have to split the spectrum, which
/// is impossible between equal values. A space from one block contains at most as many copies of a
/// repeated eigenvalue as the block has columns; startBeside() adds others.
/// \tparam Scalar  double or std::complex<double>
template <class Scalar>
class GrowingKrylov {
 public:
  using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Operator = std::function<Block(const Block&)>;

  GrowingKrylov(Operator apply, int size);
  /// Starts with a block of scattered directions.
  void start(int columns, std::uint64_t seed);
  /// Starts with all directions.
  void startWhole();
  /// Adds a block of scattered directions, orthogonal to all present ones. It is continued before
  /// the others.
  void startBeside(int columns, std::uint64_t seed);
  /// Applies the operator until it has been applied to `columns` directions, or the space is
  /// invariant.
  void grow(int columns);
  /// No direction is left to which the operator must be applied.
  bool invariant() const { return open_.empty(); }
  RitzPairs ritz() const;
  /// z = V c of the j-th pair; the space must not have grown since ritz().
  Eigen::VectorXcd vector(const RitzPairs& pairs, Eigen::Index j) const;

 private:
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Orthogonalises w and returns the position of the new direction, -1 if the remainder is
  /// rounding of `size`. Its coefficients are returned in `h`.
  int append(Column w, double size, Column& h);
  void add(const Block& columns);
  void step();

  Operator apply_;
  int size_;
  int count_ = 0;         ///< directions
  Block directions_;      ///< orthonormal, size x (at least count)
  Block projected_;       ///< h_ij = v_i^H A v_j, for the directions j with the operator applied
  std::deque<int> open_;  ///< directions without it, in order
  std::vector<int> done_;
  int width_ = 1;  ///< of a block
};

}  // namespace tooljoint::linalg
