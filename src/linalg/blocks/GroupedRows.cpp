// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/blocks/GroupedRows.hpp"

#include <map>
#include <utility>

namespace tooljoint::linalg {
namespace {

/// Fewer rows or columns than this do not pay for gathering them.
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
    Group group{rows, columns, Matrix(rows.size(), columns.size()), Vector(columns.size()),
                Vector(rows.size())};
    for (std::size_t i = 0; i < rows.size(); ++i) {
      Eigen::Index j = 0;
      for (Sparse::InnerIterator it(matrix, rows[i]); it; ++it)
        group.values(static_cast<Eigen::Index>(i), j++) = it.value();
    }
    groups_.push_back(std::move(group));
  }
  rest_.setFromTriplets(rest.begin(), rest.end());
}

void GroupedRows::multiply(const Vector& x, Vector& y) const {
  y.noalias() = rest_ * x;
  for (const Group& group : groups_) {
    for (std::size_t j = 0; j < group.columns.size(); ++j)
      group.in[static_cast<Eigen::Index>(j)] = x[group.columns[j]];
    group.out.noalias() = group.values * group.in;
    for (std::size_t i = 0; i < group.rows.size(); ++i)
      y[group.rows[i]] = group.out[static_cast<Eigen::Index>(i)];
  }
}

}  // namespace tooljoint::linalg
