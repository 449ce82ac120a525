// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What an implicit step can do where its equations are hard, from the usual to the last resort.
/// Each is counted where it is used and can be left out of a run, so that what it wins is measured
/// (docs/strategies.md).
#pragma once

#include <array>
#include <bitset>
#include <cstddef>

namespace tooljoint::transient {

enum class Strategy : std::size_t {
  Relaxation,
  NearSolves,
  PointsAlone,
  PointPaths,
  Turns,
  RestingImpacts,
  Newton,
  TroubledPoints
};
constexpr std::size_t strategyCount = 8;

struct StrategyName {
  const char* deck;      ///< in the parameter Leave Out
  const char* summary;   ///< key in summary.json
  bool ofPoint = false;  ///< used at one point, on the rank that has it
};
constexpr std::array<StrategyName, strategyCount> strategyNames{{
    {"Relaxation", "relaxation"},            // of the point forces, with a factor kept over steps
    {"Near Solves", "near_solves"},          // of what a few points reach, instead of all
    {"Points Alone", "points_alone", true},  // those whose force jumps, each with its own Newton
    {"Point Paths", "point_paths", true},    // pseudo-time and path following at such a point
    {"Turns", "turns"},                      // every fourth point moves while the others stand
    {"Resting Impacts", "resting_impacts",
     true},                                  // on walls too stiff for the step, without rebound
    {"Newton", "newton"},                    // for the whole model, with renewed tangents
    {"Troubled Points", "troubled_points"},  // of its line search, solved together
}};

using StrategySet = std::bitset<strategyCount>;
/// Whether `one` is in the set.
inline bool holds(const StrategySet& set, Strategy one) {
  return set[static_cast<std::size_t>(one)];
}
/// Uses of each in a run.
using StrategyCounts = std::array<long, strategyCount>;

/// What a step may do, and what it has done.
class Strategies {
 public:
  void leaveOut(const StrategySet& left) { left_ = left; }
  /// Uses are added here from now on.
  void countIn(StrategyCounts& counts) { counts_ = &counts; }
  bool has(Strategy one) const { return !holds(left_, one); }
  void count(Strategy one) {
    if (counts_ != nullptr) ++(*counts_)[static_cast<std::size_t>(one)];
  }
  /// Whether it may be used; counted as a use where it may.
  bool use(Strategy one) {
    if (has(one)) count(one);
    return has(one);
  }

 private:
  StrategySet left_;
  StrategyCounts* counts_ = nullptr;
};

}  // namespace tooljoint::transient
