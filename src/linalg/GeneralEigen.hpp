// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Eigenvalues of dense unsymmetric matrices: real ones by LAPACK (Teuchos), which uses blocks,
/// complex ones by Eigen (Debian's Teuchos has no complex numbers).
#pragma once

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// A x = lambda x, |x| = 1, unordered; a real A has exact conjugate pairs.
struct GeneralPairs {
  Eigen::VectorXcd values;
  Eigen::MatrixXcd vectors;
  bool converged = true;  ///< of the QR iteration
};
GeneralPairs generalPairs(Matrix A);
GeneralPairs generalPairs(const Eigen::MatrixXcd& A);

}  // namespace tooljoint::linalg
