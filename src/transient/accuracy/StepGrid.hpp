// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Times of steps that are the longest step cut into halves: begin + n step / 2^deepest with
/// integer n. Times do not drift, and longer steps start at multiples of their length.
#pragma once

#include <cmath>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class StepGrid {
 public:
  static constexpr int mostHalvings = 30;  ///< of the longest step

  void set(const Window& window, double longest, int deepest) {
    begin_ = window.begin;
    end_ = window.end;
    longest_ = longest;
    deepest_ = deepest;
  }

  /// The next step starts at t, a multiple of the longest step.
  void startAt(double t) {
    index_ = std::lround((t - begin_) / longest_);
    done_ = 0;
  }

  int deepest() const { return deepest_; }
  /// Current number of halvings.
  int level() const { return level_; }
  void setLevel(int level) { level_ = level; }
  /// Finished full steps.
  long index() const { return index_; }
  /// Finished smallest parts of the current full step.
  long done() const { return done_; }
  /// Length of steps at a level [s].
  double length(int level) const { return std::ldexp(longest_, -level); }

  /// End of the next step [s].
  double next() const {
    const double steps = static_cast<double>(index_) +
                         std::ldexp(static_cast<double>(done_ + parts(level_)), -deepest_);
    const double t = begin_ + steps * longest_;
    return end_ - t < 1e-9 * longest_ ? end_ : t;
  }
  /// Length of the next step, bitwise equal from step to step; shorter only at the end of the run.
  double nextLength(double from) const {
    const double h = length(level_), t = next();
    return t >= end_ && std::abs(t - from - h) > 1e-9 * h ? t - from : h;
  }
  /// Completes the next step.
  void advance() {
    done_ += parts(level_);
    if (done_ == parts(0)) ++index_, done_ = 0;
  }
  /// Lowest level, but not below `least`, with steps that can start here.
  int lowest(int least) const {
    int level = level_;
    while (level > least && done_ % parts(level - 1) == 0) --level;
    return level;
  }

  void save(std::vector<double>& memory) const {
    memory.insert(memory.end(), {static_cast<double>(index_), static_cast<double>(done_),
                                 static_cast<double>(level_)});
  }
  void restore(const double*& memory) {
    index_ = static_cast<long>(*memory++);
    done_ = static_cast<long>(*memory++);
    level_ = static_cast<int>(*memory++);
  }

 private:
  long parts(int level) const { return 1L << (deepest_ - level); }

  double begin_ = 0, end_ = 0, longest_ = 0;
  int deepest_ = 0, level_ = 0;
  long index_ = 0, done_ = 0;
};

}  // namespace tooljoint::transient
