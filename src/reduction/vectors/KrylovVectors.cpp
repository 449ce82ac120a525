// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/vectors/KrylovVectors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "reduction/vectors/FixedInterfaceModes.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

using constants::twoPi;
/// Smallest fraction of a vector (mass norm) that is independent of the other vectors.
constexpr double independent = 1e-8;

/// The Krylov space of one interior block that touches boundary dofs. With y = x_I - psi x_C and B1
/// = C_IC + C_II psi, B2 = M_IC + M_II psi,
///
///     (s^2 M + s C + K) y = -(s B1 + s^2 B2) x_C.
///
/// Undamped, in lambda = s^2 about lambda_0 = -omega_0^2: r_0 = A^-1 B2, r_j = -A^-1 M r_j-1, A = K
/// - omega_0^2 M. Damped, about the real s_0: r_0 = A^-1 [B2 B1], r_j = -A^-1 (D r_j-1 + M r_j-2),
/// A = K + s_0 C + s_0^2 M, D = C + 2 s_0 M; the recurrence runs on states z_j = (r_j, r_j-1),
/// which are orthonormalised separately, so that deflation loses no direction.
class DrivenBlock {
 public:
  DrivenBlock(const PartView& part, int number, const KrylovOptions& options)
      : block_(part.interiorBlock(number)),
        M_(block_.mass),
        number_(number),
        damped_(options.damped),
        who_(part.who("Krylov vectors")) {
    set_ = std::make_unique<OrthonormalSet>(M_, independent, who_);
    const Sparse& K = block_.stiffness;
    const auto& inner = block_.positions;
    const double omega = twoPi * options.frequency;
    const Sparse C = part.model().dampingAt(options.time);
    Sparse A = K - omega * omega * M_;
    if (damped_) {
      const Sparse inside = block(C, inner, inner);
      A = K + omega * inside + omega * omega * M_;
      D_ = inside + 2.0 * omega * M_;
    }
    try {
      solver_ = std::make_unique<linalg::DirectSolver>(A, block_.name);
    } catch (const ModelError& error) {
      throw ModelError(who_ + "the dynamic stiffness is singular at " +
                       formatNumber(options.frequency) +
                       " Hz, a natural frequency of the part with its boundary dofs fixed. Choose "
                       "another \"Expansion Frequency\". " +
                       error.what());
    }
    makeStates();
    const Matrix psi = part.constraintModes().vectors;
    const std::vector<int> all = range(psi.rows());
    Matrix B = block(part.mass(), inner, all) * psi;
    if (damped_) {
      B.conservativeResize(Eigen::NoChange, 2 * B.cols());
      B.rightCols(psi.cols()) = block(C, inner, all) * psi;
    }
    const Matrix r = solve(withoutZeroColumns(B));
    prepare(damped_ ? stacked(r, Matrix::Zero(r.rows(), r.cols())) : r);
  }

  int size() const { return set_->size(); }
  /// True if the space is the whole interior, or the whole part of it with mass.
  bool complete() const { return exhausted_ || set_->size() == block_.size(); }
  double residual() const { return residual_; }
  /// Adds the Ritz vectors of the space.
  void addTo(InteriorVectors& vectors) const {
    const std::size_t first = vectors.vectors.size();
    addRitzVectors(symmetricPart(block_.stiffness), M_, set_->basis(), number_, "krylov", vectors);
    for (std::size_t k = first; k < vectors.vectors.size(); ++k)
      vectors.vectors[k].residual = residual_;
  }

  /// Relative size of the new directions of the next block; decreasing.
  const Vector& sizes() const { return sizes_; }

  /// Adds the next block completely and prepares the one after it.
  void advance() {
    for (Eigen::Index j = 0; j < directions_.cols(); ++j) set_->add(directions_.col(j));
    follow();
  }

  /// Adds one direction of the next block; the space is not continued after that.
  void take(Eigen::Index direction) { set_->add(directions_.col(direction)); }

  /// If the interface drives no further direction, adds arbitrary directions, so that the space can
  /// still become the whole interior. Massless dofs depend on the others statically.
  void restart(int count) {
    const auto seed = static_cast<std::uint64_t>(97 + set_->size());
    Matrix z = linalg::scatteredNumbers(
        M_.rows(), std::min<Eigen::Index>(count, M_.rows() - set_->size()), seed);
    if (linalg::hasMasslessMotion(M_)) z = solve(M_ * z);
    findDirections(z);
    exhausted_ = directions_.cols() == 0;
    last_.resize(states_->basis().rows(), 0);
  }

 private:
  static Matrix stacked(const Matrix& top, const Matrix& bottom) {
    Matrix z(top.rows() + bottom.rows(), top.cols());
    z << top, bottom;
    return z;
  }

  static Matrix withoutZeroColumns(const Matrix& B) {
    std::vector<int> used;
    for (int j = 0; j < B.cols(); ++j)
      if (!B.col(j).isZero(0.0)) used.push_back(j);
    return B(Eigen::all, used);
  }

  Matrix solve(const Matrix& b) {
    if (b.cols() == 0) return b;
    Matrix x = solver_->solve(b);
    residual_ = std::max(residual_, solver_->lastResidual());
    return x;
  }

  /// States are measured by r_j' M r_j + r_j-1' M r_j-1 / gamma^2, gamma^2 = tr K / tr M, so that
  /// both terms have the same unit.
  void makeStates() {
    if (!damped_) {
      states_ = std::make_unique<OrthonormalSet>(M_, independent, who_);
      return;
    }
    const double mass = M_.diagonal().sum(), stiff = block_.stiffness.diagonal().cwiseAbs().sum();
    const double scale = stiff > 0 ? mass / stiff : 1.0;
    const auto n = static_cast<int>(M_.rows());
    Triplets entries;
    forEachEntry(M_, [&](int i, int j, double value) {
      entries.emplace_back(i, j, value);
      entries.emplace_back(n + i, n + j, scale * value);
    });
    states_ = std::make_unique<OrthonormalSet>(sparse(2 * n, 2 * n, entries), independent, who_);
  }

  /// Computes the states after those of the last block.
  void follow() {
    const auto n = M_.rows();
    if (!damped_) return prepare(Matrix(-solve(M_ * last_)));
    const Matrix r = last_.topRows(n), before = last_.bottomRows(n);
    prepare(stacked(-solve(D_ * r + M_ * before), r));
  }

  void prepare(const Matrix& z) {
    findDirections(z.topRows(M_.rows()));
    const int old = states_->size();
    for (Eigen::Index j = 0; j < z.cols(); ++j) states_->add(z.col(j));
    last_ = states_->basis().rightCols(states_->size() - old);
    // A block may contain nothing new and still lead to new directions.
    if (directions_.cols() == 0 && last_.cols() > 0) follow();
  }

  /// The new part of the columns r, each relative to its own length: r_k / |r_k| = Q h + Q_new R, R
  /// = U S W'; directions Q_new U of sizes S.
  void findDirections(const Matrix& r) {
    OrthonormalSet grown = *set_;
    const int old = grown.size();
    std::vector<Vector> factors;
    for (Eigen::Index j = 0; j < r.cols(); ++j) {
      const double length = grown.norm(r.col(j));
      if (length == 0.0) continue;
      factors.emplace_back();
      grown.add(r.col(j) / length, factors.back());
    }
    const int fresh = grown.size() - old;
    directions_.resize(M_.rows(), 0);
    sizes_.resize(0);
    if (fresh == 0) return;
    Matrix R = Matrix::Zero(fresh, sizeOf(factors));
    for (int j = 0; j < sizeOf(factors); ++j) {
      const Vector& factor = factors[at(j)];
      R.col(j).head(factor.size() - old) = factor.tail(factor.size() - old);
    }
    const auto svd = linalg::singularValues(R, linalg::SingularVectors::Thin);
    directions_ = grown.basis().rightCols(fresh) * svd.U;
    sizes_ = svd.values;
  }

  const InteriorBlock& block_;
  const Sparse& M_;
  int number_;
  bool damped_;
  std::string who_;
  Sparse D_;
  std::unique_ptr<linalg::DirectSolver> solver_;
  std::unique_ptr<OrthonormalSet> set_;     ///< the space
  std::unique_ptr<OrthonormalSet> states_;  ///< z_j
  Matrix last_;                             ///< the last of them
  Matrix directions_;                       ///< new directions of the next block
  Vector sizes_;
  double residual_ = 0;
  bool exhausted_ = false;
};

/// Grows the spaces of all interior blocks together, block by block.
class Growth {
 public:
  explicit Growth(std::vector<DrivenBlock>& spaces) : spaces_(spaces) {}

  int blocks() const { return blocks_; }  ///< number of complete ones: moments matched
  int size() const {
    int sum = 0;
    for (const auto& space : spaces_) sum += space.size();
    return sum;
  }

  /// Grows to `count` vectors, or to all that exist.
  void grow(int count) {
    while (size() < count) {
      int more = 0;
      for (const auto& space : spaces_) more += static_cast<int>(space.sizes().size());
      if (more == 0) {
        exhausted_ = true;
        if (!restart(count - size())) return;
        continue;
      }
      if (size() + more > count) return fill(count - size());
      for (auto& space : spaces_) space.advance();
      if (!exhausted_) ++blocks_;
    }
  }

 private:
  bool restart(int count) {
    bool any = false;
    for (auto& space : spaces_) {
      if (space.complete()) continue;
      space.restart(count);
      any = true;
    }
    return any;
  }

  /// Adds the largest directions of a block that does not fit completely; directions of equal size
  /// stay together.
  void fill(int count) {
    struct Direction {
      double size;
      DrivenBlock* space;
      Eigen::Index index;
    };
    std::vector<Direction> all;
    for (auto& space : spaces_)
      for (Eigen::Index i = 0; i < space.sizes().size(); ++i)
        all.push_back({space.sizes()[i], &space, i});
    std::stable_sort(all.begin(), all.end(),
                     [](const Direction& a, const Direction& b) { return a.size > b.size; });
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (static_cast<int>(k) >= count && all[k].size < (1 - clusterTolerance) * all[k - 1].size)
        return;
      all[k].space->take(all[k].index);
    }
  }

  std::vector<DrivenBlock>& spaces_;
  int blocks_ = 0;
  bool exhausted_ = false;
};

/// Number of vectors of the driven blocks.
int wanted(const PartView& part, const std::vector<int>& driven, const ModeRequest& request) {
  if (request.kind == ModeRequest::Kind::Count) return request.count;
  if (request.kind == ModeRequest::Kind::All) return std::numeric_limits<int>::max();
  int count = 0;
  for (int i : driven) {
    const InteriorBlock& b = part.interiorBlock(i);
    count +=
        linalg::eigenvaluesBelow(b.symmetricStiffness, b.mass, request.omegaMax * request.omegaMax);
  }
  return count;
}

}  // namespace

InteriorVectors krylovVectors(const PartView& part, const ModeRequest& request,
                              const KrylovOptions& options) {
  std::vector<int> driven, floating;
  for (int i = 0; i < part.blocks(); ++i)
    (part.interiorBlock(i).floats() ? floating : driven).push_back(i);
  std::vector<DrivenBlock> spaces;
  for (int i : driven) spaces.emplace_back(part, i, options);
  Growth growth(spaces);
  growth.grow(wanted(part, driven, request));

  InteriorVectors result;
  result.groups = part.blockPositions();
  for (const auto& space : spaces) space.addTo(result);
  const int found = sizeOf(result.vectors);
  if (!floating.empty()) {
    InteriorVectors modes = fixedInterfaceModes(part, request, floating, "fixed-interface modes");
    result.orthogonality = std::max(result.orthogonality, modes.orthogonality);
    for (int k = 0; k < modes.kept; ++k) {
      modes.vectors[at(k)].why = "of a block without coupling to boundary dofs";
      modes.vectors[at(k)].name.clear();
      result.vectors.push_back(modes.vectors[at(k)]);
    }
  }
  result.keepAll();
  result.complete = result.kept == sizeOf(part.partition().interior);
  result.method = "Krylov, " + std::to_string(growth.blocks()) + " complete blocks";
  if (found > 0 && request.count > found) result.remarkOnCount(request, found, "Krylov vectors");
  if (growth.blocks() == 0 && found > 0)
    result.remarks.push_back("the " + std::to_string(found) +
                             " Krylov vectors are the dominant directions of the first block, "
                             "which has more: no moment is matched completely");
  return result;
}

}  // namespace tooljoint::reduction
