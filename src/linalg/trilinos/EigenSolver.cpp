// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/EigenSolver.hpp"

#include <AnasaziBasicEigenproblem.hpp>
#include <AnasaziBlockKrylovSchurSolMgr.hpp>
#include <AnasaziTpetraAdapter.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/chains/DividedSolves.hpp"
#include "linalg/trilinos/DividedModes.hpp"
#include "linalg/trilinos/EigenChecks.hpp"
#include "linalg/trilinos/FunctionOperator.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "linalg/trilinos/TpetraConversion.hpp"

namespace tooljoint::linalg {

namespace {

using constants::epsilon;
/// Residual of the iteration as a part of the requested accuracy. The rounding of long strings, eps
/// times the ratio of the largest and the lowest eigenvalue, does not allow much less.
constexpr double iterationShare = 1e-4;

/// An eigenvalue below this part of the largest is too close to zero for a shift of zero.
constexpr double wellAboveZero = 1e-10;

/// A dof is light if the ratio of K_ii to the pivot of its mass is more than this many times the
/// median ratio. Light dofs cause the largest eigenvalues, whose rounding affects the lowest ones.
constexpr double lightDof = 1e6;

double median(Vector values) {
  if (values.size() == 0) return 0.0;
  const auto middle = values.begin() + values.size() / 2;
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

/// A checked symmetric pencil with derived data; k and m must outlive it.
struct Pencil {
  std::shared_ptr<const Sparse> symmetricK, symmetricM;
  const Sparse &K, &M;
  double middle = 0;      ///< median of K_ii over the pivots of M
  double scale = 0;       ///< lower bound of the largest eigenvalue, without light dofs
  bool hasLight = false;  ///< some dofs are light
  std::shared_ptr<const ChainShare> share;  ///< for products and solves on this rank; null: none

  Pencil(const Sparse& k, const Sparse& m, const DofNamer& name)
      : symmetricK(sharedSymmetricPart(k, "stiffness", name)),
        symmetricM(sharedSymmetricPart(m, "mass", name)),
        K(*symmetricK),
        M(*symmetricM) {
    if (K.rows() != M.rows())
      throw ModelError("The stiffness and mass matrices of an eigenproblem have " +
                       std::to_string(K.rows()) + " and " + std::to_string(M.rows()) +
                       " rows: they must agree.");
    const Vector ratios = K.diagonal().cwiseAbs().cwiseQuotient(definitePivots(M, name));
    middle = median(ratios);
    scale = eigenvalueScale(K, M);
    hasLight = middle > 0.0 && ratios.maxCoeff() > lightDof * middle;
    if (hasLight) scale = std::min(scale, lightDof * middle);
  }
  int size() const { return static_cast<int>(K.rows()); }
  int below(double bound) const { return eigenvaluesBelow(K, M, bound); }
};

/// A shift below all eigenvalues: zero if the lowest is well above it. Otherwise about minus the
/// first elastic eigenvalue (a shift closer to the rigid-body modes would make the others
/// inaccurate), or lower for an indefinite K.
double shiftBelowSpectrum(const Pencil& pencil, const EigenOptions& options) {
  if (options.shift) {
    const int below = pencil.below(*options.shift);
    if (below > 0)
      throw ModelError("The eigenvalue shift " + scientific(*options.shift) + " lies above " +
                       std::to_string(below) + " eigenvalue(s): give a lower one, or none.");
    return *options.shift;
  }
  const double floor = wellAboveZero * pencil.scale;
  if (floor == 0.0) return -1.0;  // K = 0
  const int low = pencil.below(floor);
  if (low == 0) return 0.0;
  double size = floor;
  while (size < pencil.scale && pencil.below(10.0 * size) == low) size *= 10.0;
  while (pencil.below(-size) > 0) size *= 3.0;
  return -size;
}

/// Minus the upper end of the widest gap between the positive eigenvalues, if few of them are far
/// below all others, as for a stiff body on soft mounts: with a shift of zero they would leave the
/// others no digits. Empty if there is no such gap.
std::optional<double> shiftBesideLowest(const Pencil& pencil, int wanted) {
  constexpr int fewest = 3;  // decades of a gap
  int before = 0, wide = 0, widest = 0;
  double end = 0;
  for (double bound = wellAboveZero * pencil.scale; bound < pencil.scale; bound *= 10.0) {
    const int count = pencil.below(bound);
    if (count >= wanted) break;
    wide = count > 0 && count == before ? wide + 1 : 0;
    if (wide > widest) widest = wide, end = bound;
    before = count;
  }
  return widest < fewest ? std::nullopt : std::optional<double>(-end);
}

/// Parameters of one attempt. A restart of BlockKrylovSchur may split a pair of equal eigenvalues
/// that rounding made complex in the projected problem, and then fails. Later attempts have larger
/// blocks and bases, so large that they need no restart.
Teuchos::ParameterList solverParameters(const Pencil& pencil, int wanted, int attempt,
                                        const EigenOptions& options) {
  const int n = pencil.size();
  Teuchos::ParameterList list;
  int block = attempt == 0 ? 4 : 8;
  if (options.anasazi != nullptr && options.anasazi->isType<int>("Block Size"))
    block = std::max(1, options.anasazi->get<int>("Block Size"));
  const int basis = (attempt + 1) * std::max(2 * wanted, wanted + 20) + (attempt > 0 ? 100 : 0);
  const int blocks = std::min(n / block - 1, (basis + block - 1) / block);
  list.set("Which", "LM");
  list.set("Block Size", block);
  list.set("Num Blocks", blocks);
  list.set("Maximum Restarts", 100);
  if (attempt > 0) list.set("Step Size", std::max(1, blocks / 4));
  list.set("Convergence Tolerance", std::max(1e-12, iterationShare * options.tolerance));
  list.set("Verbosity", 0);
  if (options.anasazi != nullptr) list.setParameters(*options.anasazi);
  return list;
}

/// x'A x for every column.
Vector energies(const Sparse& A, const Matrix& X) {
  return X.cwiseProduct(product(A, X)).colwise().sum().transpose();
}

/// |x|'|A||x| for every column.
Vector absoluteEnergies(const Sparse& A, const Matrix& X) {
  return X.cwiseAbs().cwiseProduct(absoluteProduct(A, X)).colwise().sum().transpose();
}

/// Factors of K - sigma M: those of the options, or own ones. Own factors are released while other
/// data of their size are computed, and computed again on demand.
class ShiftedFactors {
 public:
  ShiftedFactors(const Pencil& pencil, const DirectSolver& given)
      : pencil_(pencil), given_(&given) {}
  ShiftedFactors(const Pencil& pencil, double shift, DofNamer name)
      : pencil_(pencil), shift_(shift), name_(std::move(name)) {}

  double shift() const { return shift_; }
  /// (K - sigma M)^-1 M x. \param refine also refines and checks
  Matrix solveMass(const Matrix& x, bool refine) {
    stopIfInterrupted();
    if (divided() != nullptr)
      if (auto y = divided()->solve(divided()->ownRows(pencil_.M, x))) return std::move(*y);
    const Matrix load = product(pencil_.M, x);
    return refine ? get().solve(load) : get().apply(load);
  }
  /// M x.
  Matrix mass(const Matrix& x) {
    return divided() != nullptr ? divided()->multiply(pencil_.M, x) : product(pencil_.M, x);
  }
  /// Whether the factors are those of a large matrix, whose solutions are not refined at first.
  bool areLarge() { return divided() == nullptr && get().negativeEigenvalues().has_value(); }
  const DirectSolver& get() {
    if (given_ != nullptr) return *given_;
    if (!own_) {
      const Stage stage("factorisation for modes");
      own_ = std::make_unique<DirectSolver>(Sparse(pencil_.K - shift_ * pencil_.M), name_);
    }
    return *own_;
  }
  void makeRoom() {
    if (own_ && own_->negativeEigenvalues().has_value()) own_.reset();  // for a large matrix
  }

 private:
  /// Factors shared by the ranks; null if there are none.
  const DividedSolves* divided() {
    if (given_ == nullptr && pencil_.share && !triedToDivide_) {
      const Stage stage("factorisation for modes");
      divided_ = DividedSolves::of(pencil_.share, Sparse(pencil_.K - shift_ * pencil_.M));
      triedToDivide_ = true;
    }
    return divided_.get();
  }

  const Pencil& pencil_;
  const DirectSolver* given_ = nullptr;
  double shift_ = 0.0;
  DofNamer name_;
  std::unique_ptr<DirectSolver> own_;
  std::unique_ptr<DividedSolves> divided_;
  bool triedToDivide_ = false;
};

/// |phi - (lambda - sigma) (K - sigma M)^-1 M phi|_M per mode: a bound of the relative error of
/// lambda - sigma.
void requireAccurate(const EigenPairs& modes, const Pencil& pencil, ShiftedFactors& factors,
                     double tolerance) {
  const double shift = factors.shift();
  const Vector above = modes.values.array() - shift;
  const Matrix errors = modes.vectors - factors.solveMass(modes.vectors, true) * above.asDiagonal();
  const Vector sizes = energies(pencil.M, errors).cwiseMax(0.0).cwiseSqrt(),
               stiffness = absoluteEnergies(pencil.K, modes.vectors);
  for (int j = 0; j < modes.count(); ++j) {
    // Rounding of the lowest mode in this one, eps nu_1 / nu_j, and the effect of rounding of K on
    // lambda - sigma.
    const double rounding =
        1e3 * epsilon * above[j] / above[0] + 4.0 * epsilon * stiffness[j] / above[j];
    if (!(sizes[j] <= tolerance + rounding))
      throw ConvergenceError("Mode " + std::to_string(j + 1) + " (" + modes.method +
                             ") was called converged, but its relative error is " +
                             scientific(sizes[j]) + " where " + scientific(tolerance) +
                             " is allowed");
  }
}

/// Eigenvalues from the shift-inverted values nu or from the Rayleigh quotients, whichever have
/// less rounding.
Vector bestValues(const Vector& nu, double shift, const Matrix& shapes, const Pencil& pencil) {
  const Vector mass = energies(pencil.M, shapes),
               quotients = energies(pencil.K, shapes).cwiseQuotient(mass),
               roundings = absoluteEnergies(pencil.K, shapes).cwiseQuotient(mass);
  const double nuMax = nu.cwiseAbs().maxCoeff();
  Vector values(nu.size());
  for (Eigen::Index j = 0; j < nu.size(); ++j) {
    const double invertedRounding = std::abs(nuMax / nu[j]) * std::abs(1.0 / nu[j]);
    values[j] = invertedRounding < roundings[j] ? shift + 1.0 / nu[j] : quotients[j];
  }
  return values;
}

/// One step of subspace iteration for the upper modes. The Krylov basis leaves rounding of eps nu_1
/// / nu_j in mode j, most of it in directions far above the wanted spectrum. An inverse iteration
/// removes these, a projection onto the complement of the lower modes removes the components it
/// amplifies there, and Rayleigh-Ritz with K separates the rest.
void polishUpperModes(EigenPairs& modes, const Pencil& pencil, ShiftedFactors& factors) {
  const double shift = factors.shift();
  const int count = modes.count();
  const double split = std::sqrt((modes.values[0] - shift) * (modes.values[count - 1] - shift));
  int first = 0;
  while (first < count && modes.values[first] - shift <= split) ++first;
  const int upper = count - first;
  if (upper < 2) return;
  Matrix phi = factors.solveMass(modes.vectors.rightCols(upper), true);
  const Matrix lower = modes.vectors.leftCols(first), massLower = pencil.M * lower;
  phi -= lower * (massLower.transpose() * phi);
  phi = phi * energies(pencil.M, phi).cwiseSqrt().cwiseInverse().asDiagonal();
  phi -= lower * (massLower.transpose() * phi);
  const Matrix K = phi.transpose() * product(pencil.K, phi),
               M = phi.transpose() * product(pencil.M, phi);
  const EigenPairs ritz = symmetricModes(0.5 * (K + K.transpose()), 0.5 * (M + M.transpose()));
  modes.vectors.rightCols(upper) = phi * ritz.vectors;
  modes.values.tail(upper) = ritz.values;
}

/// The `wanted` modes closest above the shift, by Anasazi. ConvergenceError if it does not
/// converge.
EigenPairs krylovSchur(const Pencil& pencil, ShiftedFactors& factors, int wanted, int attempt,
                       const EigenOptions& options) {
  const double shift = factors.shift();
  using Problem = Anasazi::BasicEigenproblem<double, tpetra::MultiVector, tpetra::Operator>;
  using Manager = Anasazi::BlockKrylovSchurSolMgr<double, tpetra::MultiVector, tpetra::Operator>;
  const auto map = serialMap(pencil.size());
  Teuchos::ParameterList list = solverParameters(pencil, wanted, attempt, options);
  const int block = list.get<int>("Block Size");
  // nu phi = (K - sigma M)^-1 M phi, lambda = sigma + 1/nu. The first attempt at a large pencil
  // uses unrefined solutions: refinement takes three times as long, and the checks of the modes
  // refine their own.
  const bool refine = attempt > 0 || !factors.areLarge();
  const Teuchos::RCP<tpetra::Operator> inverse = Teuchos::rcp(
      new FunctionOperator(map, [&](const Matrix& x) { return factors.solveMass(x, refine); }));
  const Teuchos::RCP<tpetra::Operator> mass =
      Teuchos::rcp(new FunctionOperator(map, [&](const Matrix& x) { return factors.mass(x); }));
  const auto start = toTpetra(
      scatteredNumbers(pencil.size(), std::max(1, block), 17 + static_cast<std::uint64_t>(attempt)),
      map);
  const auto problem = Teuchos::rcp(new Problem(inverse, mass, start));
  EigenPairs modes;
  modes.method = "Anasazi BlockKrylovSchur, shift " + scientific(shift) + ", blocks of " +
                 std::to_string(block);
  bool converged = false;
  try {
    problem->setHermitian(true);
    problem->setNEV(wanted);
    if (!problem->setProblem()) throw std::logic_error("it refused the eigenproblem.");
    converged = Manager(problem, list).solve() == Anasazi::Converged;
  } catch (const Error&) {
    throw;
  } catch (const std::exception& stopped) {
    throw ConvergenceError(modes.method + " stopped: " + stopped.what());
  }
  const auto& solution = problem->getSolution();
  if (!converged || solution.numVecs < wanted)
    throw ConvergenceError(std::to_string(solution.numVecs) + " of " + std::to_string(wanted) +
                           " modes converged (" + modes.method + ")");
  modes.vectors = toEigen(*solution.Evecs).leftCols(wanted);
  Vector nu(wanted);
  for (int j = 0; j < wanted; ++j) nu[j] = solution.Evals[static_cast<std::size_t>(j)].realpart;
  modes.values = bestValues(nu, shift, modes.vectors, pencil);
  applyConventions(modes, pencil.M);
  polishUpperModes(modes, pencil, factors);
  applyConventions(modes, pencil.M);
  return modes;
}

/// Middle of the last gap among the values at or after position `from`; empty if there is none.
std::optional<std::pair<int, double>> lastGap(const Vector& values, int from, double floor) {
  for (int j = static_cast<int>(values.size()) - 1; j >= from; --j) {
    const double gap = values[j] - values[j - 1];
    if (gap > std::max(1e-6 * std::max(std::abs(values[j]), std::abs(values[j - 1])), floor))
      return std::make_pair(j, 0.5 * (values[j] + values[j - 1]));
  }
  return std::nullopt;
}

/// At least the `count` lowest modes of a pencil with light dofs. Modes below those of the light
/// dofs come from the inverse about the middle of the spectrum, in which light dofs are no larger
/// than rounding; the others are added.
EigenPairs modesBesideLight(const Pencil& pencil, int count, EigenOptions options) {
  const int below = pencil.below(pencil.scale);
  options.shift = -pencil.middle;
  EigenPairs modes = semidefiniteModes(pencil.K, pencil.M, below, options);
  if (modes.count() != below)
    throw ConvergenceError(std::to_string(modes.count()) + " of the " + std::to_string(below) +
                           " modes below " + scientific(pencil.scale) + " were found (" +
                           modes.method + ").");
  const int above = pencil.size() - below;
  if (count <= below || above == 0) return modes;
  const auto all = symmetricPairs(Matrix(pencil.K), Matrix(pencil.M));
  Matrix others = all.vectors.rightCols(above);
  others -= modes.vectors * (modes.vectors.transpose() * product(pencil.M, others));
  modes.values.conservativeResize(pencil.size());
  modes.values.tail(above) = all.values.tail(above);
  modes.vectors.conservativeResize(Eigen::NoChange, pencil.size());
  modes.vectors.rightCols(above) = others;
  return modes;
}

EigenPairs denseModes(const Pencil& pencil, int count, const EigenOptions& options) {
  EigenPairs modes = pencil.hasLight
                         ? modesBesideLight(pencil, count, options)
                         : symmetricModes(Matrix(pencil.K), Matrix(pencil.M), options.name);
  const double floor = 1e-14 * modes.values.cwiseAbs().maxCoeff();
  truncate(modes, options.keepPairs
                      ? keepWholePairs(modes.values, count, options.pairTolerance, floor)
                      : count);
  applyConventions(modes, pencil.M);
  recomputeErrors(modes, pencil.K, pencil.M, options.tolerance, options.orthogonality);
  return modes;
}

/// One attempt, with all checks; ConvergenceError names the failed one. `extra` modes beyond
/// `count` show where the last cluster ends; their number is increased if they do not.
EigenPairs checkedPairs(const Pencil& pencil, ShiftedFactors& factors, int count, int& extra,
                        int attempt, const EigenOptions& options) {
  const double floor = 1e-14 * pencil.scale;
  const Stage stage("Krylov-Schur iteration");
  EigenPairs modes =
      krylovSchur(pencil, factors, std::min(count + extra, pencil.size() / 2), attempt, options);
  const auto gap = lastGap(modes.values, count, floor);
  const int keep =
      options.keepPairs ? keepWholePairs(modes.values, count, options.pairTolerance, floor) : count;
  if (!gap || (options.keepPairs && keep >= modes.count())) {
    const std::string cluster = std::to_string(extra) + " modes after number " +
                                std::to_string(count) + " have the same eigenvalue " +
                                scientific(modes.values[count - 1]);
    extra *= 4;
    throw ConvergenceError(cluster);
  }
  truncate(modes, keep);
  requireAccurate(modes, pencil, factors, options.tolerance);
  factors.makeRoom();
  // Sylvester: the number of eigenvalues below a gap must be the number found there.
  const int below = pencil.below(gap->second);
  if (below != gap->first)
    throw ConvergenceError(std::to_string(below) + " eigenvalues lie below " +
                           scientific(gap->second) + " but " + std::to_string(gap->first) +
                           " were found there (" + modes.method + ")");
  recomputeErrors(modes, pencil.K, pencil.M, options.tolerance, options.orthogonality);
  return modes;
}

/// The modes closest above the shift of the factors.
EigenPairs modesAbove(ShiftedFactors factors, const Pencil& pencil, int count,
                      const EigenOptions& options) {
  std::string reason;
  int extra = 4;
  constexpr int attempts = 4;
  for (int attempt = 0; attempt < attempts; ++attempt) {
    try {
      return checkedPairs(pencil, factors, count, extra, attempt, options);
    } catch (const ConvergenceError& failure) {
      reason = failure.what();
    }
  }
  throw ConvergenceError("The " + std::to_string(count) + " lowest modes of " +
                         std::to_string(pencil.size()) + " dofs were not found in " +
                         std::to_string(attempts) + " attempts. The last one: " + reason +
                         ". Raise \"Num Blocks\", \"Block Size\" or \"Maximum Restarts\", or lower "
                         "\"Convergence Tolerance\".");
}

EigenPairs sparseModes(const Pencil& pencil, int count, const EigenOptions& options) {
  if (options.stiffness != nullptr && !options.shift &&
      options.stiffness->negativeEigenvalues() == 0) {
    EigenPairs modes = modesAbove({pencil, *options.stiffness}, pencil, count, options);
    if (modes.values[0] > wellAboveZero * pencil.scale) return modes;
  }
  const double shift = shiftBelowSpectrum(pencil, options);
  try {
    return modesAbove({pencil, shift, options.name}, pencil, count, options);
  } catch (const ConvergenceError&) {
    const auto other =
        shift == 0.0 && !options.shift ? shiftBesideLowest(pencil, count) : std::optional<double>();
    if (!other) throw;
    return modesAbove({pencil, *other, options.name}, pencil, count, options);
  }
}

EigenPairs modesOf(const Pencil& pencil, int count, const EigenOptions& options) {
  EigenPairs modes;
  modes.method = "none requested";
  if (count == 0) {
    modes.vectors.resize(pencil.size(), 0);
    return modes;
  }
  const bool dense =
      pencil.size() < options.denseBelow || 3 * count > pencil.size() || pencil.size() < 40;
  modes = dense ? denseModes(pencil, count, options) : sparseModes(pencil, count, options);
  tooljoint::count("modes computed", modes.count());
  return modes;
}

}  // namespace

EigenPairs lowestModes(const Sparse& K, const Sparse& M, int count, const EigenOptions& options) {
  if (count < 0 || count > K.rows())
    throw ModelError(std::to_string(count) + " modes were requested, but the eigenproblem has " +
                     std::to_string(K.rows()) + " dofs.");
  return modesOf(Pencil(K, M, options.name), count, options);
}

EigenPairs lowestModesOfChain(const Sparse& K, const Sparse& M, int count,
                              const EigenOptions& options,
                              std::shared_ptr<const ChainShare> share) {
  if (!share) return lowestModes(K, M, count, options);
  Pencil pencil(K, M, options.name);
  pencil.share = std::move(share);
  return modesOf(pencil, count, options);
}

EigenPairs lowestModesBelow(const Sparse& K, const Sparse& M, double omegaMax,
                            const EigenOptions& options) {
  if (!(omegaMax >= 0.0) || !std::isfinite(omegaMax))
    throw ModelError("The cut-off of a mode selection must be a number >= 0, not " +
                     scientific(omegaMax) + ".");
  const Pencil pencil(K, M, options.name);
  return modesOf(pencil, pencil.below(omegaMax * omegaMax), options);
}

}  // namespace tooljoint::linalg
