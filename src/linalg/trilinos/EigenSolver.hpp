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
/// The entry of largest magnitude of each mode is positive; of several that agree to 1e-6, the
/// first.
struct EigenPairs {
  Vector values;     ///< lambda, for mechanical models omega^2 [1/s^2]
  Matrix vectors;    ///< n x count
  Vector residuals;  ///< |K phi - lambda M phi| / (||K||phi|| + |lambda| ||M||phi||), recomputed
  double orthogonality = 0;  ///< max |Phi' M Phi - I|, recomputed
  std::string method;        ///< how they were computed, for tables and reports

  int count() const { return static_cast<int>(values.size()); }
};

struct EigenOptions {
  double tolerance = 1e-8;  ///< largest residual, and largest relative error of the shift-inverted
                            ///< operator, accepted
  double orthogonality = 1e-8;  ///< largest |Phi' M Phi - I| accepted
  bool keepPairs = false;  ///< add modes while the next eigenvalue is within pairTolerance of the
                           ///< last: never cut a pair
  double pairTolerance = 1e-6;  ///< relative distance of two eigenvalues of a pair
  int denseBelow = 200;  ///< matrices smaller than this are solved dense, as are requests for more
                         ///< than a third of the modes
  std::optional<double>
      shift;  ///< shift below all eigenvalues; chosen from the matrices when absent
  const DirectSolver* stiffness =
      nullptr;    ///< factors of K, where they exist already: taken where a shift of zero serves
  DofNamer name;  ///< names of the dofs for messages
  const Teuchos::ParameterList* anasazi =
      nullptr;  ///< laid over the parameters of Anasazi::BlockKrylovSchurSolMgr
};

/// The `count` lowest modes of the symmetric K and the symmetric positive definite M (more with
/// keepPairs).
///
/// Large sparse pencils: Anasazi BlockKrylovSchur on (K - sigma M)^-1 M with sigma below the
/// spectrum, so singular K (free bodies) and indefinite K (buckled parts) are allowed; the number
/// of eigenvalues below the last gap is counted by Sylvester's law of inertia, so a missed mode is
/// found. Small pencils or many modes: dense. ModelError: sizes differ, count > n, K or M
/// unsymmetric or not finite, M not positive definite (dof named). ConvergenceError: the residuals,
/// the orthogonality or the count are not as requested.
EigenPairs lowestModes(const Sparse& K, const Sparse& M, int count,
                       const EigenOptions& options = {});

/// All modes with lambda < omegaMax^2 (all negative ones too), possibly none; options and errors as
/// lowestModes.
EigenPairs lowestModesBelow(const Sparse& K, const Sparse& M, double omegaMax,
                            const EigenOptions& options = {});

/// Number of eigenvalues of K phi = lambda M phi below `bound` (Sylvester's law of inertia on K -
/// bound M). ConvergenceError where `bound` is one of them.
int eigenvaluesBelow(const Sparse& K, const Sparse& M, double bound);

/// Number of negative eigenvalues of the symmetric A; none where no factors of it are stable. `All`
/// ranks: MUMPS divides its factors among them.
std::optional<int> negativeEigenvalues(Sparse A, parallel::Ranks ranks = parallel::Ranks::Own);

/// All modes of a dense symmetric pencil (Cholesky and tridiagonal QR). ModelError when M is not
/// positive definite.
EigenPairs symmetricModes(const Matrix& K, const Matrix& M, const DofNamer& name = {});

/// Modes of (s^2 M + s C + K) phi = 0 with C and K of any kind (gyroscopic, circulatory, damped).
struct QuadraticModes {
  Eigen::VectorXcd values;   ///< s [1/s], 2n of them, by |Im s|, then Re s, then the negative
                             ///< imaginary part first
  Eigen::MatrixXcd vectors;  ///< phi, n x 2n, largest entry 1
  Vector residuals;  ///< |(s^2 M + s C + K) phi| / ((|s|^2 |M| + |s| |C| + |K|) |phi|), recomputed
};

/// Dense, through the linearised state-space problem; for whirl speeds and Campbell diagrams. M
/// must be invertible (ModelError). ConvergenceError when the QR iteration fails or a residual
/// exceeds 1e-8.
QuadraticModes dampedModes(const Matrix& M, const Matrix& C, const Matrix& K);

/// Which damped modes: the `count` ones with the smallest |s - centre|, and all others with
/// |s - centre| <= radius.
struct DampedTarget {
  std::complex<double> centre;  ///< [1/s]; not zero, Im >= 0
  double radius = 0.0;          ///< [1/s]
  int count = 0;
};

/// What rounding leaves of phi^H K phi.
using EnergyRounding = std::function<double(const Eigen::VectorXcd& phi)>;

/// The `count` modes of smallest |s|, one of each conjugate pair (Im s >= 0), by |s|, fewer when
/// there are fewer (what does not vibrate has two real ones a dof: up to twice as many as dofs; M
/// may be singular). Where C = 0, K is symmetric and M is positive
/// definite, those of lowestModes. Else a block Arnoldi space of the inverse of the linearised
/// problem near zero (GrowingKrylov; small ones whole), which is searched again for further copies
/// of repeated values. A mode whose s is zero but for rounding has s = 0 and is listed once, though
/// it is a double value where nothing damps it. \param rounding by default isRounding's bound for
/// K; a reduced model has that of its parts Vectors as dampedModes; residuals those of the matrices
/// scaled to unit masses. ConvergenceError when a value is not accurate to 1e-9, beside what the
/// rounding of K does to it, or is not found. ModelError: sizes, K + sigma C + sigma^2 M is
/// singular.
QuadraticModes lowestDampedModes(const Sparse& M, const Sparse& C, const Sparse& K, int count,
                                 const DofNamer& name = {}, const EnergyRounding& rounding = {});

/// The modes of the target, one of each conjugate pair (Im s >= 0), by |s|, without those at zero:
/// a complex block Arnoldi space of (L - centre)^-1, L the linearised problem (GrowingKrylov; small
/// ones whole), which is searched again for further copies of repeated values. Beyond the target
/// nothing is computed, so that a few modes of a model of thousands are found where they are
/// wanted. Vectors, residuals, accuracy and errors as lowestDampedModes; ConvergenceError also
/// where the target holds too many modes.
QuadraticModes dampedModesNear(const Sparse& M, const Sparse& C, const Sparse& K,
                               const DampedTarget& target, const EnergyRounding& rounding = {});

}  // namespace tooljoint::linalg
