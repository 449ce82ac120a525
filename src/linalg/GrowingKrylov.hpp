// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A block Krylov space of an unsymmetric operator, real or complex, that grows until it holds the
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
  Eigen::VectorXcd values;        ///< nu; of a real operator conjugate pairs exactly
  Eigen::MatrixXcd coefficients;  ///< c, of the directions of the space: z = V c
  Vector residuals;               ///< |A z - nu z| / |nu|
};

/// Block Arnoldi with full orthogonalisation. Nothing is thrown away and no Schur form is
/// reordered, so repeated eigenvalues and Jordan chains need no care: restarts (G. W. Stewart, SIAM
/// J. Matrix Anal. Appl. 23 (2002) 601-614) have to part a spectrum, which equal values do not
/// allow. A space from one block holds at most as many copies of a repeated eigenvalue as the block
/// has columns; startBeside() adds others.
/// \tparam Scalar  double or std::complex<double>
template <class Scalar>
class GrowingKrylov {
 public:
  using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;
  using Operator = std::function<Block(const Block&)>;

  GrowingKrylov(Operator apply, int size);
  /// A block of scattered directions.
  void start(int columns, std::uint64_t seed);
  /// Every direction.
  void startWhole();
  /// Another block of scattered directions, orthogonal to all there are, which grows before the
  /// others do.
  void startBeside(int columns, std::uint64_t seed);
  /// Applies the operator until it has been applied to `columns` directions, or the space is
  /// invariant.
  void grow(int columns);
  /// Nothing is left to apply the operator to.
  bool invariant() const { return open_.empty(); }
  RitzPairs ritz() const;
  /// z = V c of the j-th pair, of pairs found since the space has grown.
  Eigen::VectorXcd vector(const RitzPairs& pairs, Eigen::Index j) const;

 private:
  using Column = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;

  /// Orthogonalises; the position of the new direction, -1 when there is none beyond rounding of
  /// `size`. Its coefficients go into `h`.
  int append(Column w, double size, Column& h);
  void add(const Block& columns);
  void step();

  Operator apply_;
  int size_;
  int count_ = 0;         ///< directions
  Block directions_;      ///< orthonormal, size x (at least count)
  Block projected_;       ///< h_ij = v_i^H A v_j, for the directions j that the operator has been
                          ///< applied to
  std::deque<int> open_;  ///< directions it has not been applied to, in order
  std::vector<int> done_;
  int width_ = 1;  ///< of a block
};

}  // namespace tooljoint::linalg
