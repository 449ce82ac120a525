// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/project/FullBasis.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"
#include "linalg/DenseKernels.hpp"

namespace tooljoint::reduction {

namespace {

constexpr Eigen::Index manyRows = 2000, rowsAtATime = 512;

/// to += factor times a row of Phi, or times its absolute values.
template <bool absolute = false>
void addRow(const Sparse& Phi, Eigen::Index row, double factor, Eigen::Ref<Vector> to) {
  const int first = Phi.outerIndexPtr()[row], count = Phi.outerIndexPtr()[row + 1] - first;
  const Eigen::Map<const Vector> values(Phi.valuePtr() + first, count);
  if (count == Phi.cols()) {
    if constexpr (absolute)
      to += factor * values.cwiseAbs();
    else
      to += factor * values;
    return;
  }
  for (int k = 0; k < count; ++k)
    to[Phi.innerIndexPtr()[first + k]] += factor * (absolute ? std::abs(values[k]) : values[k]);
}

/// Calls work(first, rows) with consecutive rows of Phi as the columns of a matrix.
template <class Work>
void forRows(const Sparse& Phi, const Work& work) {
  for (Eigen::Index first = 0; first < Phi.rows(); first += rowsAtATime) {
    Matrix rows = Matrix::Zero(Phi.cols(), std::min(rowsAtATime, Phi.rows() - first));
    for (Eigen::Index i = 0; i < rows.cols(); ++i) addRow(Phi, first + i, 1.0, rows.col(i));
    work(first, rows);
  }
}

}  // namespace

bool isLargeAndFull(const Sparse& Phi) {
  return Phi.isCompressed() && Phi.rows() >= manyRows && Phi.cols() > 0 &&
         static_cast<double>(Phi.nonZeros()) >=
             fullFrom * static_cast<double>(Phi.rows()) * static_cast<double>(Phi.cols());
}

Matrix projectByRows(const Sparse& A, const Sparse& Phi) {
  Matrix sum = Matrix::Zero(Phi.cols(), Phi.cols());
  forRows(Phi, [&](Eigen::Index first, const Matrix& rows) {
    Matrix images = Matrix::Zero(rows.rows(), rows.cols());  // rows of A Phi
    for (Eigen::Index i = 0; i < rows.cols(); ++i)
      forEachInRow(A, first + i, [&](int column, double value) {
        if (value != 0.0) addRow(Phi, column, value, images.col(i));
      });
    linalg::addTransposedProduct(rows, images, sum);
  });
  return sum;
}

Vector absoluteEnergiesByRows(const Sparse& A, const Sparse& Phi) {
  Vector sums = Vector::Zero(Phi.cols()), image(Phi.cols());
  forRows(Phi, [&](Eigen::Index first, const Matrix& rows) {
    for (Eigen::Index i = 0; i < rows.cols(); ++i) {
      image.setZero();
      forEachInRow(A, first + i, [&](int column, double value) {
        if (value != 0.0) addRow<true>(Phi, column, std::abs(value), image);
      });
      sums += rows.col(i).cwiseAbs().cwiseProduct(image);
    }
  });
  return sums;
}

Matrix gramByRows(const Sparse& Phi) {
  Matrix sum = Matrix::Zero(Phi.cols(), Phi.cols());
  forRows(Phi,
          [&](Eigen::Index, const Matrix& rows) { linalg::addTransposedProduct(rows, rows, sum); });
  return sum;
}

Matrix timesByRows(const Sparse& Phi, const Matrix& q) {
  Matrix result(Phi.rows(), q.cols());
  forRows(Phi, [&](Eigen::Index first, const Matrix& rows) {
    result.middleRows(first, rows.cols()) = linalg::transposedTimes(rows, q);
  });
  return result;
}

}  // namespace tooljoint::reduction
