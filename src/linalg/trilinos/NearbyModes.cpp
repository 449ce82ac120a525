// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numeric>

#include "common/Error.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/DynamicStiffness.hpp"
#include "linalg/GrowingKrylov.hpp"
#include "linalg/Scientific.hpp"
#include "linalg/trilinos/DampedPencil.hpp"

namespace tooljoint::linalg {

namespace {

/// Residual at which a Ritz pair has converged: Newton's method refines it further.
constexpr double convergedNearby = 1e-10;
/// Limit of the vectors of a space: enough for about 150 modes.
constexpr int largestNearbySpace = 400;
/// Relative displacement of a shift that is an eigenvalue.
constexpr double besideEigenvalue = 1e-3;

/// (L - tau)^-1 for the linearisation s z = L z of the pencil, z = (x, s x / |tau|):
///
///     x' = -Q(tau)^-1 ((C + tau M) x + |tau| M v),  v' = (x + tau x') / |tau|
class ComplexInverse {
 public:
  ComplexInverse(const ScaledPencil& pencil, Complex shift)
      : pencil_(pencil), shift_(shift), factors_(pencil.M, pencil.C, pencil.K, shift) {}

  bool singular() const { return factors_.singular(); }
  Complex shift() const { return shift_; }

  ComplexMatrix operator()(const ComplexMatrix& z) const {
    const auto n = pencil_.size();
    const double size = std::abs(shift_);
    ComplexMatrix out(2 * n, z.cols()), force(n, z.cols());
    for (Eigen::Index j = 0; j < z.cols(); ++j) {
      const ComplexVector x = z.col(j).head(n), v = z.col(j).tail(n);
      force.col(j) =
          -(times(pencil_.C, x) + times(pencil_.M, ComplexVector(shift_ * x + size * v)));
    }
    out.topRows(n) = factors_.solve(force);
    out.bottomRows(n) = (z.topRows(n) + shift_ * out.topRows(n)) / size;
    return out;
  }

  /// phi -> -(s - tau) Q(tau)^-1 ((s + tau) M + C) phi; modes are its fixed points.
  ComplexVector again(Complex s, const ComplexVector& phi) const {
    const ComplexVector force = (s + shift_) * times(pencil_.M, phi) + times(pencil_.C, phi);
    return -(s - shift_) * factors_.solve(force).col(0);
  }

 private:
  const ScaledPencil& pencil_;
  Complex shift_;
  DynamicStiffness factors_;
};

std::unique_ptr<ComplexInverse> inverseNear(const ScaledPencil& pencil, Complex shift) {
  constexpr int attempts = 3;
  for (int attempt = 1;; ++attempt, shift *= 1.0 + besideEigenvalue) {
    auto inverse = std::make_unique<ComplexInverse>(pencil, shift);
    if (!inverse->singular()) return inverse;
    if (attempt == attempts)
      throw ModelError("The dynamic stiffness at " + scientific(std::abs(shift)) +
                       " rad/s is singular: a dof has neither stiffness nor mass.");
  }
}

/// Ritz pairs, ordered by the distance of their values from the centre.
class Nearby {
 public:
  Nearby(const RitzPairs& ritz, Complex shift, const DampedTarget& target) {
    for (Eigen::Index j = 0; j < ritz.values.size(); ++j)
      if (ritz.values[j] != 0.0) column_.push_back(j);
    for (const auto j : column_) s_.push_back(shift + 1.0 / ritz.values[j]);
    std::vector<std::size_t> order(s_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    const auto distance = [&](std::size_t j) { return std::abs(s_[j] - target.centre); };
    std::stable_sort(order.begin(), order.end(),
                     [&](auto a, auto b) { return distance(a) < distance(b); });
    int upper = 0;
    for (const auto j : order) {
      const bool within = distance(j) <= target.radius || upper < target.count;
      if (within) upper += s_[j].imag() >= 0.0 ? 1 : 0;
      (within ? wanted_ : beyond_).push_back(j);
    }
    for (const auto j : wanted_) worst_ = std::max(worst_, ritz.residuals[column_[j]]);
    enough_ = upper >= target.count;
    passed_ = !beyond_.empty();
  }

  /// Whether all wanted pairs have converged and there are others farther away.
  bool settled() const { return enough_ && passed_ && worst_ <= convergedNearby; }
  /// Positions for s() and column(), nearest first.
  const std::vector<std::size_t>& wanted() const { return wanted_; }
  Complex s(std::size_t j) const { return s_[j]; }
  Eigen::Index column(std::size_t j) const { return column_[j]; }

 private:
  std::vector<Complex> s_;
  std::vector<Eigen::Index> column_;
  std::vector<std::size_t> wanted_, beyond_;
  double worst_ = 0.0;
  bool enough_ = false, passed_ = false;
};

DampedModes checkedNearby(const ScaledPencil& pencil, const ComplexInverse& inverse,
                          const GrowingKrylov<Complex>& space, const Nearby& nearby,
                          const RitzPairs& ritz) {
  DampedModes out;
  for (const auto j : nearby.wanted()) {
    Complex s = nearby.s(j);
    if (s.imag() < 0.0) continue;
    const ComplexVector phi = space.vector(ritz, nearby.column(j)).head(pencil.size());
    ComplexVector better = inverse.again(s, phi);
    const double error = (better - phi).norm() / better.norm();
    const double allowed = acceptedError + roundingOfValue(pencil, s - inverse.shift(), better);
    if (!(error <= allowed)) {
      const auto refined = refinedMode(pencil, s, better);
      if (!refined)
        throw ConvergenceError("The damped mode at s = " + scientific(s.real()) + " + " +
                               scientific(s.imag()) + " i has a relative error of " +
                               scientific(error) + " where " + scientific(allowed) +
                               " is allowed.");
      s = refined->s, better = refined->shape;
    }
    if (isZero(pencil, s, better)) continue;
    out.values.push_back(s);
    out.vectors.push_back(std::move(better));
  }
  return out;
}

}  // namespace

QuadraticModes dampedModesNear(const Sparse& M, const Sparse& C, const Sparse& K,
                               const DampedTarget& target, const EnergyRounding& rounding) {
  const Stage stage("damped modes");
  const ScaledPencil pencil(M, C, K, rounding);
  const auto inverse = inverseNear(pencil, target.centre);
  const int all = 2 * static_cast<int>(pencil.size()), limit = std::min(all, largestNearbySpace);
  GrowingKrylov<Complex> space([&](const ComplexMatrix& z) { return (*inverse)(z); }, all);
  const bool whole = all <= 2 * denseBelow;
  if (whole)
    space.startWhole();
  else
    space.start(startColumns, 23);
  int columns = whole ? all : std::min(limit, 3 * target.count + 4 * startColumns);
  std::size_t confirmed = std::numeric_limits<std::size_t>::max();
  for (;;) {
    space.grow(columns);
    const RitzPairs ritz = space.ritz();
    const Nearby nearby(ritz, inverse->shift(), target);
    const bool known = nearby.settled() || space.invariant();
    if (whole || (known && nearby.wanted().size() == confirmed)) {
      const auto found = checkedNearby(pencil, *inverse, space, nearby, ritz);
      return presented(pencil, found, static_cast<int>(found.values.size()));
    }
    if (known) {
      // A block finds only as many copies of a repeated value as it has columns. An additional
      // start shows whether there are others.
      confirmed = nearby.wanted().size();
      space.startBeside(startColumns, 37 + static_cast<std::uint64_t>(columns));
      columns = std::min(all, columns + controlSteps * startColumns);
    } else {
      if (columns >= limit)
        throw ConvergenceError(
            "More damped modes lie near " + scientific(std::abs(target.centre)) +
            " rad/s than a Krylov space of " + std::to_string(limit) +
            " vectors can resolve. Request fewer modes, or a narrower window of frequencies.");
      columns = std::min(limit, columns + std::max(2 * startColumns, columns / 2));
    }
  }
}

}  // namespace tooljoint::linalg
