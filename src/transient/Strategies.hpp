// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Strategies of an implicit step for equations that are hard to solve, from the usual one to the
/// last resort. Uses are counted, and each strategy can be left out of a run, so that its benefit
/// can be measured (docs/strategies.md).
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
  bool ofPoint = false;  ///< used at single points, counted on their ranks
};
constexpr std::array<StrategyName, strategyCount> strategyNames{{
    {"Relaxation", "relaxation"},            // of the point forces, with a factor kept over steps
    {"Near Solves", "near_solves"},          // only where the forces of a few points reach
    {"Points Alone", "points_alone", true},  // points whose force jumps, each by its own Newton
    {"Point Paths", "point_paths", true},    // pseudo-time and path following at such a point
    {"Turns", "turns"},                      // every fourth point is corrected, the others are held
    {"Resting Impacts", "resting_impacts",
     true},                                  // on walls too stiff for the step, without rebound
    {"Newton", "newton"},                    // for the whole model, with renewed tangents
    {"Troubled Points", "troubled_points"},  // of the line search, solved together
}};

using StrategySet = std::bitset<strategyCount>;
/// Whether `one` is in the set.
inline bool holds(const StrategySet& set, Strategy one) {
  return set[static_cast<std::size_t>(one)];
}
/// Uses of each strategy in a run.
using StrategyCounts = std::array<long, strategyCount>;

/// Strategies that a step may use, with their counts.
class Strategies {
 public:
  void leaveOut(const StrategySet& left) { left_ = left; }
  /// Counts further uses in `counts`.
  void countIn(StrategyCounts& counts) { counts_ = &counts; }
  bool has(Strategy one) const { return !holds(left_, one); }
  void count(Strategy one) {
    if (counts_ != nullptr) ++(*counts_)[static_cast<std::size_t>(one)];
  }
  /// Whether the strategy may be used; if so, its use is counted.
  bool use(Strategy one) {
    if (has(one)) count(one);
    return has(one);
  }

 private:
  StrategySet left_;
  StrategyCounts* counts_ = nullptr;
};

}  // namespace tooljoint::transient
