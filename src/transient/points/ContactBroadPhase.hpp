// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Broad phase of contact: which clearances of a batch must be evaluated to ensure that no point
/// touches. A point inside a reduced part depends on many coordinates, so evaluating its clearance
/// is expensive. All points of a part depend on the same coordinates, so one bound holds for all:
///
///     |d_p(q) - d_p(q_0)| <= B(q) = | sum_j r_j |q_j - q_0j| |,   r_j = max_p |R_pj|, coordinate
///     by coordinate
///
/// As long as B is below the smallest clearance of the inactive points of a group at q_0, none of
/// them touches.
#pragma once

#include <vector>

#include "linalg/blocks/BlockSparse.hpp"

namespace tooljoint::transient {

class ContactBroadPhase {
 public:
  ContactBroadPhase() = default;
  /// Broad phase of these points. Rows (point * width + coordinate) are CSR in positions;
  /// clearances change by no more than the norm of the change of the first `reach` coordinates.
  ContactBroadPhase(const std::vector<int>& points, int width, int reach,
                    const std::vector<int>& rowBegin, const std::vector<int>& column,
                    const std::vector<double>& value, const linalg::BlockPattern& pattern);

  /// Points to evaluate, increasing.
  const std::vector<int>& active() const { return active_; }
  /// Activates all points of every group whose bound is reached at q. They are activated() until
  /// the next call.
  void activate(const double* q);
  const std::vector<int>& activated() const { return activated_; }
  /// After all active points were evaluated at q: deactivates activated points with enough
  /// clearance.
  void deactivate(const double* q, const double* clearance);

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Group {
    std::vector<int> points;
    std::vector<int> columns;
    std::vector<double> bound;      ///< r, coordinate by coordinate
    std::vector<double> reference;  ///< q_0 at the columns
    double least = -1;              ///< smallest clearance of inactive points at q_0; < 0: none yet
    double steps = 0;               ///< calls of activate() since then
    double reached = 0;             ///< B of the last call
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
