// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Products with a sparse matrix many of whose rows share their columns, as the recovery of reduced
/// parts does (all nodes of a part follow the same interface dofs and modes): such rows are
/// gathered into dense blocks, several times as fast as row by row. What shares nothing stays
/// sparse.
#pragma once

#include <array>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::linalg {

class GroupedRows {
 public:
  GroupedRows() = default;
  explicit GroupedRows(const Sparse& matrix);

  Eigen::Index rows() const { return rest_.rows(); }
  /// y = A x; y and x are different vectors.
  void multiply(const Vector& x, Vector& y) const;
  /// The same of three vectors, in one pass over A: it is memory that a product waits for.
  void multiply(const std::array<const Vector*, 3>& x, const std::array<Vector*, 3>& y) const;

 private:
  struct Group {
    std::vector<int> rows, columns;
    Matrix values;
    mutable Matrix in, out;  ///< a column for each vector
  };
  template <std::size_t N>
  void multiplyAll(const std::array<const Vector*, N>& x, const std::array<Vector*, N>& y) const;

  std::vector<Group> groups_;
  Sparse rest_;  ///< the rows of no group
};

}  // namespace tooljoint::linalg
