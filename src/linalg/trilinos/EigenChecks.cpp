// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/EigenChecks.hpp"

#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/SparseProducts.hpp"
#include "linalg/factor/MumpsFactor.hpp"

namespace tooljoint::linalg {

namespace {

using constants::epsilon;

using ColumnSparse = Eigen::SparseMatrix<double, Eigen::ColMajor, int>;
using Ldlt = Eigen::SimplicialLDLT<ColumnSparse, Eigen::Lower, Eigen::AMDOrdering<int>>;

/// Error of factors above which their pivots do not give the inertia.
constexpr double largestError = 1e-10;
/// The same for factors without pivoting, which may be accurate by chance: above it, others are
/// tried.
constexpr double doubtfulError = 1e-13;

/// Negative pivots of L D L' = A, how well the factors reproduce A, and the error above which other
/// factors are tried.
struct Inertia {
  int negative = 0;
  double error = std::numeric_limits<double>::infinity();
  double enough = doubtfulError;
};

/// Elimination order of a pattern, kept as long as the pattern is the same: counts below several
/// bounds share one.
class KeptOrder {
 public:
  using Order = Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int>;
  const Order& of(const ColumnSparse& A) {
    const int *outer = A.outerIndexPtr(), *inner = A.innerIndexPtr();
    const bool known = sizeOf(outer_) == A.cols() + 1 && sizeOf(inner_) == A.nonZeros() &&
                       std::equal(outer_.begin(), outer_.end(), outer) &&
                       std::equal(inner_.begin(), inner_.end(), inner);
    if (known) return order_;
    Order inverse;
    ColumnSparse both;
    both = A.selfadjointView<Eigen::Lower>();
    Eigen::AMDOrdering<int>()(both, inverse);
    order_ = inverse.inverse();
    outer_.assign(outer, outer + A.cols() + 1);
    inner_.assign(inner, inner + A.nonZeros());
    return order_;
  }

 private:
  std::vector<int> outer_, inner_;
  Order order_;
};

/// The same by MUMPS, with pivoting.
Inertia inertiaByMumps(const Sparse& A, parallel::Ranks ranks) {
  MumpsFactor factor({}, ranks);
  if (!factor.factor(A, MumpsFactor::Symmetry::Indefinite)) return {};
  const Vector b = scatteredNumbers(A.rows(), 1, 7);
  return {factor.negativePivots().value(), backwardError(A, factor.solve(b), b), largestError};
}

Inertia inertiaOf(const Sparse& A, parallel::Ranks ranks) {
  if (suitsMumps(A)) return inertiaByMumps(A, ranks);
  thread_local KeptOrder kept;
  const ColumnSparse columns = A;
  const auto& order = kept.of(columns);
  ColumnSparse ordered(A.rows(), A.cols());
  ordered.selfadjointView<Eigen::Upper>() =
      columns.selfadjointView<Eigen::Lower>().twistedBy(order);
  const Eigen::SimplicialLDLT<ColumnSparse, Eigen::Upper, Eigen::NaturalOrdering<int>> ldlt(
      ordered);
  if (ldlt.info() != Eigen::Success) return {};
  const Vector d = ldlt.vectorD();
  if (!d.allFinite() || (d.array() == 0.0).any()) return {};
  const Vector b = scatteredNumbers(A.rows(), 1, 7);
  const Vector x = order.inverse() * Vector(ldlt.solve(Vector(order * b)));
  if (!x.allFinite()) return {};
  return {static_cast<int>((d.array() < 0.0).count()), backwardError(A, x, b), doubtfulError};
}

/// C A C' with C = I + scattered couplings of neighbours, diagonally dominant in its rows. It has
/// the same inertia (Sylvester) but other leading minors, so that factors without pivoting exist
/// even if those of A do not (for example with a zero diagonal).
Sparse congruent(const Sparse& A, std::uint64_t seed) {
  const Matrix c = scatteredNumbers(A.rows(), 1, seed);
  Triplets entries;
  for (int i = 0; i < A.rows(); ++i) {
    entries.emplace_back(i, i, 1.0);
    const int neighbour = i > 0 ? i - 1 : 1;
    if (neighbour < A.rows())
      entries.emplace_back(i, neighbour, 0.5 * c(i, 0) + (c(i, 0) < 0.0 ? -0.2 : 0.2));
  }
  Sparse C(A.rows(), A.cols());
  C.setFromTriplets(entries.begin(), entries.end());
  return C * A * Sparse(C.transpose());
}

/// A <- D A D with rows of order one.
void equilibrate(Sparse& A) {
  Vector d = Vector::Zero(A.rows());
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it)
      d[row] = std::max(d[row], std::abs(it.value()));
  d = d.unaryExpr([](double size) { return size > 0.0 ? 1.0 / std::sqrt(size) : 1.0; });
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it)
      it.valueRef() = d[row] * it.value() * d[it.col()];
}

}  // namespace

Sparse symmetricPart(const Sparse& A, const std::string& what, const DofNamer& name) {
  if (A.rows() != A.cols())
    throw ModelError("The " + what + " matrix of an eigenproblem must be square.");
  Vector rowMax = Vector::Zero(A.rows());
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(A, row); it; ++it) {
      if (!std::isfinite(it.value()))
        throw ModelError("The " + what + " matrix has an entry that is not finite, between " +
                         nameOf(name, row) + " and " + nameOf(name, static_cast<int>(it.col())) +
                         ".");
      rowMax[row] = std::max(rowMax[row], std::abs(it.value()));
    }
  const Sparse transpose = A.transpose();
  const Sparse difference = A - transpose;
  for (int row = 0; row < A.rows(); ++row)
    for (Sparse::InnerIterator it(difference, row); it; ++it)
      if (std::abs(it.value()) >
          1e-9 * std::sqrt(std::max(rowMax[row], epsilon) * std::max(rowMax[it.col()], epsilon)))
        throw ModelError("The " + what +
                         " matrix of a symmetric eigenproblem is not symmetric between " +
                         nameOf(name, row) + " and " + nameOf(name, static_cast<int>(it.col())) +
                         ": give its symmetric part.");
  return 0.5 * (A + transpose);
}

std::shared_ptr<const Sparse> sharedSymmetricPart(const Sparse& A, const std::string& what,
                                                  const DofNamer& name) {
  const bool finite = A.isCompressed() && A.coeffs().allFinite();
  if (finite && isExactlySymmetric(A)) return {std::shared_ptr<const Sparse>(), &A};
  return std::make_shared<const Sparse>(symmetricPart(A, what, name));
}

Vector definitePivots(const Sparse& M, const DofNamer& name) {
  constexpr double none = 4.0 * epsilon;  // of the diagonal: a pivot below this is rounding
  const Vector diagonal = M.diagonal();
  if (suitsMumps(M) && diagonal.minCoeff() > 0.0 && isDefinite(M, none)) return diagonal;
  Ldlt ldlt;
  ldlt.compute(ColumnSparse(M));
  const auto refuse = [&](int dof) {
    throw ModelError(
        "The mass matrix of an eigenproblem must be positive definite, and it is not at " +
        nameOf(name, dof) + ": give that degree of freedom a mass, or condense it first.");
  };
  for (int i = 0; i < M.rows(); ++i)
    if (!(diagonal[i] > 0.0)) refuse(i);
  if (ldlt.info() != Eigen::Success) refuse(static_cast<int>(largestEntry(-diagonal)));
  // Pivot i belongs to row p_i of M.
  const Vector d = ldlt.vectorD();
  Vector pivots(M.rows());
  for (int i = 0; i < M.rows(); ++i) {
    const int dof = ldlt.permutationPinv().indices()[i];
    if (!(d[i] > none * diagonal[dof])) refuse(dof);
    pivots[dof] = d[i];
  }
  return pivots;
}

double eigenvalueScale(const Sparse& K, const Sparse& M) {
  return M.rows() == 0 ? 0.0
                       : Vector(K.diagonal().cwiseAbs().cwiseQuotient(M.diagonal())).maxCoeff();
}

void applyConventions(EigenPairs& modes, const Sparse& M) {
  std::vector<int> order(static_cast<std::size_t>(modes.values.size()));
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return modes.values[a] < modes.values[b]; });
  const Vector masses =
      modes.vectors.cwiseProduct(product(M, modes.vectors)).colwise().sum().transpose();
  EigenPairs sorted = modes;
  for (std::size_t j = 0; j < order.size(); ++j) {
    const auto column = static_cast<Eigen::Index>(j);
    sorted.values[column] = modes.values[order[j]];
    Vector phi = modes.vectors.col(order[j]);
    phi /= std::sqrt(masses[order[j]]);
    if (phi[largestEntry(phi)] < 0.0) phi = -phi;
    sorted.vectors.col(column) = phi;
  }
  modes = std::move(sorted);
}

Vector unitMassScale(const Sparse& K, const Sparse& M) {
  const Vector k = K.diagonal().cwiseAbs(), m = M.diagonal().cwiseAbs();
  double stiffest = 0.0;  // largest K_ii / M_ii
  for (Eigen::Index i = 0; i < m.size(); ++i)
    if (m[i] > 0.0) stiffest = std::max(stiffest, k[i] / m[i]);
  Vector scale = Vector::Ones(m.size());
  for (Eigen::Index i = 0; i < m.size(); ++i) {
    const double mass = m[i] > 0.0 ? m[i] : stiffest > 0.0 ? k[i] / stiffest : 0.0;
    if (mass > 0.0) scale[i] = 1.0 / std::sqrt(mass);
  }
  return scale;
}

Vector binaryMassScale(const Sparse& K, const Sparse& M) {
  return unitMassScale(K, M).unaryExpr(
      [](double x) { return std::exp2(std::round(std::log2(x))); });
}

namespace {

struct Decimal {
  int digits = 0;       ///< number of digits; above `most` if there are more
  bool chosen = false;  ///< has an inner run of zeros or nines: a stiff and a soft spring in one
                        ///< sum or difference
};

Decimal decimal(double x, int most) {
  const double size = std::abs(x);
  Decimal out;
  if (size == 0.0) return out;
  const int exponent = static_cast<int>(std::floor(std::log10(size)));
  for (out.digits = 1; out.digits <= most; ++out.digits) {
    const double shifted = size * std::pow(10.0, out.digits - 1 - exponent);
    if (std::abs(shifted - std::round(shifted)) > 4 * epsilon * shifted) continue;
    // one in a thousand numbers cut off after ten digits has such a run
    const std::string text = std::to_string(std::llround(shifted));
    out.chosen = text.find("0000") != std::string::npos || text.find("9999") != std::string::npos;
    break;
  }
  return out;
}

/// Half a unit of the last digit of entries that a text file has cut off after 8 to 12 digits. 0 if
/// some entries have more digits, or if few have that many: those were chosen and are exact. Whole
/// numbers and numbers with an inner run of zeros or nines count as exact too.
double roundingOfText(const Sparse& K) {
  constexpr int fewest = 8, most = 12;
  constexpr long few = 8;  // entries: a beam element of a file has as many
  int longest = 0;
  long cut = 0;
  for (int i = 0; i < K.outerSize(); ++i)
    for (Sparse::InnerIterator it(K, i); it; ++it) {
      const Decimal number = decimal(it.value(), most);
      if (number.digits > most) return 0.0;
      if (number.digits < fewest || number.chosen || it.value() == std::round(it.value())) continue;
      longest = std::max(longest, number.digits);
      ++cut;
    }
  return cut < few ? 0.0 : 0.5 * std::pow(10.0, 1 - longest);
}

}  // namespace

double roundingOf(const Sparse& K) {
  constexpr int operations = 8;  // of assembly and rotation, per entry
  int fullest = 0;
  for (int i = 0; i < K.outerSize(); ++i) {
    int entries = 0;
    for (Sparse::InnerIterator it(K, i); it; ++it) ++entries;
    fullest = std::max(fullest, entries);
  }
  return std::max((fullest + operations) * epsilon, roundingOfText(K));
}

bool isRounding(double value, const Vector& phi, const Sparse& K) {
  return areRounding(Vector::Constant(1, value), phi, K).front() != 0;
}

std::vector<char> areRounding(const Vector& values, const Matrix& shapes, const Sparse& K) {
  // |phi|'|K||phi|
  const Vector bound =
      roundingOf(K) *
      shapes.cwiseAbs().cwiseProduct(absoluteProduct(K, shapes)).colwise().sum().transpose();
  // The eigenvalue of a rigid-body motion has the rounding of the largest ones; its energy does
  // not.
  const Vector energies = shapes.cwiseProduct(product(K, shapes)).colwise().sum().transpose();
  std::vector<char> small(static_cast<std::size_t>(values.size()));
  for (Eigen::Index j = 0; j < values.size(); ++j)
    small[static_cast<std::size_t>(j)] =
        std::min(std::abs(values[j]), std::abs(energies[j])) <= bound[j] ? 1 : 0;
  return small;
}

void recomputeErrors(EigenPairs& modes, const Sparse& K, const Sparse& M, double tolerance,
                     double orthogonality) {
  // |D (K - lambda M) phi| against |D| (|K| + |lambda| |M|) |phi| with D = diag(M)^(-1/2)
  const Vector d = unitMassScale(K, M);
  const Matrix MPhi = product(M, modes.vectors);
  const Matrix R = d.asDiagonal() * (product(K, modes.vectors) - MPhi * modes.values.asDiagonal());
  const Matrix KSize = d.asDiagonal() * absoluteProduct(K, modes.vectors),
               MSize = d.asDiagonal() * absoluteProduct(M, modes.vectors),
               dSize = d.cwiseInverse().asDiagonal() * modes.vectors.cwiseAbs();
  double largest = 0.0;
  forEachEntry(K, [&](int i, int j, double value) {
    largest = std::max(largest, d[i] * std::abs(value) * d[j]);
  });
  // Rounding of the largest stiffness also affects modes without a component in it: a free
  // coordinate of a diagonal K has |K||phi| = 0.
  const double rounding = 64.0 * epsilon / tolerance * largest;
  modes.residuals.resize(modes.values.size());
  for (Eigen::Index j = 0; j < modes.values.size(); ++j) {
    const double defect = R.col(j).norm();  // exactly zero without stiffness
    const double scale = KSize.col(j).norm() + std::abs(modes.values[j]) * MSize.col(j).norm() +
                         rounding * dSize.col(j).norm();
    modes.residuals[j] = defect == 0.0 ? 0.0 : defect / scale;
  }
  const Matrix gram =
      modes.vectors.transpose() * MPhi - Matrix::Identity(modes.count(), modes.count());
  modes.orthogonality = modes.count() == 0 ? 0.0 : gram.cwiseAbs().maxCoeff();
  for (Eigen::Index j = 0; j < modes.residuals.size(); ++j)
    if (!(modes.residuals[j] <= tolerance))
      throw ConvergenceError("Mode " + std::to_string(j + 1) + " (" + modes.method +
                             ") has a residual of " + scientific(modes.residuals[j]) + " where " +
                             scientific(tolerance) + " is allowed.");
  if (!(modes.orthogonality <= orthogonality))
    throw ConvergenceError(
        "The modes (" + modes.method + ") are orthogonal with respect to the mass matrix only to " +
        scientific(modes.orthogonality) + " where " + scientific(orthogonality) + " is allowed.");
}

int keepWholePairs(const Vector& values, int count, double tolerance, double floor) {
  int keep = count;
  while (keep > 0 && keep < values.size()) {
    const double last = values[keep - 1], next = values[keep];
    if (next - last > std::max(tolerance * std::max(std::abs(last), std::abs(next)), floor)) break;
    ++keep;
  }
  return keep;
}

void truncate(EigenPairs& modes, int count) {
  modes.values.conservativeResize(count);
  modes.vectors.conservativeResize(Eigen::NoChange, count);
  modes.residuals.conservativeResize(std::min<Eigen::Index>(count, modes.residuals.size()));
}

std::optional<int> negativeEigenvalues(Sparse A, parallel::Ranks ranks) {
  if (A.rows() == 0) return 0;
  const Stage stage("inertia counts");
  equilibrate(A);
  Inertia best = inertiaOf(A, ranks);
  for (std::uint64_t seed = 1; seed <= 8 && best.error > best.enough; ++seed) {
    const Inertia other = inertiaOf(congruent(A, seed), ranks);
    if (other.error < best.error) best = other;
  }
  return best.error <= largestError ? std::optional(best.negative) : std::nullopt;
}

int eigenvaluesBelow(const Sparse& K, const Sparse& M, double bound) {
  if (const auto count = negativeEigenvalues(Sparse(K - bound * M))) return *count;
  throw ConvergenceError("The eigenvalues below " + scientific(bound) +
                         " could not be counted: K - lambda M has no stable LDL' factors there.");
}

}  // namespace tooljoint::linalg
