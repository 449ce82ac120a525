// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Factored mass matrix of a compiled model, with unit pivots at massless dofs.
#pragma once

#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class MassFactor {
 public:
  /// The model must outlive this. Construction and solutions are collective.
  explicit MassFactor(const CompiledModel& model);

  /// Result of BlockFactor::factor(): the position of a dof with mass where M is singular, -1 for
  /// none. If M is singular, M^-1 is not defined.
  int singularAt() const { return singularAt_; }
  bool regular() const { return singularAt_ < 0; }
  /// Whether the dof at a position has no mass.
  bool isMissing(int position) const { return missing_[static_cast<std::size_t>(position)] != 0; }

  /// a := M^-1 a, zero at massless dofs.
  void solve(Vector& a) const;
  /// The same for an a that is zero outside the listed blocks; afterwards `blocks` lists the
  /// nonzero blocks of M^-1 a. Entries below `negligible` times max |a_i / M_ii| are dropped: in a
  /// chain of consistent masses M^-1 decreases by a factor of 3.7 from node to node.
  void solveNear(Vector& a, std::vector<int>& blocks, double negligible) const;
  /// Computes M^-1 on the entries of the pattern that points use, zero at massless dofs. M must be
  /// regular.
  void invert(const CompiledModel& model);
  /// Result of invert() in the layout of the pattern; null before.
  const double* inverse() const { return values_.empty() ? nullptr : values_.data(); }

 private:
  const linalg::BlockPattern& pattern_;
  linalg::BlockFactor factor_;
  Vector perUnit_;              ///< 1 / M_ii
  std::vector<char> missing_;   ///< per position: no mass
  linalg::BlockValues values_;  ///< of M^-1
  int singularAt_ = -1;
};

}  // namespace tooljoint::transient
