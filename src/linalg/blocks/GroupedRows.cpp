// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/GroupedRows.hpp"

#include <map>
#include <utility>

#include "common/Index.hpp"

namespace tooljoint::linalg {
namespace {

/// Gathering does not pay for fewer rows or columns than this.
constexpr std::size_t fewest = 4;

}  // namespace

GroupedRows::GroupedRows(const Sparse& matrix) : rest_(matrix.rows(), matrix.cols()) {
  std::map<std::vector<int>, std::vector<int>> byColumns;
  for (int row = 0; row < matrix.rows(); ++row) {
    std::vector<int> columns;
    for (Sparse::InnerIterator it(matrix, row); it; ++it)
      columns.push_back(static_cast<int>(it.col()));
    byColumns[std::move(columns)].push_back(row);
  }
  Triplets rest;
  for (const auto& [columns, rows] : byColumns) {
    if (columns.size() < fewest || rows.size() < fewest) {
      for (int row : rows)
        for (Sparse::InnerIterator it(matrix, row); it; ++it)
          rest.emplace_back(row, static_cast<int>(it.col()), it.value());
      continue;
    }
    Group group{rows, columns, Matrix(rows.size(), columns.size()), Matrix(), Matrix()};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Eigen::Index j = 0;
      for (Sparse::InnerIterator it(matrix, rows[i]); it; ++it)
        group.values(static_cast<Eigen::Index>(i), j++) = it.value();
    }
    groups_.push_back(std::move(group));
  }
  rest_.setFromTriplets(rest.begin(), rest.end());
}

template <std::size_t N>
void GroupedRows::multiplyAll(const std::array<const Vector*, N>& x,
                              const std::array<Vector*, N>& y) const {
  for (std::size_t k = 0; k < N; ++k) y[k]->noalias() = rest_ * *x[k];
  constexpr auto width = static_cast<Eigen::Index>(N);
  for (const Group& group : groups_) {
    const auto rows = sizeOf(group.rows), columns = sizeOf(group.columns);
    group.in.resize(width, columns);
    group.out.setZero(rows, width);
    for (int j = 0; j < columns; ++j)
      for (std::size_t k = 0; k < N; ++k)
        group.in(static_cast<Eigen::Index>(k), j) = (*x[k])[group.columns[at(j)]];
    for (int j = 0; j < columns; ++j)
      for (Eigen::Index k = 0; k < width; ++k)
        group.out.col(k) += group.in(k, j) * group.values.col(j);
    for (std::size_t k = 0; k < N; ++k)
      for (int i = 0; i < rows; ++i)
        (*y[k])[group.rows[at(i)]] = group.out(i, static_cast<Eigen::Index>(k));
  }
}

void GroupedRows::multiply(const Vector& x, Vector& y) const { multiplyAll<1>({&x}, {&y}); }

void GroupedRows::multiply(const std::array<const Vector*, 3>& x,
                           const std::array<Vector*, 3>& y) const {
  multiplyAll(x, y);
}

}  // namespace tooljoint::linalg
