// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <memory>
#include <optional>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Interrupt.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "linalg/GrowingKrylov.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/trilinos/ProportionalModes.hpp"

namespace tooljoint::linalg {

namespace {

/// The largest residual of the wanted Ritz pairs has reached rounding if it is below the first
/// value, or if it is below the second value and has not fallen to half of its value in a space
/// four fifths the size.
constexpr double converged = 1e-13, stagnant = 1e-7;
/// A shift this many times below the wanted values is raised if a search does not settle within so
/// many checks: nu of the middle of the spectrum, near 0, then look like wanted ones for long. The
/// new shift is this part of the wanted values; a larger one would hide copies of the lowest ones.
constexpr double lowShift = 6.0, raisedShift = 0.3;
constexpr int unsettledChecks = 2, mostShifts = 4;
/// Limit of the vectors of a space, or twelve times the number of modes: all vectors of a model of
/// 750 dofs.
constexpr int largestSpace = 1500;
/// A search for more modes than this takes minutes and ends at a signal. After a shorter one the
/// caller checks the signal, because it may have something to keep.
constexpr std::size_t longSearch = 200;
/// Values s -> infinity, nu = 1 / (s - sigma) -> 0, occur in Jordan chains at dofs with neither
/// mass nor damping. Rounding makes their nu as large as the root of rounding, and leaves the
/// response to the residual without any component of the vector. Values with nu below this part of
/// the largest one and such a response are infinite.
constexpr double noFiniteValue = 1e-6, noDigits = 0.5;
/// Allowed error of the vector of a zero value: rounding splits the Jordan chains of rigid-body
/// motions, so their shapes have half the digits of others.
constexpr double chainError = 1e-6;
/// Other values with nu below this part of the largest are rounding.
constexpr double noDigitsOfNu = 1e-13;

/// (L - sigma)^-1 for the linearisation s z = L z of the pencil, z = (x, s x / sigma), sigma > 0.
class ShiftedInverse {
 public:
  ShiftedInverse(const ScaledPencil& pencil, double shift, const DofNamer& name)
      : pencil_(pencil),
        shift_(shift),
        first_(pencil.C + shift * pencil.M),
        factors_(Sparse(pencil.K + shift * first_), name) {}

  double shift() const { return shift_; }

  /// x' = -Q(sigma)^-1 ((C + sigma M) x + M s x), v' = x / sigma + x'
  Matrix operator()(const Matrix& z) const {
    const auto n = pencil_.size();
    const Matrix x = z.topRows(n), v = z.bottomRows(n);
    Matrix out(2 * n, z.cols());
    out.topRows(n) = -factors_.solve(Matrix(first_ * x + shift_ * (pencil_.M * v)));
    out.bottomRows(n) = x / shift_ + out.topRows(n);
    return out;
  }

  /// phi -> -(s - sigma) Q(sigma)^-1 ((s + sigma) M + C) phi; modes are its fixed points. The
  /// difference is Q(sigma)^-1 Q(s) phi, the response to the residual, without the cancellation in
  /// Q(s) phi.
  ComplexVector again(Complex s, const ComplexVector& phi) const {
    const ComplexVector force = (s + shift_) * times(pencil_.M, phi) + times(pencil_.C, phi);
    const Matrix parts =
        factors_.solve((Matrix(phi.size(), 2) << force.real(), force.imag()).finished());
    return -(s - shift_) *
           (parts.col(0).cast<Complex>() + Complex(0, 1) * parts.col(1).cast<Complex>());
  }

 private:
  const ScaledPencil& pencil_;
  double shift_;
  Sparse first_;  ///< C + sigma M
  DirectSolver factors_;
};

/// Inverse at the shift, or slightly beside it if the shift is an eigenvalue (Q(sigma) is
/// singular).
std::unique_ptr<ShiftedInverse> inverseNear(const ScaledPencil& pencil, double shift,
                                            const DofNamer& name) {
  constexpr int attempts = 3;
  for (int attempt = 1;; ++attempt, shift *= 1.3) try {
      return std::make_unique<ShiftedInverse>(pencil, shift, name);
    } catch (const ModelError&) {
      if (attempt == attempts) throw;
    }
}

double largestNu(const RitzPairs& ritz) {
  return ritz.values.size() > 0 ? ritz.values.cwiseAbs().maxCoeff() : 0.0;
}

/// nu below which a value may be infinite; the norm of (L - sigma)^-1 is at least 1 / sigma.
double infiniteNu(const RitzPairs& ritz, double shift) {
  return noFiniteValue * std::max(largestNu(ritz), 1.0 / shift);
}

/// No finite value is beyond this many times the fastest diagonal rate.
constexpr double beyondAll = 1e3;

/// Number of finite values, the degree of det Q(s): log2 |det Q(2 R) / det Q(R)| at an R beyond all
/// of them. 2 n for a regular mass, and for a model too large for a Krylov space with all values.
int finiteValues(const ScaledPencil& pencil) {
  const auto n = static_cast<int>(pencil.size());
  if (!pencil.singularMass || 2 * n > largestSpace) return 2 * n;
  const Vector k = pencil.K.diagonal().cwiseAbs(), c = pencil.C.diagonal().cwiseAbs(),
               m = pencil.M.diagonal();
  double fastest = 0.0;
  for (int i = 0; i < n; ++i)
    if (m[i] > 0.0)
      fastest = std::max({fastest, std::sqrt(k[i] / m[i]), c[i] / m[i]});
    else if (c[i] > 0.0)
      fastest = std::max(fastest, k[i] / c[i]);
  if (!(fastest > 0.0)) return 2 * n;
  const double far = beyondAll * fastest;
  const DynamicStiffness once(pencil.M, pencil.C, pencil.K, far),
      twice(pencil.M, pencil.C, pencil.K, 2.0 * far);
  if (once.singular() || twice.singular()) return 2 * n;
  return static_cast<int>(
      std::lround((twice.logDeterminant() - once.logDeterminant()) / std::log(2.0)));
}

/// Values with Im s >= 0 by |s|, with their columns of the Ritz vectors.
struct Upper {
  std::vector<Complex> s;
  std::vector<Eigen::Index> column;
  std::vector<double> residual;

  /// The first `finite` values, counting conjugates, without those whose nu is rounding or below
  /// `infinite`.
  Upper(const RitzPairs& ritz, double shift, int finite, double infinite = 0.0) {
    const double largest = largestNu(ritz);
    std::vector<Eigen::Index> order;
    for (Eigen::Index j = 0; j < ritz.values.size();
         ++j)  // nu of rounding: no finite s; Im nu < 0: Im s > 0
      if (std::abs(ritz.values[j]) > std::max(noDigitsOfNu * largest, infinite) &&
          ritz.values[j].imag() <= 0.0)
        order.push_back(j);
    const auto value = [&](Eigen::Index j) { return shift + 1.0 / ritz.values[j]; };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return std::abs(value(a)) < std::abs(value(b)); });
    for (auto j : order) {
      finite -= ritz.values[j].imag() < 0.0 ? 2 : 1;
      if (finite < 0) break;
      s.push_back(value(j));
      column.push_back(j);
      residual.push_back(ritz.residuals[j]);
    }
  }
  /// Largest residual of the lowest `wanted` values; infinite if there are fewer.
  double worst(std::size_t wanted) const {
    if (s.size() < wanted) return std::numeric_limits<double>::infinity();
    return *std::max_element(residual.begin(),
                             residual.begin() + static_cast<std::ptrdiff_t>(wanted));
  }
  /// |s| of the `wanted`-th value that is accurate, whatever lies below it; 0 if there are fewer.
  double accurate(std::size_t wanted) const {
    for (std::size_t j = 0; j < s.size(); ++j)
      if (residual[j] <= stagnant && --wanted == 0) return std::abs(s[j]);
    return 0.0;
  }
  std::size_t below(double bound) const {
    return static_cast<std::size_t>(
        std::count_if(s.begin(), s.end(), [&](Complex z) { return std::abs(z) <= bound; }));
  }
};

/// Largest of the lowest `wanted` |s|; for a singular mass the largest of the lowest vibrations.
/// Dofs with damping but no mass relax at -k/c. With little damping these values are very large,
/// and the vibrations would look like rigid-body modes beside them. Rigid-body modes are counted
/// twice (Jordan chains) and could fill the list. So only vibrations count.
double farWanted(const ScaledPencil& pencil, const Upper& found, std::size_t wanted) {
  double far = 0;
  std::size_t counted = 0;
  if (pencil.singularMass)
    for (std::size_t j = 0; j < found.s.size() && counted < wanted; ++j)
      if (found.s[j].imag() != 0.0) far = std::max(far, std::abs(found.s[j])), ++counted;
  return far > 0 ? far : std::abs(found.s[std::min(found.s.size(), wanted) - 1]);
}

/// 1e-4 sqrt(k_ii / m_ii) of the median dof. A mean would be dominated by dofs that hardly move:
/// with little residual flexibility left, boundary dofs of MacNeal's basis have 1e15 times the
/// stiffness of the modes and no mass of their own.
double firstShift(const ScaledPencil& pencil) {
  const Vector k = pencil.K.diagonal().cwiseAbs(), m = pencil.M.diagonal();
  std::vector<double> squares;
  for (Eigen::Index i = 0; i < k.size(); ++i)
    if (m[i] > 0 && k[i] > 0) squares.push_back(k[i] / m[i]);
  if (squares.empty()) return 1.0;
  const auto middle = squares.begin() + static_cast<std::ptrdiff_t>(squares.size() / 2);
  std::nth_element(squares.begin(), middle, squares.end());
  return 1e-4 * std::sqrt(*middle);
}

/// `near` or a little less, with no value within a tenth. A value at the shift itself, such as one
/// that grows without vibration, would leave all others no digits, because its nu is too large.
double besideValues(const Upper& found, double near) {
  constexpr int attempts = 8;
  for (int attempt = 0; attempt < attempts; ++attempt, near *= 0.8)
    if (std::none_of(found.s.begin(), found.s.end(),
                     [near](Complex s) { return std::abs(s - near) < 0.1 * near; }))
      break;
  return near;
}

/// Inverse at about the lowest |s| that is no rigid-body motion: there (L - sigma)^-1 separates the
/// wanted values, and Jordan chains at zero do not dominate. If only rigid-body motions are wanted,
/// a shift as small as their values has no inverse, and the previous one is used.
std::unique_ptr<ShiftedInverse> goodInverse(const ScaledPencil& pencil, std::size_t wanted,
                                            int finite, const DofNamer& name) {
  double shift = firstShift(pencil);
  constexpr int rounds = 4;
  auto inverse = inverseNear(pencil, shift, name);
  for (int round = 0; round < rounds; ++round) {
    GrowingKrylov<double> space([&](const Matrix& z) { return (*inverse)(z); }, 2 * pencil.size());
    space.start(startColumns, 11);
    space.grow(static_cast<int>(wanted) + 4 * startColumns);
    const RitzPairs ritz = space.ritz();
    const Upper found(ritz, inverse->shift(), finite,
                      pencil.singularMass ? infiniteNu(ritz, inverse->shift()) : 0.0);
    if (found.s.empty()) return inverse;
    const double far = farWanted(pencil, found, wanted);
    double near = far;
    for (const Complex& s : found.s)
      if (std::abs(s) > 1e-3 * far) near = std::min(near, std::abs(s));
    if (!(near > 0)) return inverse;
    near = besideValues(found, near);
    const double ratio = near / shift;
    shift = near;
    try {
      inverse = inverseNear(pencil, shift, name);
    } catch (const ModelError&) {
      return inverse;
    }
    if (ratio > 0.25 && ratio < 4.0) break;
  }
  return inverse;
}

/// Keeps one mode of each independent motion at zero; these are the first ones of `values`. A free
/// body without damping has each of them twice, in a Jordan chain, which rounding splits into two
/// values with nearly the same vector. With gyroscopics two motions may share one complex vector,
/// because rounding makes a pair of their values. The vectors span the motions, but some may be
/// nearly parallel. So their singular vectors are used, at least half as many as there are vectors.
void keepIndependentZeros(const ShiftedInverse& inverse, std::vector<Complex>& values,
                          std::vector<ComplexVector>& vectors) {
  const auto firstOther =
      std::find_if(values.begin(), values.end(), [](Complex s) { return s != 0.0; });
  const auto zeros = std::distance(values.begin(), firstOther);
  if (zeros == 0) return;
  std::vector<Vector> columns;
  for (auto phi = vectors.begin(); phi != vectors.begin() + zeros; ++phi) {
    // not scaled: one part of a real shape times a complex number may be rounding
    const ComplexVector unit = phi->normalized();
    columns.push_back(unit.real());
    if (!unit.imag().isZero(0.0)) columns.push_back(unit.imag());
  }
  Matrix all(columns.front().size(), sizeOf(columns));
  for (int j = 0; j < all.cols(); ++j) all.col(j) = columns[at(j)];
  const auto svd = singularValues(all, SingularVectors::Thin);
  constexpr double dependent = 1e-3;  // chains are split by the root of rounding
  const auto large = (svd.values.array() > dependent * svd.values[0]).count();
  const Eigen::Index kept = std::max<Eigen::Index>(large, (all.cols() + 1) / 2);
  vectors.erase(vectors.begin(), vectors.begin() + zeros);
  values.erase(values.begin(), firstOther);
  for (Eigen::Index j = kept - 1; j >= 0; --j) {
    vectors.insert(vectors.begin(), inverse.again(0.0, svd.U.col(j).cast<Complex>()));
    values.insert(values.begin(), 0.0);
  }
}

/// Location of a mode for messages. For a real value with a singular mass it is the massless dof
/// that relaxes fastest, at -k/c, because the vector may have no digits; otherwise the dof that
/// moves most.
std::string placeOf(const ScaledPencil& pencil, Complex s, const ComplexVector& phi,
                    const DofNamer& name) {
  const Vector k = pencil.K.diagonal(), c = pencil.C.diagonal(), m = pencil.M.diagonal();
  int fastest = -1;
  if (s.imag() == 0.0)
    for (int i = 0; i < m.size(); ++i)
      if (m[i] == 0.0 && c[i] > 0.0 && (fastest < 0 || k[i] / c[i] > k[fastest] / c[fastest]))
        fastest = i;
  if (fastest >= 0)
    return " No mass acts at " + nameOf(name, fastest) + ", and damping (" +
           scientific(c[fastest] / (pencil.scale[fastest] * pencil.scale[fastest])) +
           ") is so small that the dof relaxes far faster than all vibrations. Remove this "
           "damping, increase it, or give the dof a mass.";
  Eigen::Index largest = 0;
  pencil.scale.cwiseProduct(phi.cwiseAbs()).maxCoeff(&largest);
  return " It moves most at " + nameOf(name, static_cast<int>(largest)) + ".";
}

/// The two shapes of a double real value, such as that of rigid-body motions with mass-proportional
/// damping. Rounding makes a complex pair of it, and the real and imaginary parts of its vector are
/// both shapes. Empty if they are not: the pair is one motion near critical damping.
std::optional<Matrix> shapesOfTwofold(const ScaledPencil& pencil, const ShiftedInverse& inverse,
                                      Complex s, const ComplexVector& phi) {
  constexpr double torn = 1e-6;  // Im s / |s|: rounding of a twofold value, with a margin
  if (s.imag() == 0.0 || std::abs(s.imag()) > torn * std::abs(s)) return std::nullopt;
  Matrix parts(phi.size(), 2);
  parts << phi.real(), phi.imag();
  Matrix shapes = singularValues(parts, SingularVectors::Thin).U;
  for (int j = 0; j < 2; ++j) {
    const ComplexVector shape = shapes.col(j).cast<Complex>(),
                        better = inverse.again(s.real(), shape);
    const double rounding = roundingOfValue(pencil, s.real() - inverse.shift(), better);
    if (!((better - shape).norm() <= (acceptedError + rounding) * better.norm()))
      return std::nullopt;
  }
  return shapes;
}

/// The first `wanted` pairs, without infinite ones and repeated zeros. ConvergenceError if a finite
/// one is not accurate.
DampedModes checkedModes(const ScaledPencil& pencil, const ShiftedInverse& inverse,
                         const GrowingKrylov<double>& space, const Upper& found,
                         const RitzPairs& ritz, std::size_t wanted, const DofNamer& name) {
  DampedModes out;
  std::size_t zeros = 0;
  const bool isLong = wanted > longSearch;
  const double farthest = 1.0 / infiniteNu(ritz, inverse.shift());
  for (std::size_t j = 0; j < std::min(wanted, found.s.size()); ++j) {
    if (isLong) stopIfInterrupted();
    const ComplexVector phi = space.vector(ritz, found.column[j]).head(pencil.size());
    Complex s = found.s[j];
    ComplexVector better = inverse.again(s, phi);
    const double error = (better - phi).norm() / better.norm();
    if (pencil.singularMass && std::abs(s - inverse.shift()) >= farthest && !(error <= noDigits))
      continue;
    const double rounding = roundingOfValue(pencil, s - inverse.shift(), better);
    const double allowed =
        std::max(acceptedError + rounding, isZero(pencil, s, better) ? chainError : 0.0);
    const bool accurate = error <= allowed;
    const auto refined = accurate ? std::nullopt : refinedMode(pencil, s, better);
    if (!accurate && !refined)
      throw ConvergenceError(
          "Damped mode " + std::to_string(j + 1) + " (s = " + scientific(s.real()) + " + " +
          scientific(s.imag()) + " i) has a relative error of " + scientific(error) + " where " +
          scientific(allowed) + " is allowed." + placeOf(pencil, s, better, name));
    if (refined) s = refined->s, better = refined->shape;
    if (const auto twofold = shapesOfTwofold(pencil, inverse, s, better)) {
      for (int k = 0; k < 2; ++k) {
        out.values.push_back(s.real());
        out.vectors.push_back(twofold->col(k).cast<Complex>());
      }
      continue;
    }
    const bool zero = isZero(pencil, s, better);
    const auto place = zero ? zeros++ : out.values.size();
    out.values.insert(out.values.begin() + static_cast<std::ptrdiff_t>(place), zero ? 0.0 : s);
    out.vectors.insert(out.vectors.begin() + static_cast<std::ptrdiff_t>(place), std::move(better));
  }
  keepIndependentZeros(inverse, out.values, out.vectors);
  return out;
}

/// The lowest `count` modes, fewer if there are fewer finite ones. With `better`, none if the shift
/// is too far below the values for the search to settle; `better` is then the shift to take.
std::optional<DampedModes> modesAbout(const ScaledPencil& pencil, const ShiftedInverse& inverse,
                                      int count, int finite, const DofNamer& name, double* better) {
  const int all = 2 * static_cast<int>(pencil.size());
  auto wanted = static_cast<std::size_t>(count);
  GrowingKrylov<double> space([&](const Matrix& z) { return inverse(z); }, all);
  if (all <= 2 * denseBelow)
    space.startWhole();
  else
    space.start(startColumns, 23);
  const int limit = std::min(all, std::max(largestSpace, 12 * static_cast<int>(wanted)));
  int columns = std::min(limit, 3 * static_cast<int>(wanted) + 4 * startColumns);
  int unsettled = 0;          // checks with enough accurate values, but others below them
  std::size_t confirmed = 0;  // values below `bound` at the last check
  double bound = -1;
  double before = std::numeric_limits<double>::infinity();  // largest residual in the smaller space
  for (;;) {
    if (wanted > longSearch) stopIfInterrupted();
    space.grow(columns);
    const RitzPairs ritz = space.ritz();
    const Upper found(ritz, inverse.shift(), finite);
    const bool whole = space.invariant();
    const double worst = found.worst(wanted);
    const bool settled =
        worst <= converged || (worst <= stagnant && (worst > 0.5 * before || columns >= limit));
    if (!whole && !settled) {
      before = worst;
      if (better != nullptr && bound < 0 && found.accurate(wanted) > lowShift * inverse.shift() &&
          ++unsettled == unsettledChecks) {
        *better = besideValues(found, raisedShift * found.accurate(wanted));
        return std::nullopt;
      }
      if (columns >= limit)
        throw ConvergenceError("The " + std::to_string(count) + " damped modes nearest zero of " +
                               std::to_string(pencil.size()) +
                               " dofs were not found in a Krylov space of " +
                               std::to_string(limit) + " vectors. Request fewer or more modes.");
      columns = std::min(limit, columns + std::max(2 * startColumns, columns / 4));
      continue;
    }
    // A block finds only as many copies of a repeated value as it has columns. An additional start
    // shows whether there are others.
    if (!whole && (bound < 0 || found.below(bound) != confirmed)) {
      bound = std::abs(found.s[wanted - 1]) * (1 + 1e-6);
      confirmed = found.below(bound);
      space.startBeside(startColumns, 37 + static_cast<std::uint64_t>(columns));
      columns = std::min(all, columns + controlSteps * startColumns);
      before = worst;
      continue;
    }
    DampedModes modes = checkedModes(pencil, inverse, space, found, ritz, wanted, name);
    if (static_cast<int>(modes.values.size()) >= count || found.s.size() <= wanted) return modes;
    wanted +=
        static_cast<std::size_t>(count) - modes.values.size();  // chains at zero have been removed
    bound = -1;
  }
}

/// The lowest `count` modes, fewer if there are fewer finite ones.
DampedModes generalModes(const ScaledPencil& pencil, int count, const DofNamer& name) {
  const int finite = finiteValues(pencil);
  auto inverse = goodInverse(pencil, static_cast<std::size_t>(count), finite, name);
  for (int shifts = 1;; ++shifts) {
    double better = 0.0;
    if (auto modes = modesAbout(pencil, *inverse, count, finite, name,
                                shifts < mostShifts ? &better : nullptr))
      return *modes;
    inverse = inverseNear(pencil, better, name);
  }
}

}  // namespace

QuadraticModes lowestDampedModes(const Sparse& M, const Sparse& C, const Sparse& K, int count,
                                 const DofNamer& name, const EnergyRounding& rounding) {
  const auto n = M.rows();
  if (count < 0 || count > 2 * n)
    throw ModelError(std::to_string(count) +
                     " damped modes were requested, but the eigenproblem has " + std::to_string(n) +
                     " dofs.");
  QuadraticModes modes;
  if (count == 0) {
    modes.vectors.resize(n, 0);
    return modes;
  }
  const Stage stage("damped modes");
  const ScaledPencil pencil(M, C, K, rounding);
  const auto simple = pencil.singularMass ? std::nullopt : proportionalModes(pencil, count, name);
  const DampedModes found = simple ? *simple : generalModes(pencil, count, name);
  return presented(pencil, found, count);
}

}  // namespace tooljoint::linalg
