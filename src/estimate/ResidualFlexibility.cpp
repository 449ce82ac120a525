// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/ResidualFlexibility.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/factor/MumpsFactor.hpp"
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
  const std::string mechanism =
      "Part \"" + part.name +
      "\": its interior is a mechanism with its interface and retained dofs fixed, so the error of "
      "its reduction cannot be estimated. Retain more dofs there, or remove \"Error Estimate\".";
  if (linalg::suitsMumps(stiffness_)) {
    try {
      large_ = std::make_unique<linalg::DirectSolver>(stiffness_);
    } catch (const ModelError& error) {
      throw ModelError(mechanism + " " + error.what());
    }
  } else {
    factor_ = std::make_unique<Eigen::SparseLU<Eigen::SparseMatrix<double>>>();
    factor_->compute(Eigen::SparseMatrix<double>(stiffness_));
    if (factor_->info() != Eigen::Success) throw ModelError(mechanism);
  }
  if (columns.empty()) return;
  modes_ = reduction::block(basis.vectors, interior_, columns);
  const Matrix projected = modes_.transpose() * (stiffness_ * modes_);
  modalFactor_ = linalg::DenseLu(projected);
}

Matrix ResidualFlexibility::solve(const Matrix& r) const {
  return large_ ? large_->solve(r) : Matrix(factor_->solve(r));
}

Matrix ResidualFlexibility::apply(const Matrix& r) const {
  if (truncated_ == 0) return Matrix::Zero(r.rows(), r.cols());
  Matrix x = solve(r);
  if (modes_.cols() > 0) x.noalias() -= modes_ * modalFactor_.solve(Matrix(modes_.transpose() * r));
  return x;
}

ResidualFlexibility::Step ResidualFlexibility::step(const Vector& r, const Vector& g) const {
  return steps(r, g).front();
}

std::vector<ResidualFlexibility::Step> ResidualFlexibility::steps(const Matrix& R,
                                                                  const Matrix& G) const {
  std::vector<Step> result(at(R.cols()));
  if (truncated_ == 0) return result;
  Matrix first = apply(R);
  for (Eigen::Index j = 0; j < R.cols(); ++j)
    if (const double size = first.col(j).norm(); size > 0) first.col(j) /= size;
  const Matrix second = apply(mass_ * first);
  for (Eigen::Index j = 0; j < R.cols(); ++j) {
    if (!(first.col(j).norm() > 0)) continue;
    Step& step = result[at(j)];
    Matrix V(R.rows(), 2);
    V.col(0) = first.col(j);
    V.col(1) = second.col(j);
    const double before = V.col(1).norm();
    V.col(1) -= V.col(0) * V.col(0).dot(V.col(1));
    const double after = V.col(1).norm();
    V.col(1) *= truncated_ > 1 && after > 1e-8 * before ? 1.0 / after : 0.0;
    step.residual = V.transpose() * R.col(j);
    step.inertia = V.transpose() * G.col(j);
    step.stiffness = V.transpose() * (stiffness_ * V);
    step.mass = V.transpose() * (mass_ * V);
  }
  return result;
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
  return linalg::symmetricPairs(Matrix(stiffness), Matrix(mass)).values[0];
}

}  // namespace tooljoint::estimate
