// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Fills a sparse matrix with dense columns, using only the memory of the result.
#pragma once

#include <utility>
#include <vector>

#include "common/Index.hpp"

namespace tooljoint::reduction {

/// A row-major sparse matrix. Its entries are first counted, row by row, and then inserted, in each
/// row from left to right. A list of entries would need three times the memory of the result. Zeros
/// in dense blocks are omitted.
class RowFiller {
 public:
  RowFiller(Eigen::Index rows, Eigen::Index columns)
      : matrix_(rows, columns), counts_(Eigen::VectorXi::Zero(rows)) {}

  /// Counts this number of entries of a row, or those of `values` (rows.size() x any).
  void expect(int row, int entries) { counts_[row] += entries; }
  void expect(const std::vector<int>& rows, const Matrix& values) {
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        if (values(i, j) != 0.0) ++counts_[rows[at(i)]];
  }

  /// Ends the counting.
  void start() { matrix_.reserve(counts_); }
  void put(int row, int column, double value) { matrix_.insert(row, column) = value; }
  void put(const std::vector<int>& rows, const std::vector<int>& columns, const Matrix& values) {
    for (Eigen::Index j = 0; j < values.cols(); ++j)
      for (Eigen::Index i = 0; i < values.rows(); ++i)
        if (values(i, j) != 0.0) put(rows[at(i)], columns[at(j)], values(i, j));
  }

  Sparse result() {
    Sparse filled;
    filled.swap(matrix_);
    filled.makeCompressed();
    return filled;
  }

 private:
  Sparse matrix_;
  Eigen::VectorXi counts_;
};

}  // namespace tooljoint::reduction
