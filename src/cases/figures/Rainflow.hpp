// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cycles of a load history by rainflow counting, sample by sample (ASTM E1049-85, 5.4.4).
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

namespace tooljoint::cases {

/// A cycle or a half cycle of a load.
struct LoadCycle {
  double range = 0.0;  ///< peak minus valley
  double mean = 0.0;
  double count = 0.0;  ///< 1, or 0.5 for a half cycle
};

/// Holds the peaks and valleys that are not counted yet; their ranges decrease, so there are few.
/// Each counted cycle is passed to a function: sink(LoadCycle).
class Rainflow {
 public:
  /// Adds the next sample; `sink` receives the cycles that it closes.
  template <class Sink>
  void add(double value, const Sink& sink) {
    if (!started_) {
      reversals_ = {value};
      last_ = value;
      started_ = true;
    }
    if (value == last_) return;
    const int direction = value > last_ ? 1 : -1;
    if (direction_ != 0 && direction != direction_) addReversal(last_, sink);
    direction_ = direction;
    last_ = value;
  }

  /// The remaining cycles if the history ends here: the last sample and half cycles. The counter
  /// itself is not changed.
  template <class Sink>
  void finish(const Sink& sink) const {
    if (direction_ == 0) return;
    Rainflow rest = *this;
    rest.addReversal(last_, sink);
    for (std::size_t i = 1; i < rest.reversals_.size(); ++i)
      sink(cycle(rest.reversals_[i - 1], rest.reversals_[i], 0.5));
  }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  static LoadCycle cycle(double from, double to, double count) {
    return {std::abs(to - from), 0.5 * (from + to), count};
  }

  /// X is the range to `value`, Y the range before it: Y is counted unless X is smaller.
  template <class Sink>
  void addReversal(double value, const Sink& sink) {
    auto& r = reversals_;
    r.push_back(value);
    while (r.size() >= 3) {
      const std::size_t n = r.size();
      const double x = std::abs(r[n - 1] - r[n - 2]), y = std::abs(r[n - 2] - r[n - 3]);
      if (x < y) return;
      if (n == 3) {
        // Y contains the starting point
        sink(cycle(r[0], r[1], 0.5));
        r.erase(r.begin());
      } else {
        sink(cycle(r[n - 3], r[n - 2], 1.0));
        r.erase(r.end() - 3, r.end() - 1);
      }
    }
  }

  std::vector<double> reversals_;  ///< peaks and valleys not counted yet, the starting point first
  double last_ = 0.0;              ///< latest sample that differs from the previous one
  int direction_ = 0;              ///< direction of the last change: 1 up, -1 down
  bool started_ = false;
};

/// Sums over the cycles of one history.
struct CycleTotals {
  double cycles = 0.0;        ///< halves count 0.5
  double largestRange = 0.0;  ///< unit of the history
  double damage = 0.0;        ///< sum of count range^m; 0 without an exponent

  /// \param exponent m of the S-N line; 0: no damage is summed
  void add(const LoadCycle& cycle, double exponent);
};

}  // namespace tooljoint::cases
