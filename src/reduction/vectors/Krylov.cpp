// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Constraint modes and Krylov vectors of the interior driven by the kept dofs: quasi-static modes
/// (W.-H. Shyu, Z.-D. Ma, G. M. Hulbert, A new component mode synthesis method: quasi-static mode
/// compensation, Finite Elements in Analysis and Design 24 (1997) 271-281) and, for damped parts,
/// second-order Krylov vectors (Z. Bai, Y. Su, SOAR: A second-order Arnoldi method for the solution
/// of the quadratic eigenvalue problem, SIAM J. Matrix Anal. Appl. 26 (2005) 640-659; Dimension
/// reduction of large-scale second-order dynamical systems via a second-order Arnoldi method, SIAM
/// J. Sci. Comput. 26 (2005) 1692-1709).
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <utility>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::reduction {

namespace {

using constants::twoPi;

struct KrylovOptions {
  double frequency = 0;  ///< expansion point [Hz]; with damping s0 = 2 pi f on the real axis
  bool damped = false;
  double time = 0;  ///< of the laws of the damping matrices [s]
  double deflation = 1e-8;
};

/// The Krylov space of one link that touches kept dofs. With y = x_I - psi x_C and B1 = C_IC + C_II
/// psi, B2 = M_IC + M_II psi,
///
///     (s^2 M + s C + K) y = -(s B1 + s^2 B2) x_C.
///
/// Undamped, in lambda = s^2 about lambda_0 = -omega_0^2: r_0 = A^-1 B2, r_j = -A^-1 M r_j-1, A = K
/// - omega_0^2 M. Damped, about the real s_0: r_0 = A^-1 [B2 B1], r_j = -A^-1 (D r_j-1 + M r_j-2),
/// A = K + s_0 C + s_0^2 M, D = C + 2 s_0 M; the recurrence runs on states z_j = (r_j, r_j-1),
/// which are orthonormalised by themselves, so that deflation loses nothing.
class DrivenLink {
 public:
  DrivenLink(const model::Substructure& part, const Partition& p, const Sparse& psi, int link,
             const KrylovOptions& options)
      : damped_(options.damped),
        who_("Part \"" + part.name + "\", Krylov vectors: "),
        inner_(positionsOf(p, p.links[static_cast<std::size_t>(link)])) {
    K_ = block(constantStiffness(part.model), inner_, inner_);
    M_ = block(part.model.mass, inner_, inner_);
    set_ = std::make_unique<OrthonormalSet>(M_, options.deflation, who_);
    const double omega = twoPi * options.frequency;
    const Sparse C = part.model.dampingAt(options.time);
    Sparse A = K_ - omega * omega * M_;
    if (damped_) {
      const Sparse inside = block(C, inner_, inner_);
      A = K_ + omega * inside + omega * omega * M_;
      D_ = inside + 2.0 * omega * M_;
    }
    try {
      solver_ = std::make_unique<linalg::DirectSolver>(A, namer(part, inner_));
    } catch (const ModelError& error) {
      throw ModelError(who_ + "the dynamic stiffness at " + formatNumber(options.frequency) +
                       " Hz is singular: that is a natural frequency of the part with its kept "
                       "dofs held. Take another \"Expansion Frequency\". " +
                       error.what());
    }
    makeStates(options.deflation);
    std::vector<int> all(static_cast<std::size_t>(p.size));
    for (int i = 0; i < p.size; ++i) all[static_cast<std::size_t>(i)] = i;
    Matrix B = block(part.model.mass, inner_, all) * Matrix(psi);
    if (damped_) {
      B.conservativeResize(Eigen::NoChange, 2 * B.cols());
      B.rightCols(psi.cols()) = block(C, inner_, all) * Matrix(psi);
    }
    const Matrix r = solve(withoutZeroColumns(B));
    prepare(damped_ ? stacked(r, Matrix::Zero(r.rows(), r.cols())) : r);
  }

  int size() const { return set_->size(); }
  /// Nothing is left: the space is all of the interior, or all that has mass.
  bool complete() const { return exhausted_ || set_->size() == static_cast<int>(inner_.size()); }
  double residual() const { return residual_; }
  const Matrix& space() const { return set_->basis(); }
  const Sparse& mass() const { return M_; }
  const Sparse& stiffness() const { return K_; }

  /// How large what the next block adds is, beside the vectors it comes from; decreasing.
  const Vector& sizes() const { return sizes_; }

  /// Takes the next block whole and prepares the one after it.
  void advance() {
    for (Eigen::Index j = 0; j < directions_.cols(); ++j) set_->add(directions_.col(j));
    follow();
  }

  /// Takes one direction of the next block; the space is not continued after that.
  void take(Eigen::Index direction) { set_->add(directions_.col(direction)); }

  /// The interface drives nothing more: directions without meaning, so that the space can still
  /// become all of the interior. Dofs without mass follow the others statically.
  void restart(int count) {
    const auto seed = static_cast<std::uint64_t>(97 + set_->size());
    Matrix z = linalg::scatteredNumbers(
        M_.rows(), std::min<Eigen::Index>(count, M_.rows() - set_->size()), seed);
    if (linalg::hasMasslessDofs(M_)) z = solve(M_ * z);
    findDirections(z);
    exhausted_ = directions_.cols() == 0;
    block_.resize(states_->basis().rows(), 0);
  }

 private:
  static Matrix stacked(const Matrix& top, const Matrix& bottom) {
    Matrix z(top.rows() + bottom.rows(), top.cols());
    z << top, bottom;
    return z;
  }

  static Matrix withoutZeroColumns(const Matrix& B) {
    Matrix out(B.rows(), 0);
    for (Eigen::Index j = 0; j < B.cols(); ++j) {
      if (B.col(j).isZero(0.0)) continue;
      out.conservativeResize(Eigen::NoChange, out.cols() + 1);
      out.rightCols(1) = B.col(j);
    }
    return out;
  }

  Matrix solve(const Matrix& b) {
    if (b.cols() == 0) return b;
    const Matrix x = solver_->solve(b);
    residual_ = std::max(residual_, solver_->lastResidual());
    return x;
  }

  /// States are measured by r_j' M r_j + r_j-1' M r_j-1 / gamma^2, gamma^2 = tr K / tr M, which
  /// gives both the same unit.
  void makeStates(double deflation) {
    if (!damped_) {
      states_ = std::make_unique<OrthonormalSet>(M_, deflation, who_);
      return;
    }
    const double mass = M_.diagonal().sum(), stiff = K_.diagonal().cwiseAbs().sum();
    const double scale = stiff > 0 ? mass / stiff : 1.0;
    const auto n = static_cast<int>(M_.rows());
    Triplets entries;
    for (int i = 0; i < n; ++i)
      for (Sparse::InnerIterator it(M_, i); it; ++it) {
        const int j = static_cast<int>(it.col());
        entries.emplace_back(i, j, it.value());
        entries.emplace_back(n + i, n + j, scale * it.value());
      }
    Sparse weights(2 * n, 2 * n);
    weights.setFromTriplets(entries.begin(), entries.end());
    states_ = std::make_unique<OrthonormalSet>(weights, deflation, who_);
  }

  /// The states after those of the last block.
  void follow() {
    const auto n = M_.rows();
    if (!damped_) return prepare(Matrix(-solve(M_ * block_)));
    const Matrix r = block_.topRows(n), before = block_.bottomRows(n);
    prepare(stacked(-solve(D_ * r + M_ * before), r));
  }

  void prepare(const Matrix& z) {
    findDirections(z.topRows(M_.rows()));
    const int old = states_->size();
    for (Eigen::Index j = 0; j < z.cols(); ++j) states_->add(z.col(j));
    block_ = states_->basis().rightCols(states_->size() - old);
    // A block may repeat what is there and still lead on to what is not.
    if (directions_.cols() == 0 && block_.cols() > 0) follow();
  }

  /// What is new in the columns r, each measured by itself: r_k / |r_k| = Q h + Q_new R, R = U S
  /// W'; directions Q_new U of sizes S.
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
    Matrix R = Matrix::Zero(fresh, static_cast<Eigen::Index>(factors.size()));
    for (std::size_t j = 0; j < factors.size(); ++j)
      R.col(static_cast<Eigen::Index>(j)).head(factors[j].size() - old) =
          factors[j].tail(factors[j].size() - old);
    const Eigen::JacobiSVD<Matrix> svd(R, Eigen::ComputeThinU);
    directions_ = grown.basis().rightCols(fresh) * svd.matrixU();
    sizes_ = svd.singularValues();
  }

  bool damped_;
  std::string who_;
  std::vector<int> inner_;
  Sparse K_, M_, D_;
  std::unique_ptr<linalg::DirectSolver> solver_;
  std::unique_ptr<OrthonormalSet> set_;     ///< the space
  std::unique_ptr<OrthonormalSet> states_;  ///< z_j
  Matrix block_;                            ///< the last of them
  Matrix directions_;                       ///< what the next block adds
  Vector sizes_;
  double residual_ = 0;
  bool exhausted_ = false;
};

/// Grows the spaces of all links together, block by block.
class Growth {
 public:
  explicit Growth(std::vector<DrivenLink>& links) : links_(links) {}

  int blocks() const { return blocks_; }  ///< complete ones: moments matched
  int size() const {
    int sum = 0;
    for (const auto& link : links_) sum += link.size();
    return sum;
  }

  /// To `count` vectors, or all there are.
  void grow(int count) {
    while (size() < count) {
      int more = 0;
      for (const auto& link : links_) more += static_cast<int>(link.sizes().size());
      if (more == 0) {
        exhausted_ = true;
        if (!restart(count - size())) return;
        continue;
      }
      if (size() + more > count) return fill(count - size());
      for (auto& link : links_) link.advance();
      if (!exhausted_) ++blocks_;
    }
  }

 private:
  bool restart(int count) {
    bool any = false;
    for (auto& link : links_) {
      if (link.complete()) continue;
      link.restart(count);
      any = true;
    }
    return any;
  }

  /// The largest directions of a block that does not fit whole; those of equal size stay together.
  void fill(int count) {
    struct Direction {
      double size;
      DrivenLink* link;
      Eigen::Index index;
    };
    std::vector<Direction> all;
    for (auto& link : links_)
      for (Eigen::Index i = 0; i < link.sizes().size(); ++i)
        all.push_back({link.sizes()[i], &link, i});
    std::stable_sort(all.begin(), all.end(),
                     [](const Direction& a, const Direction& b) { return a.size > b.size; });
    for (std::size_t k = 0; k < all.size(); ++k) {
      if (static_cast<int>(k) >= count && all[k].size < (1 - clusterTolerance) * all[k - 1].size)
        return;
      all[k].link->take(all[k].index);
    }
  }

  std::vector<DrivenLink>& links_;
  int blocks_ = 0;
  bool exhausted_ = false;
};

class Krylov : public ReductionMethod {
 public:
  explicit Krylov(const KrylovOptions& options) : options_(options) {}

  Basis build(const model::Substructure& part, const ModeRequest& request) const override {
    const Partition p = partition(part);
    const Sparse K = constantStiffness(part.model);
    const ConstraintModes constraint = constraintModes(part, p, K);
    Sparse psi(p.size, static_cast<Eigen::Index>(p.kept.size()));
    psi.setFromTriplets(constraint.entries.begin(), constraint.entries.end());

    std::vector<DrivenLink> links;
    std::vector<int> driven, free;
    for (int i = 0; i < static_cast<int>(p.links.size()); ++i)
      (p.ends[static_cast<std::size_t>(i)].empty() ? free : driven).push_back(i);
    for (int i : driven) links.emplace_back(part, p, psi, i, options_);
    Growth growth(links);
    growth.grow(wanted(part, p, driven, request));

    std::vector<ModalVector> vectors;
    double orthogonality = 0, residual = 0;
    for (std::size_t i = 0; i < links.size(); ++i) {
      double defect = 0;
      for (auto& vector : ritzVectors(symmetricPart(links[i].stiffness()), links[i].mass(),
                                      links[i].space(), driven[i], "krylov", defect)) {
        vector.residual = links[i].residual();
        vectors.push_back(vector);
      }
      orthogonality = std::max(orthogonality, defect);
      residual = std::max(residual, links[i].residual());
    }
    const int found = static_cast<int>(vectors.size());
    addFloating(part, p, free, request, vectors, orthogonality);
    Basis basis = fixedInterfaceBasis(part, p, constraint, p.links, std::move(vectors));
    basis.orthogonality = orthogonality;
    basis.method = "Krylov, " + std::to_string(growth.blocks()) + " complete blocks";
    remark(basis, request, found, growth.blocks());
    return basis;
  }

 private:
  /// Vectors asked of the links that are driven; a cut-off frequency asks for as many as there are
  /// fixed-interface modes below it.
  static int wanted(const model::Substructure& part, const Partition& p,
                    const std::vector<int>& driven, const ModeRequest& request) {
    if (request.kind == ModeRequest::Kind::Count) return request.count;
    if (request.kind == ModeRequest::Kind::All) return std::numeric_limits<int>::max();
    int count = 0;
    const Sparse K = symmetricPart(constantStiffness(part.model));
    for (int i : driven) {
      const auto inner = positionsOf(p, p.links[static_cast<std::size_t>(i)]);
      count +=
          linalg::eigenvaluesBelow(block(K, inner, inner), block(part.model.mass, inner, inner),
                                   request.omegaMax * request.omegaMax);
    }
    return count;
  }

  /// Links that touch no kept dof are not driven: they keep their lowest modes, the ways they float
  /// first.
  static void addFloating(const model::Substructure& part, const Partition& p,
                          const std::vector<int>& free, const ModeRequest& request,
                          std::vector<ModalVector>& vectors, double& orthogonality) {
    if (free.empty()) return;
    Partition rest = p;
    rest.links.clear();
    rest.ends.clear();
    for (int i : free) {
      rest.links.push_back(p.links[static_cast<std::size_t>(i)]);
      rest.ends.emplace_back();
    }
    const FixedInterfaceModes modes =
        fixedInterfaceModes(part, rest, symmetricPart(constantStiffness(part.model)), request);
    orthogonality = std::max(orthogonality, modes.orthogonality);
    for (int k = 0; k < modes.kept; ++k) {
      const FixedInterfaceMode& mode = modes.modes[static_cast<std::size_t>(k)];
      vectors.push_back({mode.eigenvalue, free[static_cast<std::size_t>(mode.link)], mode.shape,
                         mode.residual, "fixed-interface", "of a piece no kept dof touches"});
    }
  }

  static void remark(Basis& basis, const ModeRequest& request, int found, int blocks) {
    if (request.kind == ModeRequest::Kind::Count && request.count > found && found > 0)
      basis.remarks.push_back("asked for " + std::to_string(request.count) +
                              " Krylov vectors, kept all " + std::to_string(found) + " there are");
    if (blocks == 0 && found > 0)
      basis.remarks.push_back("the " + std::to_string(found) +
                              " Krylov vectors are the largest directions of the first block, "
                              "which is longer: no moment is "
                              "matched in full");
  }

  KrylovOptions options_;
};

deck::ListSpec ownParameters() {
  using deck::Range;
  deck::ListSpec list(
      "Krylov",
      "Vectors that match moments of what the interior answers to motions of the kept dofs.");
  list.real("Expansion Frequency", "Hz", 0.0, Range::nonNegative(),
            "Where moments are matched: at this frequency, or with \"Damped\" at s = 2 pi times "
            "this on the real axis. Take the middle of the band of interest; "
            "0 gives quasi-static vectors.")
      .expert();
  list.boolean("Damped", false,
               "Second-order Krylov vectors of mass, damping and stiffness (Bai and Su 2005) "
               "instead of those of mass and stiffness alone.")
      .expert();
  list.real("Time", "s", 0.0, Range::any(),
            "When damping that varies, as gyroscopics do with the speed, is looked at; used with "
            "\"Damped\".");
  list.real("Deflation", "", 1e-8, Range{0.0, 0.1, true, false},
            "The part of a vector, measured by mass, that must be new for the vector to be taken.")
      .expert();
  return list;
}

const bool registered = MethodRegistry::instance().add(
    "Krylov", {"Constraint modes and Krylov vectors that match moments of the interior at one "
               "frequency (Shyu, Ma and Hulbert 1997; Bai and Su 2005).",
               ownParameters(), [](const Teuchos::ParameterList& given) {
                 Teuchos::ParameterList list(given);  // an absent list has no defaults
                 KrylovOptions options;
                 options.frequency = list.get("Expansion Frequency", options.frequency);
                 options.damped = list.get("Damped", options.damped);
                 options.time = list.get("Time", options.time);
                 options.deflation = list.get("Deflation", options.deflation);
                 return std::unique_ptr<ReductionMethod>(new Krylov(options));
               }});

}  // namespace

}  // namespace tooljoint::reduction
