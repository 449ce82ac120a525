// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Clearances of the points of a batch from step to step, and which points they let act.
///
/// A point is evaluated in a step when its clearance may close within the step at twice the rate
/// last seen; after the step every other point is checked (by itself or by the bound of
/// ContactBroadPhase), and one that has touched is added and the step corrected: none is ever
/// missed.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "common/Index.hpp"
#include "transient/compiled/ContactBroadPhase.hpp"

namespace tooljoint::transient {

/// `measure(points, gap)` sets the clearances of these points at the q that is given with it.
class PointClearances {
 public:
  PointClearances(int points, ContactBroadPhase watch);

  /// Measures at q (time t) and calls act(p, whether p can act in a step of length h from there).
  template <class Measure, class Act>
  void look(double t, double h, const double* q, const Measure& measure, const Act& act);
  /// Measures at q and calls touched(p) for every point there is no clearance of. When the next
  /// look() is at the time t given here, it is at this q and nothing is measured again.
  template <class Measure, class Act>
  void check(const double* q, double t, const Measure& measure, const Act& touched);
  /// True when a point is closed at q and was open at the last look(), or the other way round.
  template <class Measure>
  bool meetsOrLeavesWall(const double* q, const Measure& measure);

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  static bool isClosed(double gap) { return !(gap > 0); }
  template <class Measure>
  void take(const double* q, const Measure& measure, std::vector<double>& gap);

  std::vector<double> gap_, lastGap_, check_;
  double time_ = 0, lastTime_ = 0;                               ///< of gap_ and lastGap_
  double checkTime_ = std::numeric_limits<double>::quiet_NaN();  ///< of check_
  int seen_ = 0;  ///< 0, 1, 2: how many measurements gap_ and lastGap_ hold
  ContactBroadPhase watch_;
};

/// Of the points that are awake; what slept is as if it had stood still.
template <class Measure>
void PointClearances::take(const double* q, const Measure& measure, std::vector<double>& gap) {
  watch_.activate(q);
  measure(watch_.active(), gap.data());
  for (int p : watch_.activated()) gap_[at(p)] = lastGap_[at(p)] = check_[at(p)] = gap[at(p)];
  watch_.deactivate(q, gap.data());
}

template <class Measure, class Act>
void PointClearances::look(double t, double h, const double* q, const Measure& measure,
                           const Act& act) {
  if (seen_ == 0 || t != time_) {
    gap_.swap(lastGap_);
    lastTime_ = time_;
    time_ = t;
    seen_ = std::min(seen_ + 1, 2);
  }
  if (t == checkTime_) {
    gap_.swap(check_);
  } else {
    take(q, measure, gap_);
  }
  checkTime_ = std::numeric_limits<double>::quiet_NaN();
  // A point acts in the step when gap <= 2 h closing, closing = rate at which its clearance shrank
  // since the look before.
  const double reach = seen_ == 2 && time_ > lastTime_ ? 2.0 * h / (time_ - lastTime_) : 0.0;
  for (int p : watch_.active()) {
    const double closing = std::max(0.0, lastGap_[at(p)] - gap_[at(p)]);
    act(p, !(gap_[at(p)] > reach * closing));
  }
}

template <class Measure, class Act>
void PointClearances::check(const double* q, double t, const Measure& measure, const Act& touched) {
  take(q, measure, check_);
  checkTime_ = t;
  for (int p : watch_.active())
    if (isClosed(check_[at(p)])) touched(p);
}

template <class Measure>
bool PointClearances::meetsOrLeavesWall(const double* q, const Measure& measure) {
  take(q, measure, check_);
  checkTime_ = std::numeric_limits<double>::quiet_NaN();
  const auto& found = watch_.activated();
  const auto& seen = watch_.active();
  return std::any_of(found.begin(), found.end(), [&](int p) { return isClosed(check_[at(p)]); }) ||
         std::any_of(seen.begin(), seen.end(),
                     [&](int p) { return isClosed(check_[at(p)]) != isClosed(gap_[at(p)]); });
}

}  // namespace tooljoint::transient
