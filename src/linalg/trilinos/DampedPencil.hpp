// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the ways to damped modes share: the scaled matrices of s^2 M + s C + K, and what is done
/// with pairs that were found. Included by sources of damped modes only.
#pragma once

#include <complex>
#include <optional>
#include <vector>

#include "linalg/ComplexProduct.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"

namespace tooljoint::linalg {

/// Relative error of s - sigma, sigma the shift, that is accepted beside the rounding of K: the
/// last of the eight digits that are printed. Values of a Krylov space that has converged are
/// better by some orders; what is above this bound is not rounding but a space that is too small.
inline constexpr double acceptedError = 1e-8;
/// Columns of a start block: as many as a free body in space has rigid-body motions, and two more.
inline constexpr int startColumns = 8;
/// Block steps after a second start, which finds what the first one missed.
inline constexpr int controlSteps = 5;
/// Up to this size the inverse is formed whole.
inline constexpr int denseBelow = 80;

/// M, C and K with rows and columns scaled by powers of two near 1 / sqrt(M_ii): translations,
/// rotations and modal amplitudes become comparable, and no entry is rounded.
struct ScaledPencil {
  Sparse M, C, K;
  Vector scale;
  bool singularMass = false;
  EnergyRounding rounding;  ///< of shapes in scaled coordinates

  /// ModelError: the matrices are not square and of one size. \param given isRounding's bound for K
  /// where empty
  ScaledPencil(const Sparse& m, const Sparse& c, const Sparse& k, const EnergyRounding& given);
  ScaledPencil(const ScaledPencil&) = delete;
  ScaledPencil& operator=(const ScaledPencil&) = delete;
  Eigen::Index size() const { return M.rows(); }
};

/// Values s with Im s >= 0 and scaled vectors.
struct DampedModes {
  std::vector<Complex> values;
  std::vector<ComplexVector> vectors;
};

/// |s| at which s is zero but for the rounding of K: |s|^2 phi'|M|phi + |s| phi'|C|phi of the size
/// of what rounding leaves of phi'K phi.
bool isZero(const ScaledPencil& pencil, Complex s, const ComplexVector& phi);

/// What rounding of K makes of s - shift, relative.
double roundingOfValue(const ScaledPencil& pencil, Complex distance, const ComplexVector& phi);

/// The mode that Newton's method finds from a pair far from the shift, where (L - sigma)^-1 has few
/// digits of it; none where that is another one.
std::optional<DampedMode> refinedMode(const ScaledPencil& pencil, Complex s,
                                      const ComplexVector& phi);

/// The first `count` of them by |s|, in the coordinates of the unscaled matrices, with residuals.
QuadraticModes presented(const ScaledPencil& pencil, const DampedModes& found, int count);

}  // namespace tooljoint::linalg
