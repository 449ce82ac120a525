// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/multilevel/TreeModes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "common/report/StageTimes.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/multilevel/RankRows.hpp"
#include "reduction/multilevel/TreeSubspace.hpp"

namespace tooljoint::reduction {

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
/// Shift, and its step for condensed masses, as a fraction of the stiffness over mass of one dof:
/// far above rounding, far below the modes of a part with many dofs.
constexpr double smallShift = 1e-10, shiftStep = 1e-9;
/// For a part with negative eigenvalues the shift grows by this factor until K + shift M is
/// definite.
constexpr double shiftGrowth = 100.0;
/// Guard modes beyond the wanted ones: they show where a pair ends, and the last modes of a block
/// converge last.
constexpr int leastGuard = 8, guardShare = 4;
/// Number of modes per piece for the first estimate of the frequency range.
constexpr int firstModes = 6;
/// An eigenvalue below this fraction of the shift belongs to a rigid-body mode.
constexpr double rigid = 1e-3;
/// Smallest 1 - lambda / lambda_c in an estimate.
constexpr double leastRoom = 0.02;
/// A mode with an error below this fraction of the accuracy is not corrected further.
constexpr double settled = 1e-2;
/// A correction of unit mass with a smaller remainder is already in the span.
constexpr double dependent = 1e-7;

/// Median of K_ii / M_ii, over dofs with mass.
double stiffnessOverMass(const Sparse& K, const Sparse& M) {
  std::vector<double> ratios;
  const Vector k = K.diagonal(), m = M.diagonal();
  for (Eigen::Index i = 0; i < k.size(); ++i)
    if (m[i] > 0.0 && k[i] > 0.0) ratios.push_back(k[i] / m[i]);
  if (ratios.empty()) return 1.0;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return *middle;
}

/// Vectors with their products, rows of this rank, and their Ritz values.
struct Block {
  Matrix X, KX, MX;
  Vector values;
};

/// Rayleigh-Ritz steps; sums over all rows are summed over the ranks.
class RitzSteps {
 public:
  RitzSteps(const Sparse& K, const Sparse& M) : K_(K), M_(M), rows_(K.rows()) {}

  Block productsOf(const Matrix& X) const {
    return {X.middleRows(rows_.first(), rows_.count()),
            K_.middleRows(rows_.first(), rows_.count()) * X,
            M_.middleRows(rows_.first(), rows_.count()) * X,
            {}};
  }
  const RankRows& rows() const { return rows_; }

  static Matrix gram(const Matrix& A, const Matrix& B) {
    return sumOverRanks(linalg::transposedTimes(A, B));
  }

  /// The lowest `count` Ritz vectors of the span.
  static void rayleighRitz(Block& block, Eigen::Index count) {
    const Matrix k = gram(block.X, block.KX), m = gram(block.X, block.MX);
    const auto pairs = linalg::symmetricPairs(0.5 * (k + k.transpose()), 0.5 * (m + m.transpose()));
    if (!pairs.converged)
      throw ConvergenceError("The QR iteration for the modes of a cut part did not converge.");
    block.values = pairs.values.head(count);
    turn(block, pairs.vectors.leftCols(count));
  }

  /// Adds the new part of Z to mass-orthonormal vectors.
  void append(Block& block, const Matrix& Z) const {
    Block more = productsOf(Z);
    for (int pass = 0; pass < 2; ++pass) {
      const Matrix part = gram(block.MX, more.X);
      linalg::addProduct(-1.0, block.X, part, more.X);
      linalg::addProduct(-1.0, block.KX, part, more.KX);
      linalg::addProduct(-1.0, block.MX, part, more.MX);
      const Vector lengths = gram(more.X, more.MX).diagonal().cwiseMax(0.0).cwiseSqrt();
      const Vector scale = (lengths.array() > 0.0).select(lengths.cwiseInverse(), 0.0);
      for (Matrix* A : {&more.X, &more.KX, &more.MX}) *A = *A * scale.asDiagonal();
    }
    const Matrix m = gram(more.X, more.MX);
    if (m.size() == 0) return;
    const auto pairs = linalg::symmetricPairs(0.5 * (m + m.transpose()));
    const Eigen::Index kept = (pairs.values.array() > dependent).count();
    turn(more, pairs.vectors.rightCols(kept) *
                   pairs.values.tail(kept).cwiseSqrt().cwiseInverse().asDiagonal());
    const Eigen::Index known = block.X.cols();
    for (auto [A, added] : {std::pair{&block.X, &more.X}, std::pair{&block.KX, &more.KX},
                            std::pair{&block.MX, &more.MX}}) {
      A->conservativeResize(Eigen::NoChange, known + kept);
      A->rightCols(kept) = *added;
      added->resize(0, 0);
    }
  }

 private:
  static void turn(Block& block, const Matrix& Y) {
    for (Matrix* A : {&block.X, &block.KX, &block.MX}) {
      Matrix turned = Matrix::Zero(A->rows(), Y.cols());
      linalg::addProduct(1.0, *A, Y, turned);
      *A = std::move(turned);
    }
  }

  const Sparse &K_, &M_;
  RankRows rows_;
};

/// Chooses the subspace for the request; returns its cut-off [lambda].
double choose(const ModeRequest& request, int needed, const TreeModesOptions& options,
              const TreeFactor& factor, TreeSubspace& subspace) {
  using Kind = ModeRequest::Kind;
  if (request.kind == Kind::All) {
    subspace.takeBelow(infinity);
    return infinity;
  }
  const double shift = factor.shift();
  double highest = request.omegaMax * request.omegaMax;
  if (request.kind == Kind::Count) {
    const int pieces = sizeOf(factor.tree().pieces);
    int each = 2 * needed / pieces + firstModes;
    for (subspace.takeLowest(each); subspace.size() < needed && !subspace.complete();)
      subspace.takeLowest(each *= 2);
    linalg::RitzRequest lowest;
    lowest.count = std::min(needed, subspace.size());
    const Vector found = subspace.ritz(lowest).values;
    if (found.size() == 0) return infinity;
    highest = std::max(0.0, found[found.size() - 1] - shift);
  }
  // Rigid-body modes are at `shift`.
  double cut = std::max(options.cutOffFactor * options.cutOffFactor * highest, 10.0 * shift);
  for (subspace.takeBelow(cut + shift);
       request.kind == Kind::Count && subspace.size() < needed && !subspace.complete();)
    subspace.takeBelow((cut *= 4.0) + shift);
  return subspace.complete() ? infinity : cut;
}

/// Estimated relative errors of the frequencies, and Z = (K + shift M)^-1 (K - lambda M) X.
/// \param missing  no mode with a smaller eigenvalue is missing
Vector estimate(const Block& block, const RankRows& rows, const TreeFactor& factor, double missing,
                Matrix& Z) {
  const Matrix R = block.KX - block.MX * block.values.asDiagonal();
  Z = factor.solve(rows.all(R));
  const Vector products =
      RitzSteps::gram(R, Matrix(Z.middleRows(rows.first(), rows.count()))).diagonal();
  Vector errors = Vector::Zero(block.values.size());
  for (Eigen::Index j = 0; j < errors.size(); ++j) {
    const double lambda = block.values[j];
    if (std::abs(lambda) <= rigid * factor.shift()) continue;
    const double room = std::max(leastRoom, 1.0 - std::max(0.0, lambda) / missing);
    errors[j] = 0.5 * std::abs(products[j]) / (room * std::abs(lambda));
  }
  return errors;
}

}  // namespace

std::shared_ptr<const TreeFactor> eliminate(std::shared_ptr<const SubstructureTree> tree,
                                            const Sparse& K, const Sparse& M) {
  const double scale = stiffnessOverMass(K, M);
  for (double shift = smallShift * scale; shift < 1e3 * scale; shift *= shiftGrowth) {
    const double step = std::max(shiftStep * scale, 0.01 * shift);
    auto factor = std::make_shared<const TreeFactor>(tree, K, M, shift, step);
    if (factor->definite()) return factor;
    log::info("The part is not definite with a shift of " + formatNumber(-shift) +
              " 1/s^2: a larger one is tried.");
  }
  throw ModelError(
      "no shift makes stiffness and mass positive definite: the mass is indefinite, or some motion "
      "has neither stiffness nor mass");
}

TreeModes treeModes(const Sparse& K, const Sparse& M, const TreeFactor& factor,
                    const ModeRequest& request, const TreeModesOptions& options) {
  using Kind = ModeRequest::Kind;
  TreeModes modes;
  const auto n = static_cast<int>(K.rows());
  const int needed = std::min(n, request.count + std::max(leastGuard, request.count / guardShare));
  TreeSubspace subspace(factor);
  const double shift = factor.shift();
  const double cut = choose(request, needed, options, factor, subspace);

  linalg::RitzRequest ritz;
  if (request.kind == Kind::Count) ritz.count = std::min(needed, subspace.size());
  if (request.kind == Kind::Below) {
    const double highest = request.omegaMax * (1.0 + 2.0 * request.pairTolerance);
    ritz.below = highest * highest + 2.0 * shift;
    const auto below = static_cast<int>(subspace.ritz(ritz).values.size());
    ritz = {};
    ritz.count = std::min(subspace.size(), below + std::max(leastGuard, below / guardShare));
  }
  const auto found = subspace.ritz(ritz);
  modes.complete = subspace.complete() && found.complete;
  modes.coordinates = subspace.size();
  modes.cutOff = std::sqrt(cut);
  if (found.values.size() == 0) {  // no dof has mass, or no piece has such a low mode
    modes.vectors.resize(n, 0);
    return modes;
  }
  const Matrix recovered = subspace.recover(found.vectors);
  const Stage stage("modes of a cut part");
  const RitzSteps steps(K, M);
  Block block = steps.productsOf(recovered);
  const Eigen::Index count = block.X.cols();
  RitzSteps::rayleighRitz(block, count);
  for (;; ++modes.corrections) {
    stopIfInterrupted();
    Matrix Z;
    // after a correction only modes just above the block are missing
    const double missing = modes.corrections == 0 || modes.complete ? cut : block.values[count - 1];
    modes.errors = estimate(block, steps.rows(), factor, missing, Z);
    modes.wanted = static_cast<int>(count);
    if (request.kind == Kind::Count) modes.wanted = std::min(request.count, modes.wanted);
    if (request.kind == Kind::Below) {
      modes.wanted = 0;
      while (modes.wanted < count && signedOmega(block.values[modes.wanted]) <= request.omegaMax)
        ++modes.wanted;
    }
    const double worst = modes.wanted > 0 ? modes.errors.head(modes.wanted).maxCoeff() : 0.0;
    if (worst <= options.accuracy || modes.corrections == options.corrections) break;
    std::vector<int> open;  // the z of accurate modes are rounding
    for (int j = 0; j < count; ++j)
      if (modes.errors[j] > settled * options.accuracy) open.push_back(j);
    steps.append(block, Matrix(Z(Eigen::all, open)));
    RitzSteps::rayleighRitz(block, count);
  }
  modes.values = block.values;
  modes.vectors = steps.rows().all(block.X);
  return modes;
}

}  // namespace tooljoint::reduction
