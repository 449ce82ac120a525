// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Sparse matrix of a mesh: the pattern is computed once, then entries are added in place without
/// searching.
#pragma once

#include <vector>

#include "common/Index.hpp"
#include "common/Types.hpp"

namespace tooljoint::beam {

/// Assembles element matrices into one fixed pattern. Unknown -1 marks a held dof; its row and
/// column are omitted.
class SparseAssembler {
 public:
  SparseAssembler() = default;
  /// `unknowns[e]` lists the global unknown of each local dof of element e. The diagonal is always
  /// in the pattern.
  SparseAssembler(int size, std::vector<std::vector<int>> unknowns);

  int size() const { return size_; }
  const std::vector<int>& unknowns(int element) const {
    return unknowns_[static_cast<std::size_t>(element)];
  }

  /// Gives `matrix` the pattern (if it does not have it yet) and sets all entries to zero.
  void clear(Sparse& matrix) const;

  /// matrix += element matrix (local dofs x local dofs); `matrix` must have been cleared by this
  /// assembler.
  template <class Derived>
  void add(int element, const Eigen::MatrixBase<Derived>& local, Sparse& matrix) const {
    const std::vector<int>& slots = slots_[static_cast<std::size_t>(element)];
    const auto n = static_cast<int>(unknowns(element).size());
    double* values = matrix.valuePtr();
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        const int slot = slots[at(i * n + j)];
        if (slot >= 0) values[slot] += local(i, j);
      }
  }

  /// vector += element vector on the free unknowns.
  template <class Derived>
  void add(int element, const Eigen::MatrixBase<Derived>& local, Vector& vector) const {
    const std::vector<int>& rows = unknowns(element);
    for (std::size_t i = 0; i < rows.size(); ++i)
      if (rows[i] >= 0) vector(rows[i]) += local(static_cast<int>(i));
  }

 private:
  int size_ = 0;
  std::vector<std::vector<int>> unknowns_;
  std::vector<std::vector<int>>
      slots_;  ///< position in valuePtr() of each local entry, -1 when held
  Sparse pattern_;
};

}  // namespace tooljoint::beam
