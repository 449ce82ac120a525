// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Dense operations of block solvers on raw column-major storage. Blocks of 6 x 6 (one node of a
/// spatial beam) are unrolled. Blocks up to 64 have an explicit inverse, larger ones a pivoted LU.
/// Nothing allocates for blocks below about 600 rows.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstring>
#include <utility>

namespace tooljoint::linalg::kernel {

/// Blocks up to this size are inverted explicitly: a product is faster than two triangular solves.
constexpr int largestInverse = 64;

// Functions that spend their time in these kernels are compiled twice, for any x86-64 and for one
// with AVX2 and FMA; the loader selects one. Their results differ in the last bit.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && \
    !defined(__SANITIZE_ADDRESS__)
#define TOOLJOINT_CLONES __attribute__((target_clones("arch=x86-64-v3", "default")))
#else
#define TOOLJOINT_CLONES
#endif

/// For functions called by them: inlined, they are compiled for the same machine.
#if defined(__GNUC__)
#define TOOLJOINT_INLINED inline __attribute__((always_inline))
#else
#define TOOLJOINT_INLINED inline
#endif

using Pair = double __attribute__((vector_size(16), aligned(8), may_alias));
using Quad = double __attribute__((vector_size(32), aligned(8), may_alias));

/// A vector of six in registers.
struct Six {
  Quad a;
  Pair b;
  explicit Six(const double* x)
      : a(*reinterpret_cast<const Quad*>(x)), b(*reinterpret_cast<const Pair*>(x + 4)) {}
  Six() : a{0, 0, 0, 0}, b{0, 0} {}
  void to(double* x) const { *reinterpret_cast<Quad*>(x) = a, *reinterpret_cast<Pair*>(x + 4) = b; }
  /// y += factor this.
  void addTo(double* y, double factor) const {
    *reinterpret_cast<Quad*>(y) += factor * a, *reinterpret_cast<Pair*>(y + 4) += factor * b;
  }
  /// this += A x, A 6 x 6.
  void add(const double* A, const double* x) {
    for (int j = 0; j < 6; ++j) {
      a += *reinterpret_cast<const Quad*>(A + 6 * j) * x[j];
      b += *reinterpret_cast<const Pair*>(A + 6 * j + 4) * x[j];
    }
  }
  /// this += a x, a one column.
  void addColumn(const double* column, double x) {
    a += *reinterpret_cast<const Quad*>(column) * x;
    b += *reinterpret_cast<const Pair*>(column + 4) * x;
  }
  /// this += A x, A 6 x 6 and diagonal.
  void addDiagonal(const double* A, const double* x) {
    a += Quad{A[0], A[7], A[14], A[21]} * *reinterpret_cast<const Quad*>(x);
    b += Pair{A[28], A[35]} * *reinterpret_cast<const Pair*>(x + 4);
  }
  /// this -= A x, A 6 x 6.
  void subtract(const double* A, const double* x) {
    for (int j = 0; j < 6; ++j) {
      a -= *reinterpret_cast<const Quad*>(A + 6 * j) * x[j];
      b -= *reinterpret_cast<const Pair*>(A + 6 * j + 4) * x[j];
    }
  }
};

/// even + odd += sign A x, A of six rows: two independent sums.
template <int sign = 1>
TOOLJOINT_INLINED void addPairs(int columns, const double* A, const double* x, Six& even,
                                Six& odd) {
  int j = 0;
  for (; j + 2 <= columns; j += 2) {
    even.addColumn(A + 6 * j, sign * x[j]);
    odd.addColumn(A + 6 * j + 6, sign * x[j + 1]);
  }
  if (j < columns) even.addColumn(A + 6 * j, sign * x[j]);
}

/// y += A' x, A 6 x 6: products down the columns, summed across.
TOOLJOINT_INLINED void addSixTransposed(const double* A, const double* x, Six& y) {
  const Six v(x);
  Quad p[6];
  for (int j = 0; j < 6; ++j) {
    const Pair rest = *reinterpret_cast<const Pair*>(A + 6 * j + 4) * v.b;
    p[j] = *reinterpret_cast<const Quad*>(A + 6 * j) * v.a + Quad{rest[0], rest[1], 0, 0};
  }
#if defined(__clang__)
  for (int j = 0; j < 4; ++j) y.a[j] += (p[j][0] + p[j][1]) + (p[j][2] + p[j][3]);
  for (int j = 4; j < 6; ++j) y.b[j - 4] += (p[j][0] + p[j][1]) + (p[j][2] + p[j][3]);
#else
  using Order = long long __attribute__((vector_size(32)));
  for (int j = 0; j < 6; j += 2)
    p[j] = __builtin_shuffle(p[j], p[j + 1], Order{0, 4, 2, 6}) +
           __builtin_shuffle(p[j], p[j + 1], Order{1, 5, 3, 7});
  y.a += __builtin_shuffle(p[0], p[2], Order{0, 1, 4, 5}) +
         __builtin_shuffle(p[0], p[2], Order{2, 3, 6, 7});
  y.b += Pair{p[4][0], p[4][1]} + Pair{p[4][2], p[4][3]};
#endif
}

/// Matrices with more doubles than this (4 MB) are prefetched. Shorter ones stay in fast caches,
/// and prefetching costs time.
constexpr std::size_t nearCache = std::size_t{1} << 19;

/// Prefetches the data that a sweep over a long array reads some blocks (8 kB) after `A`; beyond
/// its end this has no effect.
TOOLJOINT_INLINED void fetchAhead(const double* A, int count) {
#if defined(__GNUC__)
  constexpr int ahead = 1024, line = 8;  // doubles
  for (int i = 0; i < count; i += line) __builtin_prefetch(A + ahead + i);
#else
  (void)A, (void)count;
#endif
}

using ConstBlock = Eigen::Map<const Eigen::MatrixXd>;
using MutableBlock = Eigen::Map<Eigen::MatrixXd>;
using ConstSegment = Eigen::Map<const Eigen::VectorXd>;
using MutableSegment = Eigen::Map<Eigen::VectorXd>;

/// y += sign A x, four columns at a time.
template <int sign>
TOOLJOINT_INLINED void addColumns(int rows, int columns, const double* __restrict A,
                                  const double* __restrict x, double* __restrict y) {
  int j = 0;
  for (; j + 4 <= columns; j += 4) {
    const double a = sign * x[j], b = sign * x[j + 1], c = sign * x[j + 2], d = sign * x[j + 3];
    const double* __restrict A0 = A + j * rows;
    const double* __restrict A1 = A0 + rows;
    const double* __restrict A2 = A1 + rows;
    const double* __restrict A3 = A2 + rows;
    for (int i = 0; i < rows; ++i) y[i] += (A0[i] * a + A1[i] * b) + (A2[i] * c + A3[i] * d);
  }
  for (; j < columns; ++j) {
    const double a = sign * x[j];
    for (int i = 0; i < rows; ++i) y[i] += A[j * rows + i] * a;
  }
}

/// The same with the sums in registers, separate for even and odd columns.
template <int rows, int sign>
TOOLJOINT_INLINED void addFewRows(int columns, const double* A, const double* x, double* y) {
  constexpr int quads = rows / 4, rest = rows % 4;
  Quad even[quads + 1], odd[quads + 1];
  double last[2][3] = {};
  for (int k = 0; k < quads; ++k)
    even[k] = *reinterpret_cast<const Quad*>(y + 4 * k), odd[k] = Quad{0, 0, 0, 0};
  for (int i = 0; i < rest; ++i) last[0][i] = y[4 * quads + i];
  const auto add = [&](Quad * sum, double* tail, int j) __attribute__((always_inline)) {
    const double factor = sign * x[j];
    const double* column = A + rows * j;
    for (int k = 0; k < quads; ++k)
      sum[k] += *reinterpret_cast<const Quad*>(column + 4 * k) * factor;
    for (int i = 0; i < rest; ++i) tail[i] += column[4 * quads + i] * factor;
  };
  int j = 0;
  for (; j + 2 <= columns; j += 2) add(even, last[0], j), add(odd, last[1], j + 1);
  if (j < columns) add(even, last[0], j);
  for (int k = 0; k < quads; ++k) *reinterpret_cast<Quad*>(y + 4 * k) = even[k] + odd[k];
  for (int i = 0; i < rest; ++i) y[4 * quads + i] = last[0][i] + last[1][i];
}

/// The same for six rows.
template <int sign>
TOOLJOINT_INLINED void addSixRows(int columns, const double* A, const double* x, double* y) {
  Six even(y), odd;
  addPairs<sign>(columns, A, x, even, odd);
  even.a += odd.a, even.b += odd.b;
  even.to(y);
}

/// y += sign A x; y and x do not overlap. Special cases: nodes with six dofs, and the paired modes
/// of a straight run, one for each plane of bending.
template <int sign>
TOOLJOINT_INLINED void addProduct(int rows, int columns, const double* A, const double* x,
                                  double* y) {
  switch (rows) {
    case 2:
      return addFewRows<2, sign>(columns, A, x, y);
    case 4:
      return addFewRows<4, sign>(columns, A, x, y);
    case 6:
      return addSixRows<sign>(columns, A, x, y);
    case 8:
      return addFewRows<8, sign>(columns, A, x, y);
    case 10:
      return addFewRows<10, sign>(columns, A, x, y);
    case 12:
      return addFewRows<12, sign>(columns, A, x, y);
    case 14:
      return addFewRows<14, sign>(columns, A, x, y);
    case 16:
      return addFewRows<16, sign>(columns, A, x, y);
    default:
      addColumns<sign>(rows, columns, A, x, y);
  }
}

/// y += A x; y and x do not overlap.
TOOLJOINT_INLINED void multiplyAdd(int rows, int columns, const double* A, const double* x,
                                   double* y) {
  addProduct<1>(rows, columns, A, x, y);
}

/// y += A' x, A rows x columns; y and x do not overlap.
TOOLJOINT_INLINED void multiplyTransposedAdd(int rows, int columns, const double* __restrict A,
                                             const double* __restrict x, double* __restrict y) {
  for (int j = 0; j < columns; ++j) {
    double sum = 0;
    for (int i = 0; i < rows; ++i) sum += A[j * rows + i] * x[i];
    y[j] += sum;
  }
}

/// y -= A x; y and x do not overlap.
TOOLJOINT_INLINED void multiplySubtract(int rows, int columns, const double* A, const double* x,
                                        double* y) {
  addProduct<-1>(rows, columns, A, x, y);
}

/// C -= A B with A rows x inner, B inner x columns.
TOOLJOINT_INLINED void multiplySubtract(int rows, int inner, int columns, const double* A,
                                        const double* B, double* C) {
  if (rows == 6 && inner == 6) {
    for (int j = 0; j < columns; ++j) {
      Six s(C + 6 * j);
      s.subtract(A, B + 6 * j);
      s.to(C + 6 * j);
    }
  } else if (rows <= 64 && inner <= 64) {
    for (int j = 0; j < columns; ++j) multiplySubtract(rows, inner, A, B + j * inner, C + j * rows);
  } else {
    // Slices of the inner dimension keep Eigen's packing buffers on the stack.
    constexpr int slice = 24;
    for (int k = 0; k < inner; k += slice) {
      const int n = inner - k < slice ? inner - k : slice;
      MutableBlock(C, rows, columns).noalias() -=
          ConstBlock(A + static_cast<std::ptrdiff_t>(k) * rows, rows, n) *
          Eigen::Map<const Eigen::MatrixXd, 0, Eigen::OuterStride<>>(B + k, n, columns,
                                                                     Eigen::OuterStride<>(inner));
    }
  }
}

/// C += A B with A rows x inner, B inner x columns.
TOOLJOINT_INLINED void multiplyAddTo(int rows, int inner, int columns, const double* A,
                                     const double* B, double* C) {
  if (rows <= 64 && inner <= 64) {
    for (int j = 0; j < columns; ++j) multiplyAdd(rows, inner, A, B + j * inner, C + j * rows);
  } else {
    MutableBlock(C, rows, columns).noalias() +=
        ConstBlock(A, rows, inner) * ConstBlock(B, inner, columns);
  }
}

/// C = A B, both small enough for an explicit inverse.
TOOLJOINT_INLINED void multiplySmall(int rows, int inner, int columns, const double* A,
                                     const double* B, double* C) {
  std::memset(C, 0,
              sizeof(double) * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns));
  for (int j = 0; j < columns; ++j) multiplyAdd(rows, inner, A, B + j * inner, C + j * rows);
}

/// Pivots smaller than this times the scale of their row count as zero.
constexpr double smallestPivot = 1e-14;

/// Replaces the N x N block a by its inverse: Gauss-Jordan with pivoting on scaled rows. scale[i] >
/// 0 is the size of row and column i before elimination. Returns -1, or the position of the first
/// unusable pivot.
template <int N>
int invert(double* a, const double* scale) {
  int swapped[N];
  double s[N];
  for (int i = 0; i < N; ++i) s[i] = scale[i];
  for (int k = 0; k < N; ++k) {
    int p = k;
    double best = -1;
    for (int i = k; i < N; ++i) {
      const double size = std::abs(a[i * N + k]) / s[i];
      if (size > best) best = size, p = i;
    }
    if (!(best > smallestPivot)) return k;  // also true for NaN
    swapped[k] = p;
    if (p != k) {
      for (int j = 0; j < N; ++j) std::swap(a[k * N + j], a[p * N + j]);
      std::swap(s[k], s[p]);
    }
    const double reciprocal = 1.0 / a[k * N + k];
    a[k * N + k] = 1.0;
    for (int j = 0; j < N; ++j) a[k * N + j] *= reciprocal;
    for (int i = 0; i < N; ++i) {
      if (i == k) continue;
      const double factor = a[i * N + k];
      a[i * N + k] = 0.0;
      for (int j = 0; j < N; ++j) a[i * N + j] -= factor * a[k * N + j];
    }
  }
  for (int k = N - 1; k >= 0; --k)
    if (swapped[k] != k)
      for (int i = 0; i < N; ++i) std::swap(a[i * N + k], a[i * N + swapped[k]]);
  return -1;
}

/// PA = LU in place, unblocked within panels of 24 columns. pivots has n entries. Returns as
/// invert().
int factorLarge(int n, double* a, const double* scale, double* workScale, int* pivots);
/// B := A^-1 B with the factors of factorLarge; B is n x columns.
void solveLarge(int n, int columns, const double* lu, const int* pivots, double* B);

/// Replace a by its inverse through its LU.
int invertLarge(int n, double* a, const double* scale, double* workScale, int* pivots,
                double* panel);

/// Factors a diagonal block. Up to largestInverse it is an explicit inverse (panel has room for n x
/// n), by Gauss-Jordan for common widths (nodes, pairs of modes); above it is LU. Returns -1 or the
/// position of the bad pivot.
inline int factorBlock(int n, double* a, const double* scale, double* workScale, int* pivots,
                       double* panel) {
  switch (n) {
    case 1:
      return invert<1>(a, scale);
    case 2:
      return invert<2>(a, scale);
    case 3:
      return invert<3>(a, scale);
    case 4:
      return invert<4>(a, scale);
    case 5:
      return invert<5>(a, scale);
    case 6:
      return invert<6>(a, scale);
    case 7:
      return invert<7>(a, scale);
    case 8:
      return invert<8>(a, scale);
    case 10:
      return invert<10>(a, scale);
    case 12:
      return invert<12>(a, scale);
    case 14:
      return invert<14>(a, scale);
    case 16:
      return invert<16>(a, scale);
    default:
      return n <= largestInverse ? invertLarge(n, a, scale, workScale, pivots, panel)
                                 : factorLarge(n, a, scale, workScale, pivots);
  }
}

}  // namespace tooljoint::linalg::kernel
