// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Clearances of the points of a batch from step to step, and the points that may be in contact.
///
/// A point is evaluated in a step if its clearance may close within the step at twice its last
/// closing rate. After the step every other point is checked (directly or by the bound of
/// ContactBroadPhase). If one of them touches, it is added and the step is corrected, so no contact
/// is missed.
#pragma once

#include <algorithm>
#include <limits>
#include <vector>

#include "common/Index.hpp"
#include "transient/points/ContactBroadPhase.hpp"

namespace tooljoint::transient {

/// `measure(points, gap)` evaluates the clearances of these points at the q of the call.
class PointClearances {
 public:
  PointClearances(int points, ContactBroadPhase watch);

  /// Evaluates at q (time t) and calls act(p, whether p may be in contact in a step of length h).
  template <class Measure, class Act>
  void look(double t, double h, const double* q, const Measure& measure, const Act& act);
  /// Evaluates at q and calls touched(p) for every point without clearance. A following look() at
  /// the time t is at the same q and reuses the values.
  template <class Measure, class Act>
  void check(const double* q, double t, const Measure& measure, const Act& touched);
  /// True if a point is closed at q and was open at the last look(), or vice versa.
  template <class Measure>
  bool meetsOrLeavesWall(const double* q, const Measure& measure);

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  static bool isClosed(double gap) { return !(gap > 0); }
  template <class Measure>
  void take(const double* q, const Measure& measure, std::vector<double>& gap);

  std::vector<double> gap_, lastGap_, check_;
  double time_ = 0, lastTime_ = 0;                               ///< times of gap_ and lastGap_
  double checkTime_ = std::numeric_limits<double>::quiet_NaN();  ///< time of check_
  int seen_ = 0;  ///< number of evaluations in gap_ and lastGap_: 0, 1, 2
  ContactBroadPhase watch_;
};

/// Clearances of the active points. A newly activated point counts as at rest before.
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
  // A point is evaluated in the step if gap <= 2 h closing, closing = closing rate of its clearance
  // since the last look().
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
