// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Dynamic stiffness of a linear model, for harmonic responses and single damped modes.
#pragma once

#include <Eigen/SparseLU>
#include <complex>
#include <optional>

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// Factored Q(s) = s^2 M + s C + K; real square matrices of equal size. Rows and columns are
/// equilibrated first, because pivots are chosen among entries of translations, rotations, modal
/// amplitudes and massless dofs, whose sizes are not comparable.
class DynamicStiffness {
 public:
  DynamicStiffness(const Sparse& M, const Sparse& C, const Sparse& K, std::complex<double> s);

  /// Q(s) is singular: s is an eigenvalue to the last digit.
  bool singular() const { return factors_.info() != Eigen::Success; }
  /// Q(s)^-1 f, column by column.
  Eigen::MatrixXcd solve(const Eigen::MatrixXcd& f) const;
  /// log |det Q(s)|.
  double logDeterminant() const;
  /// Q(s)^-T c, transposed and not conjugated: the adjoint of an output c'x.
  Eigen::MatrixXcd solveTransposed(const Eigen::MatrixXcd& c);

 private:
  using ComplexSparse = Eigen::SparseMatrix<std::complex<double>, Eigen::ColMajor, int>;
  void equilibrate(const ComplexSparse& Q);

  Eigen::SparseLU<ComplexSparse> factors_;  ///< of R Q S
  Vector rows_, columns_;                   ///< R, S; powers of two
};

/// A mode of (s^2 M + s C + K) phi = 0.
struct DampedMode {
  std::complex<double> s;  ///< [1/s]
  Eigen::VectorXcd shape;
};

/// The mode to which Newton's method for Q(s) phi = 0, e_k'phi = 1 converges from a guess
/// (nonlinear inverse iteration; A. Ruhe, SIAM J. Numer. Anal. 10 (1973) 674-689):
///
///     y = Q(s)^-1 Q'(s) phi,   s <- s - phi_k / y_k
///
/// to a relative change of s of 1e-9. Empty if it does not converge.
std::optional<DampedMode> refine(const Sparse& M, const Sparse& C, const Sparse& K,
                                 DampedMode guess);

}  // namespace tooljoint::linalg
