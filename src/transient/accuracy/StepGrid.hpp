// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Times of steps that are the longest step cut into halves: whole numbers of its smallest part,
/// begin + n step / 2^deepest, so that they have no drift and a longer step starts at a multiple of
/// itself.
#pragma once

#include <cmath>
#include <vector>

#include "transient/Integrator.hpp"

namespace tooljoint::transient {

class StepGrid {
 public:
  void set(const Window& window, double longest, int deepest) {
    begin_ = window.begin;
    end_ = window.end;
    longest_ = longest;
    deepest_ = deepest;
  }

  /// The next step starts at t, a multiple of the longest.
  void startAt(double t) {
    index_ = std::lround((t - begin_) / longest_);
    done_ = 0;
  }

  int deepest() const { return deepest_; }
  /// Halvings in force.
  int level() const { return level_; }
  void setLevel(int level) { level_ = level; }
  /// Full steps done.
  long index() const { return index_; }
  /// Smallest parts done of the full step under way.
  long done() const { return done_; }
  /// Length of steps of a level [s].
  double length(int level) const { return std::ldexp(longest_, -level); }

  /// End of the next step [s].
  double next() const {
    const double steps = static_cast<double>(index_) +
                         std::ldexp(static_cast<double>(done_ + parts(level_)), -deepest_);
    const double t = begin_ + steps * longest_;
    return end_ - t < 1e-9 * longest_ ? end_ : t;
  }
  /// Its length, equal from step to step to the last digit; shorter only where the run ends.
  double nextLength(double from) const {
    const double h = length(level_), t = next();
    return t >= end_ && std::abs(t - from - h) > 1e-9 * h ? t - from : h;
  }
  /// The next step is done.
  void advance() {
    done_ += parts(level_);
    if (done_ == parts(0)) ++index_, done_ = 0;
  }
  /// The lowest level down to `least` whose steps may begin here.
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
