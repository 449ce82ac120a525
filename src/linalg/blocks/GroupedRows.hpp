// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Products with a sparse matrix in which many rows share their columns, as in the recovery of
/// reduced parts (all nodes of a part depend on the same interface dofs and modes). Such rows are
/// gathered into dense blocks, several times as fast as row by row. Other rows stay sparse.
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
  /// The same for three vectors, in one pass over A, because memory access limits the product.
  void multiply(const std::array<const Vector*, 3>& x, const std::array<Vector*, 3>& y) const;

 private:
  struct Group {
    std::vector<int> rows, columns;
    Matrix values;
    mutable Matrix in, out;  ///< one column per vector
  };
  template <std::size_t N>
  void multiplyAll(const std::array<const Vector*, N>& x, const std::array<Vector*, N>& y) const;

  std::vector<Group> groups_;
  Sparse rest_;  ///< rows without a group
};

}  // namespace tooljoint::linalg
