// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The mass matrix of a compiled model, factored, with unit pivots where there is no mass.
#pragma once

#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class MassFactor {
 public:
  /// The model must outlive this. Collective, as are the solutions.
  explicit MassFactor(const CompiledModel& model);

  /// What BlockFactor::factor() returned: the position of a dof with mass at which M is singular,
  /// -1 for none. Where there is one, M^-1 is not defined.
  int singularAt() const { return singularAt_; }
  bool regular() const { return singularAt_ < 0; }
  /// Whether the dof at a position has no mass.
  bool isMissing(int position) const { return missing_[static_cast<std::size_t>(position)] != 0; }

  /// a := M^-1 a, zero where there is no mass.
  void solve(Vector& a) const;
  /// The same for an a that is zero outside the blocks listed; `blocks` then holds those where M^-1
  /// a is not. What falls below the part `negligible` of max |a_i / M_ii| is dropped: in a chain of
  /// consistent masses M^-1 falls by 3.7 from node to node.
  void solveNear(Vector& a, std::vector<int>& blocks, double negligible) const;
  /// Find M^-1 on the pattern where points touch it, zero where there is no mass. M is regular.
  void invert(const CompiledModel& model);
  /// That of invert(), laid out as in the pattern; null before.
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
