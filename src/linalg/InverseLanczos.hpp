// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Ritz vectors of symmetric pencils for a subspace, where one vector more or less does no harm:
/// block Lanczos iteration without the checks of lowestModes.
#pragma once

#include <functional>
#include <limits>

#include "common/Types.hpp"

namespace tooljoint::linalg {

/// K phi = lambda M phi with K positive definite and M positive semi-definite, defined by the
/// operations with the matrices.
struct InversePencil {
  int size = 0;
  std::function<Matrix(const Matrix&)> solve;  ///< K^-1 B
  std::function<Matrix(const Matrix&)> mass;   ///< M X
  std::function<Matrix()> stiffness;           ///< K, for small pencils
};

struct RitzRequest {
  int count = std::numeric_limits<int>::max();             ///< this many of the lowest
  double below = std::numeric_limits<double>::infinity();  ///< only those below this
  double tolerance = 1e-6;                                 ///< |M phi / lambda - K phi| in K^-1
};

struct RitzVectors {
  Vector values;          ///< lambda, increasing
  Matrix vectors;         ///< phi' K phi = 1, phi' M phi = 1 / lambda
  bool complete = false;  ///< all finite lambda are included
};

/// Block Lanczos with the operator K^-1 M, in the inner product of K and with full
/// orthogonalisation (the Rayleigh quotient of K and M is exact on the vectors, converged or not).
/// Small pencils use a dense method. The same in every run.
RitzVectors lowestRitzVectors(const InversePencil& pencil, const RitzRequest& request);

}  // namespace tooljoint::linalg
