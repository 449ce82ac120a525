// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/Index.hpp"

namespace tooljoint::transient {

/// Points of a batch that are evaluated in a step, and those that were evaluated since the energy
/// was last booked.
class ActivePoints {
 public:
  /// \param points  number of points of the batch; \param all  those of this rank, increasing
  ActivePoints(int points, std::vector<int> all);

  /// All points of this rank; the active ones among them, as of the last update().
  const std::vector<int>& all() const { return all_; }
  const std::vector<int>& active() const { return active_; }

  bool isMarked(int point) const { return isActive_[at(point)] != 0; }
  /// Takes effect with the next update().
  void mark(int point, bool active) { isActive_[at(point)] = active ? 1 : 0; }
  void update();

  /// Points that were active since the last book().
  const std::vector<int>& acted();
  /// Closes the booking up to now.
  void book() { hasActed_ = isActive_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  std::vector<int> all_, active_, acted_;
  std::vector<char> isActive_, hasActed_;
};

}  // namespace tooljoint::transient
