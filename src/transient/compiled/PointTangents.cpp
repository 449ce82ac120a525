// SPDX-License-Identifier: BSD-3-Clause
// Tangents of a PointBatch: frozen for a factor, added to matrices on the pattern, and what a
// matrix is at a point.
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

void PointBatch::project(int point, const double* values, double* block) const {
  const int w = width_;
  if (single_) {
    for (int i = 0; i < w * w; ++i) {
      const std::size_t address = entryAddress_[at(point * w * w + i)];
      block[i] = address == noEntry ? 0.0 : values[address];
    }
    return;
  }
  std::fill(block, block + w * w, 0.0);
  const int first = touchBegin_[at(point)];
  const int count = touchBegin_[at(point + 1)] - first;
  for (int a = 0; a < count; ++a)
    for (int b = 0; b < count; ++b) {
      const Touch& row = touches_[at(first + a)];
      const Touch& column = touches_[at(first + b)];
      const double* Z = values + pairOffset_[at(pairBegin_[at(point)] + a * count + b)];
      for (int j = 0; j < column.width; ++j)
        for (int i = 0; i < row.width; ++i)
          for (int k = 0; k < w; ++k) {
            const double left = touchRows_[row.rows + at(i * w + k)] * Z[j * row.width + i];
            for (int l = 0; l < w; ++l)
              block[k * w + l] += left * touchRows_[column.rows + at(j * w + l)];
          }
    }
}

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

void PointBatch::subtractTangent(double* values) const { subtract(P_, values); }

void PointBatch::subtractPositionTangent(double* values) const { subtract(positionP_, values); }

void PointBatch::subtract(const std::vector<double>& frozen, double* values) const {
  const int entries = width_ * width_;
  if (single_) {
    for (int p : frozen_)
      for (int i = p * entries; i < (p + 1) * entries; ++i)
        if (entryAddress_[at(i)] != noEntry) values[entryAddress_[at(i)]] -= frozen[at(i)];
    return;
  }
  for (int p : frozen_) {
    const double* P = &frozen[at(p * entries)];
    const int first = touchBegin_[at(p)];
    const int count = touchBegin_[at(p + 1)] - first;
    for (int b = 0; b < count; ++b) {
      const Touch& column = touches_[at(first + b)];
      for (int j = 0; j < column.width; ++j) {
        // PR_j = P R(:, j);  A(:, j) -= R' PR_j
        const double* Rj = &touchRows_[column.rows + at(j * width_)];
        bool zero = true;
        for (int c = 0; c < width_; ++c) zero = zero && Rj[c] == 0.0;
        if (zero) continue;
        double* PRj = small_.data();
        for (int r = 0; r < width_; ++r) {
          PRj[r] = 0;
          for (int c = 0; c < width_; ++c) PRj[r] += P[r * width_ + c] * Rj[c];
        }
        for (int a = 0; a < count; ++a) {
          const Touch& row = touches_[at(first + a)];
          double* target =
              values + pairOffset_[at(pairBegin_[at(p)] + a * count + b)] + at(j * row.width);
          const double* R = &touchRows_[row.rows];
          for (int i = 0; i < row.width; ++i) {
            double sum = 0;
            for (int r = 0; r < width_; ++r) sum += R[i * width_ + r] * PRj[r];
            target[i] -= sum;
          }
        }
      }
    }
  }
}

void PointBatch::addTangentTimes(const double* x, double* y) const {
  const int entries = width_ * width_;
  for (int p : frozen_) {
    double* Rx = small_.data();
    for (int c = 0; c < width_; ++c) {
      const int r = p * width_ + c;
      Rx[c] = single_ ? (index_[at(r)] < 0 ? 0.0 : x[index_[at(r)]]) : rowTimes(r, x);
    }
    for (int c = 0; c < width_; ++c) {
      const int r = p * width_ + c;
      double force = 0;
      for (int k = 0; k < width_; ++k) force += P_[at(p * entries + c * width_ + k)] * Rx[k];
      if (single_) {
        if (index_[at(r)] >= 0) y[index_[at(r)]] += force;
      } else {
        for (int i = rowBegin_[at(r)]; i < rowBegin_[at(r + 1)]; ++i)
          y[column_[at(i)]] += value_[at(i)] * force;
      }
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
    sum += P_[at(row * width_ + k)] * rowTimesVector(point * width_ + k, x);
  return sum;
}

}  // namespace tooljoint::transient
