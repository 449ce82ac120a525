// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Common parts of the solvers for damped modes: the scaled matrices of s^2 M + s C + K, and the
/// treatment of found pairs. Included only by sources of damped modes.
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

/// Accepted relative error of s - sigma, with sigma the shift, in addition to the rounding of K:
/// the last of the eight printed digits. Values of a converged Krylov space are better by some
/// orders; an error above this bound is not rounding but means that the space is too small.
inline constexpr double acceptedError = 1e-8;
/// Columns of a start block: the six rigid-body motions of a free body in space, and two more.
inline constexpr int startColumns = 8;
/// Block steps after a second start, which finds values missed by the first one.
inline constexpr int controlSteps = 5;
/// Up to this size the whole inverse is formed.
inline constexpr int denseBelow = 80;

/// M, C and K with rows and columns scaled by powers of two near 1 / sqrt(M_ii): translations,
/// rotations and modal amplitudes become comparable, and no entry is rounded.
struct ScaledPencil {
  Sparse M, C, K;
  Vector scale;
  bool singularMass = false;
  EnergyRounding rounding;  ///< of shapes in scaled coordinates

  /// ModelError: the matrices are not square or differ in size. \param given isRounding's bound for
  /// K if empty
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

/// Whether s is zero up to the rounding of K: |s|^2 phi'|M|phi + |s| phi'|C|phi is of the size of
/// the rounding of phi'K phi.
bool isZero(const ScaledPencil& pencil, Complex s, const ComplexVector& phi);

/// Relative error of s - shift due to rounding of K.
double roundingOfValue(const ScaledPencil& pencil, Complex distance, const ComplexVector& phi);

/// Mode found by Newton's method from a pair far from the shift, for which (L - sigma)^-1 has few
/// digits; empty if it converges to another mode.
std::optional<DampedMode> refinedMode(const ScaledPencil& pencil, Complex s,
                                      const ComplexVector& phi);

/// The `count` modes of smallest |s|, in the coordinates of the unscaled matrices, with residuals.
QuadraticModes presented(const ScaledPencil& pencil, const DampedModes& found, int count);

}  // namespace tooljoint::linalg
