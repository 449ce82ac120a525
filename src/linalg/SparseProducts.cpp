// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/SparseProducts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include "common/Index.hpp"
#include "linalg/trilinos/DirectSolver.hpp"

namespace tooljoint::linalg {

namespace {

/// Some columns of X, stored by rows: W columns in memory, zero beyond the last one.
template <int W>
struct Panel {
  using Row = Eigen::Array<double, 1, W>;
  static constexpr int order = W == 1 ? Eigen::ColMajor : Eigen::RowMajor;

  Panel(const Matrix& X, Eigen::Index from)
      : first(from), count(std::min<Eigen::Index>(W, X.cols() - from)), values(X.rows(), W) {
    values.leftCols(count) = X.middleCols(first, count).array();
    values.rightCols(W - count).setZero();
  }
  /// The columns of this panel in a row of a matrix.
  template <class Row_>
  auto of(Row_&& row) const {
    return row.segment(first, count);
  }

  Eigen::Index first, count;
  Eigen::Array<double, Eigen::Dynamic, W, order> values;
};

/// work(panel) for all columns of X: panels of eight, the last ones of four or one.
template <class Work>
void forEachPanel(const Matrix& X, const Work& work) {
  Eigen::Index first = 0;
  while (first < X.cols()) {
    const Eigen::Index left = X.cols() - first;
    if (left == 1)
      work(Panel<1>(X, first)), first += 1;
    else if (left <= 4)
      work(Panel<4>(X, first)), first += 4;
    else
      work(Panel<8>(X, first)), first += 8;
  }
}

template <class Entry>
Matrix multiplied(const Sparse& A, const Matrix& X, const Entry& entry) {
  Matrix Y(A.rows(), X.cols());
  forEachPanel(X, [&](const auto& panel) {
    using Row = typename std::decay_t<decltype(panel)>::Row;
    for (int row = 0; row < A.rows(); ++row) {
      Row sum = Row::Zero();
      forEachInRow(
          A, row, [&](int column, double value) { sum += entry(value, panel.values.row(column)); });
      panel.of(Y.row(row)) = sum.head(panel.count).matrix();
    }
  });
  return Y;
}

/// Residual of the columns of a panel; returns their backward error, infinite if one is not finite.
template <int W>
double residualOfPanel(const Sparse& A, const Panel<W>& panel, const Matrix& B, Matrix& values) {
  using Row = typename Panel<W>::Row;
  const double few =
      1000.0 * static_cast<double>(A.rows()) * std::numeric_limits<double>::epsilon();
  const Row largest =
      panel.values.rows() > 0 ? Row(panel.values.abs().colwise().maxCoeff()) : Row(Row::Zero());
  double worst = 0.0;
  bool finite = true;
  for (int row = 0; row < A.rows(); ++row) {
    // r_i = b_i - sum_k a_ik x_k,  d_i = |b_i| + sum_k |a_ik||x_k|
    Row r = Row::Zero();
    r.head(panel.count) = panel.of(B.row(row)).array();
    Row d = r.abs();
    double rowSum = 0.0;
    forEachInRow(A, row, [&](int column, double value) {
      const Row product = value * panel.values.row(column);
      r -= product;
      d += product.abs();
      rowSum += std::abs(value);
    });
    panel.of(values.row(row)) = r.head(panel.count).matrix();
    for (Eigen::Index j = 0; j < panel.count; ++j) {
      // If all products of a row nearly vanish, it is measured against |a_i| |x|_max instead.
      if (d[j] <= few * rowSum * largest[j]) d[j] += rowSum * largest[j];
      finite = finite && std::isfinite(r[j]);
      if (r[j] != 0.0) worst = std::max(worst, std::abs(r[j]) / d[j]);
    }
  }
  return finite ? worst : std::numeric_limits<double>::infinity();
}

}  // namespace

bool isZero(const Sparse& A) { return A.cwiseAbs().sum() == 0.0; }

Matrix product(const Sparse& A, const Matrix& X) {
  return multiplied(A, X, [](double value, const auto& x) { return value * x; });
}

bool isExactlySymmetric(const Sparse& A) {
  if (A.rows() != A.cols() || !A.isCompressed()) return false;
  const int *begin = A.outerIndexPtr(), *column = A.innerIndexPtr();
  const double* value = A.valuePtr();
  // The entries (i, j) with j < i, row by row, correspond to those right of the diagonal of row j,
  // in order.
  std::vector<int> next(begin, begin + A.rows());
  for (int i = 0; i < A.rows(); ++i) {
    int k = begin[i];
    for (; k < begin[i + 1] && column[k] < i; ++k) {
      const int j = column[k], mirrored = next[at(j)]++;
      if (mirrored == begin[j + 1] || column[mirrored] != i || value[mirrored] != value[k])
        return false;
    }
    next[at(i)] = k < begin[i + 1] && column[k] == i ? k + 1 : k;
  }
  for (int i = 0; i < A.rows(); ++i)
    if (next[at(i)] != begin[i + 1]) return false;
  return true;
}

Matrix absoluteProduct(const Sparse& A, const Matrix& X) {
  return multiplied(A, X, [](double value, const auto& x) { return std::abs(value) * x.abs(); });
}

Residual residualOf(const Sparse& A, const Matrix& X, const Matrix& B) {
  Residual result{Matrix(B.rows(), B.cols()), 0.0};
  forEachPanel(X, [&](const auto& panel) {
    result.backwardError =
        std::max(result.backwardError, residualOfPanel(A, panel, B, result.values));
  });
  return result;
}

double backwardError(const Sparse& A, const Matrix& X, const Matrix& B) {
  return residualOf(A, X, B).backwardError;
}

}  // namespace tooljoint::linalg
