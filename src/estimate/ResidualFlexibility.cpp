// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/ResidualFlexibility.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "linalg/factor/FactorMemory.hpp"
#include "model/DofNames.hpp"
#include "reduction/vectors/ModalVectors.hpp"

namespace tooljoint::estimate {

namespace {

/// Remainder of a static response outside the basis, relative to the response, below which it is
/// rounding and has no direction.
constexpr double rounding = 1e-12;

/// Shift of the stiffness of a floating interior, relative to omega^2 of the lowest vibration in
/// the basis. Its motions at zero are in the basis; the static response of the others changes by
/// less than this.
constexpr double small = 1e-3;

/// Eigenvalues of a basis below this part of the largest are zero.
constexpr double zeroBelow = 1e-8;

/// omega^2 of the lowest mode of the basis above zero [rad^2/s^2]; 0 if there is none.
double lowestVibration(const reduction::Basis& basis) {
  if (basis.modes() == 0) return 0.0;
  const double zero = zeroBelow * basis.eigenvalues.maxCoeff();
  for (const double value : basis.eigenvalues)
    if (value > zero && value > 0.0) return value;
  return 0.0;
}

}  // namespace

ResidualFlexibility::ResidualFlexibility(const model::Substructure& part,
                                         const reduction::Basis& basis,
                                         const model::SharedSparse& stiffness,
                                         parallel::Ranks ranks)
    : interior_(basis.partition.interior) {
  const int size = static_cast<int>(interior_.size());
  std::vector<int> columns;
  for (int k = 0; k < basis.modes(); ++k)
    if (basis.modeKind[static_cast<std::size_t>(k)] != reduction::followingKind)
      columns.push_back(static_cast<int>(basis.partition.boundary.size()) + k);
  truncated_ = std::max(0, size - static_cast<int>(columns.size()));
  if (truncated_ == 0) return;
  stiffness_ = reduction::interiorOf(basis.partition, stiffness);
  mass_ = reduction::interiorOf(basis.partition, part.model.mass);
  modes_ = reduction::block(basis.vectors, interior_, columns);
  factor(part, basis, ranks);
}

void ResidualFlexibility::factor(const model::Substructure& part, const reduction::Basis& basis,
                                 parallel::Ranks ranks) {
  const auto name = model::namer(part.model, interior_);
  linalg::DirectSolverOptions options;
  options.ranks = ranks;
  double shift = 0.0;
  try {
    solver_ = std::make_unique<linalg::DirectSolver>(stiffness_, name, options);
  } catch (const linalg::MemoryError&) {
    throw;
  } catch (const ModelError& error) {
    shift = small * lowestVibration(basis);
    try {
      if (shift > 0)
        solver_ = std::make_unique<linalg::DirectSolver>(Sparse(stiffness_ + shift * mass_), name,
                                                         options);
    } catch (const ModelError&) {
    }
    if (!solver_)
      throw ModelError("Part " + inQuotes(part.name) +
                       ": its interior is a mechanism with its interface and retained dofs fixed, "
                       "so the error of its reduction cannot be estimated. Retain more dofs there, "
                       "or do without estimates: remove \"Error Estimate\" and tolerances where "
                       "the deck has them. " +
                       error.what());
  }
  if (modes_.cols() == 0) return;
  Matrix weighted = stiffness_ * modes_;
  if (shift > 0) weighted += shift * (mass_ * modes_);
  modalFactor_ = linalg::DenseLu(Matrix(modes_.transpose() * weighted));
}

Matrix ResidualFlexibility::apply(const Matrix& r) const {
  if (truncated_ == 0) return Matrix::Zero(r.rows(), r.cols());
  Matrix x = solver_->solve(r);
  if (modes_.cols() == 0) return x;
  const Vector whole = x.colwise().norm();
  x.noalias() -= modes_ * modalFactor_.solve(Matrix(modes_.transpose() * r));
  for (Eigen::Index j = 0; j < x.cols(); ++j)
    if (x.col(j).norm() <= rounding * whole[j]) x.col(j).setZero();
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
