// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/ResidualFlexibility.hpp"

#include <algorithm>
#include <limits>

#include "common/Error.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::estimate {

ResidualFlexibility::ResidualFlexibility(const model::Substructure& part,
                                         const reduction::Basis& basis, const Sparse& stiffness)
    : interior_(basis.partition.interior) {
  const int size = static_cast<int>(interior_.size());
  std::vector<int> columns;
  for (int k = 0; k < basis.modes(); ++k)
    if (basis.modeKind[static_cast<std::size_t>(k)] != reduction::followingKind)
      columns.push_back(static_cast<int>(basis.partition.boundary.size()) + k);
  truncated_ = std::max(0, size - static_cast<int>(columns.size()));
  if (truncated_ == 0) return;
  stiffness_ = reduction::block(stiffness, interior_, interior_);
  mass_ = reduction::block(part.model.mass, interior_, interior_);
  factor_ = std::make_unique<Eigen::SparseLU<Eigen::SparseMatrix<double>>>();
  factor_->compute(Eigen::SparseMatrix<double>(stiffness_));
  if (factor_->info() != Eigen::Success)
    throw ModelError("Part \"" + part.name +
                     "\": its interior is a mechanism with its interface and retained dofs fixed, "
                     "so the error of its reduction cannot be "
                     "estimated. Retain more dofs there, or remove \"Error Estimate\".");
  if (columns.empty()) return;
  modes_ = reduction::block(basis.vectors, interior_, columns);
  const Matrix projected = modes_.transpose() * (stiffness_ * modes_);
  modalFactor_.compute(projected);
}

Matrix ResidualFlexibility::apply(const Matrix& r) const {
  if (truncated_ == 0) return Matrix::Zero(r.rows(), r.cols());
  Matrix x = factor_->solve(r);
  if (modes_.cols() > 0) x.noalias() -= modes_ * modalFactor_.solve(modes_.transpose() * r);
  return x;
}

ResidualFlexibility::Step ResidualFlexibility::step(const Vector& r, const Vector& g) const {
  Step step;
  if (truncated_ == 0) return step;
  Matrix V(r.size(), 2);
  V.col(0) = apply(r);
  const double size = V.col(0).norm();
  if (!(size > 0)) return step;
  V.col(0) /= size;
  V.col(1) = apply(mass_ * V.col(0));
  const double before = V.col(1).norm();
  V.col(1) -= V.col(0) * V.col(0).dot(V.col(1));
  const double after = V.col(1).norm();
  V.col(1) *= truncated_ > 1 && after > 1e-8 * before ? 1.0 / after : 0.0;
  step.residual = V.transpose() * r;
  step.inertia = V.transpose() * g;
  step.stiffness = V.transpose() * (stiffness_ * V);
  step.mass = V.transpose() * (mass_ * V);
  return step;
}

double ResidualFlexibility::Step::excess(double lambda, double mu) const {
  const Eigen::Vector2d b = residual + (lambda - mu) * inertia;
  const Eigen::Matrix2d A = stiffness - mu * mass;
  if (mass(0, 0) == 0) return 0;
  if (mass(1, 1) == 0) return b[0] * b[0] / A(0, 0);
  return b.dot(A.inverse() * b);
}

double ResidualFlexibility::Step::pole() const {
  if (mass(0, 0) == 0) return std::numeric_limits<double>::infinity();
  if (mass(1, 1) == 0) return stiffness(0, 0) / mass(0, 0);
  return Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix2d>(stiffness, mass,
                                                                   Eigen::EigenvaluesOnly)
      .eigenvalues()[0];
}

}  // namespace tooljoint::estimate
