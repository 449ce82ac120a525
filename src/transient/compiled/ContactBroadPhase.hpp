// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Which points of a batch have to be measured to know that none touches. Points inside a reduced
/// part hang on many coordinates, so measuring one is dear; but all points of a part hang on the
/// same coordinates, so one bound serves them all:
///
///     |d_p(q) - d_p(q_0)| <= B(q) = | sum_j r_j |q_j - q_0j| |,   r_j = max_p |R_pj|, coordinate
///     by coordinate
///
/// As long as B stays below the least clearance the sleeping points of a group had at q_0, none of
/// them can have lost it.
#pragma once

#include <vector>

#include "linalg/blocks/BlockSparse.hpp"

namespace tooljoint::transient {

class ContactBroadPhase {
 public:
  ContactBroadPhase() = default;
  /// Of these points; rows (point * width + coordinate) as CSR in positions; clearances change by
  /// no more than the length of the change of the first `reach` coordinates.
  ContactBroadPhase(const std::vector<int>& points, int width, int reach,
                    const std::vector<int>& rowBegin, const std::vector<int>& column,
                    const std::vector<double>& value, const linalg::BlockPattern& pattern);

  /// Points to measure, increasing.
  const std::vector<int>& active() const { return active_; }
  /// Wakes all points of every group whose bound is reached at q. These are woken() until the next
  /// call.
  void activate(const double* q);
  const std::vector<int>& activated() const { return activated_; }
  /// After all awake points were measured at q: the woken ones with clearance to spare sleep again.
  void deactivate(const double* q, const double* clearance);

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Group {
    std::vector<int> points;
    std::vector<int> columns;
    std::vector<double> bound;      ///< r, coordinate by coordinate
    std::vector<double> reference;  ///< q_0 at the columns
    double least = -1;   ///< clearance of the sleeping points at q_0; < 0: not measured yet
    double steps = 0;    ///< calls of wake() since then
    double reached = 0;  ///< B of the last call
    bool moved = false;
  };
  double bound(const Group& group, const double* q) const;
  void collect();

  int reach_ = 0;
  std::vector<Group> groups_;
  std::vector<int> all_;
  std::vector<char> isActive_;
  std::vector<int> active_, activated_;
};

}  // namespace tooljoint::transient
