// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Indices, lists of positions and sparse matrices by entries.
#pragma once

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <numeric>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint {

/// Casts the signed indices of Eigen and MPI for containers of the standard library: `i` >= 0 as
/// v[at(i)].
constexpr std::size_t at(std::ptrdiff_t i) { return static_cast<std::size_t>(i); }

/// Number of elements, as the type of dof positions.
template <class Container>
int sizeOf(const Container& values) {
  return static_cast<int>(values.size());
}

/// first, first + 1, ... (`count` of them).
inline std::vector<int> range(Eigen::Index count, Eigen::Index first = 0) {
  std::vector<int> values(at(count));
  std::iota(values.begin(), values.end(), static_cast<int>(first));
  return values;
}

template <class Container, class Value>
bool contains(const Container& values, const Value& value) {
  return std::find(std::begin(values), std::end(values), value) != std::end(values);
}

/// Sorts and removes duplicates.
template <class Value>
void makeUnique(std::vector<Value>& values) {
  std::sort(values.begin(), values.end());
  values.erase(std::unique(values.begin(), values.end()), values.end());
}

/// The matrix with these entries; entries with the same indices are added.
inline Sparse sparse(Eigen::Index rows, Eigen::Index columns, const Triplets& entries) {
  Sparse A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

/// Calls visit(row, column, value) for every stored entry of a row-major sparse matrix.
template <class Matrix, class Visit>
void forEachEntry(const Matrix& A, const Visit& visit) {
  for (int row = 0; row < A.outerSize(); ++row)
    for (typename Matrix::InnerIterator it(A, row); it; ++it)
      visit(row, static_cast<int>(it.col()), it.value());
}

/// The same for one row: visit(column, value).
template <class Matrix, class Visit>
void forEachInRow(const Matrix& A, Eigen::Index row, const Visit& visit) {
  for (typename Matrix::InnerIterator it(A, row); it; ++it)
    visit(static_cast<int>(it.col()), it.value());
}

/// Removes entries that are exactly zero.
inline Sparse withoutZeros(Sparse A) {
  A.prune([](Eigen::Index, Eigen::Index, double value) { return value != 0.0; });
  return A;
}

}  // namespace tooljoint
