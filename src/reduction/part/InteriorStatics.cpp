// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/part/InteriorStatics.hpp"

#include <Eigen/Dense>
#include <cmath>
#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::reduction {

namespace {

/// A rigid-body mode of which the kept dofs carry less than this share (in the root of the mass)
/// does not move them.
constexpr double notMoved = 1e-6;

double largestEntry(const Sparse& A) {
  return A.nonZeros() > 0
             ? Eigen::Map<const Vector>(A.valuePtr(), A.nonZeros()).cwiseAbs().maxCoeff()
             : 0.0;
}

Matrix rows(const Matrix& A, const std::vector<int>& which) {
  Matrix out(static_cast<Eigen::Index>(which.size()), A.cols());
  for (std::size_t i = 0; i < which.size(); ++i)
    out.row(static_cast<Eigen::Index>(i)) = A.row(which[i]);
  return out;
}

}  // namespace

Sparse bordered(const Sparse& A, const Matrix& U, const Matrix& W) {
  const double size = largestEntry(A) > 0 ? largestEntry(A) : 1.0;
  const auto n = static_cast<int>(A.rows());
  Triplets entries;
  for (int i = 0; i < A.outerSize(); ++i)
    for (Sparse::InnerIterator it(A, i); it; ++it)
      entries.emplace_back(i, static_cast<int>(it.col()), it.value());
  for (int k = 0; k < U.cols(); ++k) {
    const double u = size / U.col(k).cwiseAbs().maxCoeff(),
                 w = size / W.col(k).cwiseAbs().maxCoeff();
    for (int i = 0; i < n; ++i) {
      if (U(i, k) != 0.0) entries.emplace_back(i, n + k, u * U(i, k));
      if (W(i, k) != 0.0) entries.emplace_back(n + k, i, w * W(i, k));
    }
  }
  Sparse out(n + U.cols(), n + U.cols());
  out.setFromTriplets(entries.begin(), entries.end());
  return out;
}

InteriorStatics::InteriorStatics(const model::Substructure& part, const Partition& partition,
                                 const Sparse& K, const FreeInterfaceModes& modes)
    : partition_(partition),
      KII_(block(K, partition.interior, partition.interior)),
      KIC_(block(K, partition.interior, partition.kept)),
      MII_(block(part.model.mass, partition.interior, partition.interior)) {
  const Vector mass = part.model.mass.diagonal();
  keptMass_.resize(static_cast<Eigen::Index>(partition.kept.size()));
  for (Eigen::Index j = 0; j < keptMass_.size(); ++j)
    keptMass_[j] = std::sqrt(mass[partition.kept[at(j)]]);
  findMechanisms(modes);
  factor(part);
}

/// Combinations of the rigid-body modes of each free link that are zero on its kept dofs: right
/// singular vectors of the kept rows.
void InteriorStatics::findMechanisms(const FreeInterfaceModes& modes) {
  const auto interior = static_cast<Eigen::Index>(partition_.interior.size());
  mechanisms_.resize(interior, 0);
  carriers_.resize(partition_.size, 0);
  for (int link = 0; link < static_cast<int>(modes.links.size()); ++link) {
    FreeInterfaceModes own;
    own.links = modes.links;
    for (const auto& mode : modes.modes)
      if (mode.rigid && mode.link == link) own.modes.push_back(mode);
    if (own.modes.empty()) continue;
    const Matrix all = own.columns(static_cast<int>(own.modes.size()), partition_.size);
    Matrix combined = rows(all, partition_.interior);
    if (keptMass_.size() > 0) {
      const Matrix moved = keptMass_.asDiagonal() * rows(all, partition_.kept);
      const Eigen::JacobiSVD<Matrix> svd(moved, Eigen::ComputeFullV);
      Eigen::Index rank = 0;
      while (rank < svd.singularValues().size() && svd.singularValues()[rank] > notMoved) ++rank;
      combined = (combined * svd.matrixV().rightCols(all.cols() - rank)).eval();
      carriers_.conservativeResize(partition_.size, carriers_.cols() + rank);
      carriers_.rightCols(rank) = all * svd.matrixV().leftCols(rank);
    }
    mechanisms_.conservativeResize(interior, mechanisms_.cols() + combined.cols());
    mechanisms_.rightCols(combined.cols()) = combined;
  }
}

void InteriorStatics::factor(const model::Substructure& part) {
  if (partition_.interior.empty()) return;
  const Matrix MN = MII_ * mechanisms_;
  const auto name = [&](int i) {
    if (i >= static_cast<int>(partition_.interior.size()))
      return std::string("a rigid-body motion of the interior");
    return model::describe(part.model.dofs[at(partition_.interior[at(i)])],
                           part.model.componentNames);
  };
  try {
    solver_ = std::make_unique<linalg::DirectSolver>(
        mechanisms_.cols() > 0 ? bordered(KII_, MN, MN) : KII_, name);
    if (mechanisms_.cols() == 0) return;
    mechanisms_ -= solve(
        KII_ * mechanisms_);  // N to the accuracy of K_II: the modes have that of the eigensolver
    const Eigen::LLT<Matrix> gram(mechanisms_.transpose() * (MII_ * mechanisms_));
    mechanisms_ = gram.matrixU().solve<Eigen::OnTheRight>(mechanisms_).eval();
  } catch (const ModelError& error) {
    throw ModelError("Part \"" + part.name +
                     "\": the stiffness of its interior is singular while its " +
                     std::to_string(partition_.kept.size()) +
                     " interface and retained dofs are held, and that is no rigid-body motion. "
                     "Retain a dof that moves then, or check the part's stiffness. " +
                     error.what());
  }
}

Matrix InteriorStatics::solve(const Matrix& loads) const {
  if (loads.rows() == 0 || loads.cols() == 0) return loads;
  if (solver_->size() == loads.rows()) return solver_->solve(loads);
  Matrix extended = Matrix::Zero(solver_->size(), loads.cols());
  extended.topRows(loads.rows()) = loads;
  return solver_->solve(extended).topRows(loads.rows());
}

ConstraintModes InteriorStatics::constraintModes() const {
  ConstraintModes result;
  const auto kept = static_cast<Eigen::Index>(partition_.kept.size());
  result.residuals = Vector::Zero(kept);
  for (int j = 0; j < kept; ++j) result.entries.emplace_back(partition_.kept[at(j)], j, 1.0);
  if (partition_.interior.empty() || kept == 0) return result;
  const Matrix KIC = KIC_;
  const Matrix phi = solve(-KIC);  // K_II phi_C = -K_IC
  const Matrix defect = KII_ * phi + KIC;
  const double norm = (KII_.cwiseAbs() * Vector::Ones(KII_.cols())).maxCoeff();
  for (int j = 0; j < kept; ++j) {
    const double scale = norm * phi.col(j).cwiseAbs().maxCoeff() + KIC.col(j).cwiseAbs().maxCoeff();
    if (scale > 0.0) result.residuals[j] = defect.col(j).cwiseAbs().maxCoeff() / scale;
    for (Eigen::Index i = 0; i < phi.rows(); ++i)
      if (phi(i, j) != 0.0) result.entries.emplace_back(partition_.interior[at(i)], j, phi(i, j));
  }
  return result;
}

}  // namespace tooljoint::reduction
