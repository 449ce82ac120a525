// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/BlockKernels.hpp"

#include <algorithm>
#include <utility>

namespace tooljoint::linalg::kernel {
namespace {

using Strided = Eigen::Map<Eigen::MatrixXd, 0, Eigen::OuterStride<>>;

double& at(double* a, int n, int i, int j) { return a[static_cast<std::ptrdiff_t>(j) * n + i]; }

/// Factor columns [begin, end) below the diagonal, pivoting on scaled rows; whole rows are swapped.
int factorPanel(int n, double* a, double* scale, int* pivots, int begin, int end) {
  for (int k = begin; k < end; ++k) {
    int p = k;
    double best = -1;
    for (int i = k; i < n; ++i) {
      const double size = std::abs(at(a, n, i, k)) / scale[i];
      if (size > best) best = size, p = i;
    }
    if (!(best > smallestPivot)) return k;
    pivots[k] = p;
    if (p != k) {
      for (int j = 0; j < n; ++j) std::swap(at(a, n, k, j), at(a, n, p, j));
      std::swap(scale[k], scale[p]);
    }
    const double reciprocal = 1.0 / at(a, n, k, k);
    for (int i = k + 1; i < n; ++i) at(a, n, i, k) *= reciprocal;
    for (int j = k + 1; j < end; ++j) {
      const double factor = at(a, n, k, j);
      if (factor == 0.0) continue;
      double* column = &at(a, n, 0, j);
      const double* l = &at(a, n, 0, k);
      for (int i = k + 1; i < n; ++i) column[i] -= l[i] * factor;
    }
  }
  return -1;
}

}  // namespace

int factorLarge(int n, double* a, const double* scale, double* workScale, int* pivots) {
  constexpr int panel = 24;
  std::copy(scale, scale + n, workScale);
  for (int begin = 0; begin < n; begin += panel) {
    const int end = std::min(n, begin + panel);
    const int bad = factorPanel(n, a, workScale, pivots, begin, end);
    if (bad >= 0) return bad;
    if (end == n) break;
    // U12 = L11^-1 A12;  A22 -= L21 U12
    const int rest = n - end;
    for (int j = end; j < n; ++j)
      for (int k = begin; k < end; ++k) {
        const double factor = at(a, n, k, j);
        for (int i = k + 1; i < end; ++i) at(a, n, i, j) -= at(a, n, i, k) * factor;
      }
    const Eigen::OuterStride<> stride(n);
    Strided(&at(a, n, end, end), rest, rest, stride).noalias() -=
        Strided(&at(a, n, end, begin), rest, end - begin, stride) *
        Strided(&at(a, n, begin, end), end - begin, rest, stride);
  }
  return -1;
}

void solveLarge(int n, int columns, const double* lu, const int* pivots, double* B) {
  const ConstBlock factors(lu, n, n);
  for (int c = 0; c < columns; ++c) {
    double* x = B + static_cast<std::ptrdiff_t>(c) * n;
    for (int k = 0; k < n; ++k)
      if (pivots[k] != k) std::swap(x[k], x[pivots[k]]);
    MutableSegment segment(x, n);
    factors.triangularView<Eigen::UnitLower>().solveInPlace(segment);
    factors.triangularView<Eigen::Upper>().solveInPlace(segment);
  }
}

int invertLarge(int n, double* a, const double* scale, double* workScale, int* pivots,
                double* panel) {
  const int bad = factorLarge(n, a, scale, workScale, pivots);
  if (bad >= 0) return bad;
  std::fill(panel, panel + n * n, 0.0);
  for (int i = 0; i < n; ++i) panel[i * (n + 1)] = 1.0;
  solveLarge(n, n, a, pivots, panel);
  std::copy(panel, panel + n * n, a);
  return -1;
}

}  // namespace tooljoint::linalg::kernel
