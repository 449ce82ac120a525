// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Lowest modes of symmetric pencils K phi = lambda M phi, rank-local and the same in every run.
#pragma once

#include <complex>
#include <functional>
#include <optional>
#include <string>

#include "common/Types.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::linalg {

/// Modes in increasing order of lambda (negative values included), mass-normalised: Phi' M Phi = I.
/// The entry of largest magnitude of each mode is positive; the first one of several that agree to
/// 1e-6.
struct EigenPairs {
  Vector values;     ///< lambda, for mechanical models omega^2 [1/s^2]
  Matrix vectors;    ///< n x count
  Vector residuals;  ///< |K phi - lambda M phi| / (||K||phi|| + |lambda| ||M||phi||), recomputed
  double orthogonality = 0;  ///< max |Phi' M Phi - I|, recomputed
  std::string method;        ///< method of computation, for tables and reports

  int count() const { return static_cast<int>(values.size()); }
};

struct EigenOptions {
  double tolerance = 1e-8;  ///< largest accepted residual, and relative error of the shift-inverted
                            ///< operator
  double orthogonality = 1e-8;  ///< largest accepted |Phi' M Phi - I|
  bool keepPairs = false;  ///< add modes while the next eigenvalue is within pairTolerance of the
                           ///< last: never cut a pair
  double pairTolerance = 1e-6;  ///< relative distance of two eigenvalues of a pair
  int denseBelow = 200;  ///< smaller matrices are solved dense, and requests for more than a third
                         ///< of the modes
  std::optional<double>
      shift;  ///< shift below all eigenvalues; by default chosen from the matrices
  const DirectSolver* stiffness =
      nullptr;    ///< existing factors of K: used if a shift of zero is suitable
  DofNamer name;  ///< names of the dofs for messages
  const Teuchos::ParameterList* anasazi =
      nullptr;  ///< override the parameters of Anasazi::BlockKrylovSchurSolMgr
};

/// The `count` lowest modes of the symmetric K and the symmetric positive definite M (more with
/// keepPairs).
///
/// Large sparse pencils: Anasazi BlockKrylovSchur on (K - sigma M)^-1 M with sigma below the
/// spectrum, so K may be singular (free bodies) or indefinite (buckled parts). The eigenvalues
/// below the last gap are counted by Sylvester's law of inertia, so a missed mode is detected.
/// Small pencils or many modes: dense. ModelError: sizes differ, count > n, K or M unsymmetric or
/// not finite, M not positive definite (dof named). ConvergenceError: residuals, orthogonality or
/// count are not as required.
EigenPairs lowestModes(const Sparse& K, const Sparse& M, int count,
                       const EigenOptions& options = {});

/// All modes with lambda < omegaMax^2 (all negative ones too), possibly none; options and errors as
/// lowestModes.
EigenPairs lowestModesBelow(const Sparse& K, const Sparse& M, double omegaMax,
                            const EigenOptions& options = {});

/// Number of eigenvalues of K phi = lambda M phi below `bound` (Sylvester's law of inertia for K -
/// bound M). ConvergenceError if `bound` is one of them.
int eigenvaluesBelow(const Sparse& K, const Sparse& M, double bound);

/// Number of negative eigenvalues of the symmetric A; empty if no factors of it are stable. With
/// `All` ranks MUMPS divides its factors among them.
std::optional<int> negativeEigenvalues(Sparse A, parallel::Ranks ranks = parallel::Ranks::Own);

/// All modes of a dense symmetric pencil (Cholesky and tridiagonal QR). ModelError if M is not
/// positive definite.
EigenPairs symmetricModes(const Matrix& K, const Matrix& M, const DofNamer& name = {});

/// Modes of (s^2 M + s C + K) phi = 0 with C and K of any kind (gyroscopic, circulatory, damped).
struct QuadraticModes {
  Eigen::VectorXcd values;   ///< s [1/s], 2n values, by |Im s|, then Re s, then the negative
                             ///< imaginary part first
  Eigen::MatrixXcd vectors;  ///< phi, n x 2n, largest entry 1
  Vector residuals;  ///< |(s^2 M + s C + K) phi| / ((|s|^2 |M| + |s| |C| + |K|) |phi|), recomputed
};

/// Dense, by the linearised state-space problem; for whirl speeds and Campbell diagrams. M must be
/// invertible (ModelError). ConvergenceError if the QR iteration fails or a residual exceeds 1e-8.
QuadraticModes dampedModes(const Matrix& M, const Matrix& C, const Matrix& K);

/// Selection of damped modes: the `count` modes with the smallest |s - centre|, and all others with
/// |s - centre| <= radius.
struct DampedTarget {
  std::complex<double> centre;  ///< [1/s]; not zero, Im >= 0
  double radius = 0.0;          ///< [1/s]
  int count = 0;
};

/// Rounding error of phi^H K phi.
using EnergyRounding = std::function<double(const Eigen::VectorXcd& phi)>;

/// The `count` modes of smallest |s|, one of each conjugate pair (Im s >= 0), by |s|, or fewer if
/// there are fewer (an overdamped dof has two real values, so there are up to twice as many as
/// dofs; M may be singular). For proportional damping (or C = 0), symmetric K and positive definite
/// M they follow from lowestModes. Otherwise a block Arnoldi space of the inverse of the linearised
/// problem near zero is used (GrowingKrylov; the whole space for small models) and searched again
/// for further copies of repeated values. A mode with s zero up to rounding has s = 0 and is listed
/// once, although it is a double value without damping. \param rounding by default isRounding's
/// bound for K; a reduced model has that of its parts. Vectors as dampedModes; residuals are those
/// of the matrices scaled to unit masses. ConvergenceError if a value is not accurate to 1e-8, in
/// addition to the effect of rounding of K, or is not found. ModelError: sizes, K + sigma C +
/// sigma^2 M is singular.
QuadraticModes lowestDampedModes(const Sparse& M, const Sparse& C, const Sparse& K, int count,
                                 const DofNamer& name = {}, const EnergyRounding& rounding = {});

/// The modes of the target, one of each conjugate pair (Im s >= 0), by |s|, without those at zero.
/// A complex block Arnoldi space of (L - centre)^-1, with L the linearised problem, is used
/// (GrowingKrylov; the whole space for small models) and searched again for further copies of
/// repeated values. Nothing is computed beyond the target, so a few modes of a model of thousands
/// are found in the wanted range only. Vectors, residuals, accuracy and errors as
/// lowestDampedModes; ConvergenceError also if the target contains too many modes.
QuadraticModes dampedModesNear(const Sparse& M, const Sparse& C, const Sparse& K,
                               const DampedTarget& target, const EnergyRounding& rounding = {});

}  // namespace tooljoint::linalg
