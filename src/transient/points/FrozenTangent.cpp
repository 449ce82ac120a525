// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/FrozenTangent.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Largest number of coordinates of a point whose tangent is decomposed: those of a node.
constexpr int widestPush = 6;
using Square =
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor, widestPush, widestPush>;

using Whole = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

Square symmetric(const Square& A) { return 0.5 * (A + A.transpose()); }

/// sum lambda q q' over lambda > 0, from the eigenvalues lambda of the symmetric part of A.
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

FrozenTangent::FrozenTangent(int points, int width) : width_(width) {
  points_.reserve(at(points));
  for (auto* array : {&P_, &ofPosition_}) array->assign(at(points * width) * at(width), 0.0);
  Rx_.assign(at(width), 0.0);
}

void FrozenTangent::freeze(const std::vector<int>& points, const double* dfdd, const double* dfdv,
                           double cd, double cv) {
  const int entries = width_ * width_;
  forget();
  points_ = points;
  for (int p : points_)
    for (int i = p * entries; i < (p + 1) * entries; ++i) {
      ofPosition_[at(i)] = cd * dfdd[i];
      P_[at(i)] = ofPosition_[at(i)] + cv * dfdv[i];
    }
}

/// P -= pushing(P). The part of df/dd becomes (P + P')/2 - pushing(P): friction follows the normal
/// force, so its tangent is not symmetric.
void FrozenTangent::takeOutPush() {
  if (width_ > widestPush) return;
  Eigen::SelfAdjointEigenSolver<Square> parts(width_);
  for (int p : points_) {
    Eigen::Map<Square> tangent(&P_[at(p * width_ * width_)], width_, width_),
        ofPosition(&ofPosition_[at(p * width_ * width_)], width_, width_);
    if (tangent.diagonal().maxCoeff() > 0) tangent -= pushing(tangent, parts);
    ofPosition = symmetric(ofPosition);
    ofPosition -= pushing(ofPosition, parts);
  }
}

/// Tangents A = k n n' and B with another k and n have |<A, B>| / (|A| |B|) = (n_A . n_B)^2.
void FrozenTangent::leaveOutTurning(const double* then, double most) {
  const double least = std::cos(most) * std::cos(most);
  for (int p : points_) {
    Eigen::Map<Whole> now(&ofPosition_[at(p * width_ * width_)], width_, width_);
    const Eigen::Map<const Whole> later(then + p * width_ * width_, width_, width_);
    const double product = std::sqrt(now.squaredNorm() * later.squaredNorm());
    if (std::abs(now.cwiseProduct(later).sum()) < least * product) now.setZero();
  }
}

void FrozenTangent::forget() {
  const int entries = width_ * width_;
  for (int p : points_)
    for (auto* array : {&P_, &ofPosition_})
      std::fill(array->begin() + p * entries, array->begin() + (p + 1) * entries, 0.0);
  points_.clear();
}

void FrozenTangent::drop(int point) {
  const int entries = width_ * width_;
  std::fill(P_.begin() + point * entries, P_.begin() + (point + 1) * entries, 0.0);
}

void FrozenTangent::subtract(const PointRows& rows, double* values) const {
  for (int p : points_) rows.subtract(p, &P_[at(p * width_ * width_)], values);
}

void FrozenTangent::subtractOfPosition(const PointRows& rows, double* values) const {
  for (int p : points_) rows.subtract(p, &ofPosition_[at(p * width_ * width_)], values);
}

void FrozenTangent::addTimes(const PointRows& rows, const double* x, double* y) const {
  for (int p : points_) {
    for (int k = 0; k < width_; ++k) Rx_[at(k)] = rows.times(p * width_ + k, x);
    for (int c = 0; c < width_; ++c) {
      double force = 0;
      for (int k = 0; k < width_; ++k) force += P_[at((p * width_ + c) * width_ + k)] * Rx_[at(k)];
      rows.add(p * width_ + c, force, y);
    }
  }
}

double FrozenTangent::times(const PointRows& rows, int row, const double* x) const {
  const int first = row / width_ * width_;
  double sum = 0;
  for (int k = 0; k < width_; ++k) sum += P_[at(row * width_ + k)] * rows.times(first + k, x);
  return sum;
}

void FrozenTangent::save(std::vector<double>& memory) const {
  memory.push_back(static_cast<double>(points_.size()));
  for (int p : points_) {
    memory.push_back(p);
    for (const auto* array : {&P_, &ofPosition_})
      memory.insert(memory.end(), array->begin() + p * width_ * width_,
                    array->begin() + (p + 1) * width_ * width_);
  }
}

void FrozenTangent::restore(const double*& memory) {
  forget();
  points_.assign(at(static_cast<int>(*memory++)), 0);
  for (int& p : points_) {
    p = static_cast<int>(*memory++);
    for (auto* array : {&P_, &ofPosition_})
      for (int i = p * width_ * width_; i < (p + 1) * width_ * width_; ++i)
        (*array)[at(i)] = *memory++;
  }
}

}  // namespace tooljoint::transient
