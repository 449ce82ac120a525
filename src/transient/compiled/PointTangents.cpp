// SPDX-License-Identifier: BSD-3-Clause
// Tangents of a PointBatch: frozen for a factor and added to matrices on the pattern.
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <limits>

#include "common/Index.hpp"
#include "transient/compiled/PointBatch.hpp"

namespace tooljoint::transient {
namespace {

/// Coordinates of a point up to which its tangent is taken apart: those of a node.
constexpr int widestPush = 6;
using Square =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, widestPush, widestPush>;

Square symmetric(const Square& A) { return 0.5 * (A + A.transpose()); }

/// sum lambda q q' over lambda > 0, where lambda q q' make up the symmetric part of A.
Square pushing(const Square& A, Eigen::SelfAdjointEigenSolver<Square>& parts) {
  Square sum = Square::Zero(A.rows(), A.cols());
  if (parts.compute(symmetric(A)).info() != Eigen::Success) return sum;
  for (int i = 0; i < A.rows(); ++i)
    if (parts.eigenvalues()[i] > 0)
      sum.noalias() += parts.eigenvalues()[i] * parts.eigenvectors().col(i) *
                       parts.eigenvectors().col(i).transpose();
  return sum;
}

}  // namespace

void PointBatch::freezeTangent(double cd, double cv) {
  const int entries = width_ * width_;
  forgetTangent();
  frozen_ = active_;
  for (int p : frozen_) isFrozen_[at(p)] = 1;
  for (int p : frozen_)
    for (int i = p * entries; i < (p + 1) * entries; ++i) {
      positionP_[at(i)] = cd * dfdd_[at(i)];
      P_[at(i)] = positionP_[at(i)] + cv * dfdv_[at(i)];
    }
}

/// P -= pushing(P), and (P + P')/2 - pushing(P) of its part of df/dd: friction, which follows the
/// normal force, is no part of what is symmetric.
void PointBatch::takeOutPush() {
  if (width_ > widestPush) return;
  Eigen::SelfAdjointEigenSolver<Square> parts(width_);
  for (int p : frozen_) {
    Eigen::Map<Square> tangent(&P_[at(p * width_ * width_)], width_, width_),
        ofPosition(&positionP_[at(p * width_ * width_)], width_, width_);
    if (tangent.diagonal().maxCoeff() > 0) tangent -= pushing(tangent, parts);
    ofPosition = symmetric(ofPosition);
    ofPosition -= pushing(ofPosition, parts);
  }
}

void PointBatch::forgetTangent() {
  const int entries = width_ * width_;
  for (int p : frozen_) {
    std::fill(P_.begin() + p * entries, P_.begin() + (p + 1) * entries, 0.0);
    std::fill(positionP_.begin() + p * entries, positionP_.begin() + (p + 1) * entries, 0.0);
    isFrozen_[at(p)] = 0;
  }
  frozen_.clear();
}

void PointBatch::subtractTangent(double* values) const {
  for (int p : frozen_) rows_.subtract(p, &P_[at(p * width_ * width_)], values);
}

void PointBatch::subtractPositionTangent(double* values) const {
  for (int p : frozen_) rows_.subtract(p, &positionP_[at(p * width_ * width_)], values);
}

void PointBatch::addTangentTimes(const double* x, double* y) const {
  for (int p : frozen_) {
    double* Rx = small_.data();
    for (int k = 0; k < width_; ++k) Rx[k] = rows_.times(p * width_ + k, x);
    for (int c = 0; c < width_; ++c) {
      double force = 0;
      for (int k = 0; k < width_; ++k) force += P_[at((p * width_ + c) * width_ + k)] * Rx[k];
      rows_.add(p * width_ + c, force, y);
    }
  }
}

void PointBatch::dropTangent(int point) {
  const int entries = width_ * width_;
  std::fill(P_.begin() + point * entries, P_.begin() + (point + 1) * entries, 0.0);
}

double PointBatch::frozenTimes(int row, const double* x) const {
  const int point = row / width_;
  if (std::find(frozen_.begin(), frozen_.end(), point) == frozen_.end()) return 0.0;
  double sum = 0;
  for (int k = 0; k < width_; ++k)
    sum += P_[at(row * width_ + k)] * rows_.times(point * width_ + k, x);
  return sum;
}

}  // namespace tooljoint::transient
