// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <fmt/format.h>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cases/run/ResumedRows.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"

namespace tooljoint::drillstring {
namespace {

/// First trial length and growth factor. A tangency point lies within some tens of metres.
constexpr double firstLength = 30.0, growth = 1.5;
/// A length is sufficient if force and tilt at the bit change by less than this.
constexpr double enough = 0.01;

/// The larger of two changes: of the force on the bit, relative to the largest force on a wall, and
/// of its tilt, relative to the largest slope of the string against its hole.
double changeOf(const BottomHoleState& from, const BottomHoleState& to) {
  double force = to.sideForce.norm(), slope = to.tilt.norm();
  for (std::size_t i = 0; i < to.stations.size(); ++i) {
    force = std::max(force, to.stations[i].wallForce.norm());
    if (i == 0) continue;
    const auto& lower = to.stations[i - 1];
    const auto& upper = to.stations[i];
    slope = std::max(
        slope, (upper.deflection - lower.deflection).norm() / (upper.fromBit - lower.fromBit));
  }
  const double ofForce = force > 0.0 ? (to.sideForce - from.sideForce).norm() / force : 0.0;
  const double ofTilt = slope > 0.0 ? (to.tilt - from.tilt).norm() / slope : 0.0;
  return std::max(ofForce, ofTilt);
}

ModelledLength lengthFor(const BottomHole& assembly, const BottomHolePoint& point,
                         const BottomHoleSettings& settings) {
  const double whole = assembly.wholeLength();
  ModelledLength found;
  if (settings.length) {
    found.length = *settings.length;
    found.checkedAgainst = std::min(whole, growth * found.length);
    if (found.checkedAgainst > found.length)
      found.change = changeOf(assembly.solve(point, found.length),
                              assembly.solve(point, found.checkedAgainst));
    return found;
  }
  found.length = std::min(whole, std::max(firstLength, growth * settings.surveyTool.value_or(0.0)));
  found.checkedAgainst = found.length;
  auto state = assembly.solve(point, found.length);
  while (found.length < whole) {
    found.checkedAgainst = found.length;
    found.length = std::min(whole, growth * found.length);
    const auto longer = assembly.solve(point, found.length);
    found.change = changeOf(state, longer);
    if (found.change < enough) return found;
    state = longer;
  }
  return found;
}

/// The longest length that any hole needs, under the largest weight on bit with an equilibrium.
ModelledLength modelledLength(const BottomHole& assembly, const BottomHoleSettings& settings,
                              const std::vector<std::optional<double>>& holes) {
  auto weights = settings.weights;
  std::sort(weights.rbegin(), weights.rend());
  ModelledLength longest;
  std::string failure;
  for (const auto& hole : holes)
    for (const double weight : weights) {
      try {
        const auto one = lengthFor(assembly, {hole, weight, settings.toolFaces.front()}, settings);
        if (one.length > longest.length ||
            (one.length == longest.length && one.change > longest.change))
          longest = one;
        break;
      } catch (const ConvergenceError& error) {
        failure = error.what();
      }
    }
  if (longest.length == 0.0) throw ConvergenceError(failure);
  return longest;
}

/// One combination.
struct Job {
  BottomHolePoint point;
  bool rotating = false;
};

/// The result: a state, or the reason why there is none.
struct Outcome {
  BottomHoleState state;
  std::string reason;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(state, reason);
  }
};

std::vector<Job> jobsOf(const BottomHole& assembly, const BottomHoleSettings& settings,
                        const std::vector<std::optional<double>>& holes, double length) {
  std::vector<Job> jobs;
  for (const auto& hole : holes)
    for (const double weight : settings.weights) {
      for (const double toolFace : settings.toolFaces) jobs.push_back({{hole, weight, toolFace}});
      if (assembly.turns(length))
        jobs.push_back({{hole, weight, settings.toolFaces.front()}, true});
    }
  return jobs;
}

constexpr int storeFormat = 1;  ///< raised when the meaning of a stored state changes

/// Data that determine the states: the deck without its analyses, the settings of this list that
/// are not varied, and the length.
cases::RowKeys keysOf(const cases::Case& owner, const BottomHoleSettings& settings, double length,
                      const std::vector<Job>& jobs) {
  const auto number = [](const std::optional<double>& value) {
    return value ? fmt::format("{}", *value) : std::string("none");
  };
  cases::RowKeys keys{"states",
                      fmt::format("bottom-hole assembly {}\n{}\n{} {} {} {} {} {}", storeFormat,
                                  cases::identity(owner), settings.buildRate, settings.turnRate,
                                  number(settings.surveyTool), settings.elementLength,
                                  settings.rotatingToolFaces, length),
                      {}};
  for (const auto& [point, rotating] : jobs)
    keys.rows.push_back(fmt::format("{} {} {} {}", number(point.inclination), point.weight,
                                    point.toolFace, rotating));
  return keys;
}

Outcome solve(const BottomHole& assembly, double length, const Job& job) {
  if (interruptRequested()) throw InterruptedError("Interrupted.");
  try {
    return {job.rotating ? assembly.rotating(job.point, length) : assembly.solve(job.point, length),
            ""};
  } catch (const ConvergenceError& error) {
    return {{}, error.what()};
  }
}

}  // namespace

BottomHoleSweep bottomHoleSweep(const Scene& scene, const BottomHoleSettings& settings,
                                const cases::RowFolder& store) {
  const BottomHole assembly(scene, settings);
  std::vector<std::optional<double>> holes(settings.inclinations.begin(),
                                           settings.inclinations.end());
  if (holes.empty()) holes.emplace_back();
  BottomHoleSweep sweep;
  sweep.length = modelledLength(assembly, settings, holes);
  const auto jobs = jobsOf(assembly, settings, holes, sweep.length.length);
  auto found = cases::resumedRows<Outcome>(
      store, keysOf(store.owner, settings, sweep.length.length, jobs),
      [&](std::size_t i) { return solve(assembly, sweep.length.length, jobs[i]); });
  for (std::size_t i = 0; i < jobs.size(); ++i)
    if (found[i].reason.empty())
      sweep.rows.push_back({jobs[i].point, jobs[i].rotating, std::move(found[i].state)});
    else
      sweep.missing.push_back({jobs[i].point, jobs[i].rotating, found[i].reason});
  if (sweep.rows.empty()) throw ConvergenceError(sweep.missing.front().reason);
  return sweep;
}

}  // namespace tooljoint::drillstring
