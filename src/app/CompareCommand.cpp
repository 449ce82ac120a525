// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iterator>
#include <nlohmann/json.hpp>

#include "app/Commands.hpp"
#include "app/PartsDeck.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "io/ResultsReader.hpp"
#include "study/Metrics.hpp"

namespace tooljoint::app {

namespace {

/// A recorded motion in memory: all components of a string, the measured ones of a scene of parts.
struct Motion {
  explicit Motion(const std::string& folder)
      : reader(folder + "/results.h5"), shape(reader.shape("/transient/displacement")) {
    if (reader.has("/model/components"))
      components = measuredComponents(reader.texts("/model/components"));
    time = reader.numbers("/transient/time");
    displacement = measured("/transient/displacement");
  }

  std::vector<double> measured(const std::string& path) const {
    const auto all = reader.numbers(path);
    if (components.empty()) return all;
    std::vector<double> kept;
    for (std::size_t row = 0; row + shape.back() <= all.size(); row += shape.back())
      for (int c : components) kept.push_back(all[row + static_cast<std::size_t>(c)]);
    return kept;
  }

  study::HistoryView view() const {
    const auto width = components.size();
    if (width == 0) return {time.data(), displacement.data(), shape[0], shape[1], shape[2]};
    return {time.data(), displacement.data(), shape[0], shape[1], width, width, width};
  }

  io::ResultsReader reader;
  std::vector<std::size_t> shape;
  std::vector<int> components;  ///< empty: a string
  std::vector<double> time, displacement;
};

/// Times of a motion inside a window, both ends included (to 1e-9 s).
std::vector<double> timesInside(const Motion& motion, const study::Window& window) {
  constexpr double tolerance = 1e-9;  // s
  std::vector<double> times;
  std::copy_if(motion.time.begin(), motion.time.end(), std::back_inserter(times), [&](double t) {
    return t >= window.begin - tolerance && t <= window.end + tolerance;
  });
  return times;
}

std::string describeTimes(const std::string& folder, const std::vector<double>& times) {
  const std::string count = folder + " holds " + std::to_string(times.size()) + " samples";
  return times.empty() ? count
                       : count + " from " + formatNumber(times.front()) + " to " +
                             formatNumber(times.back()) + " s";
}

/// Times that both motions were sampled at inside the window. UsageError when there are none, or
/// others in one of them.
std::vector<double> commonTimes(const CompareOptions& options, const Motion& motion,
                                const Motion& reference, const study::Window& window) {
  const auto mine = timesInside(motion, window), theirs = timesInside(reference, window);
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  if (mine.empty() || !std::equal(mine.begin(), mine.end(), theirs.begin(), theirs.end(), same))
    throw UsageError("Between " + formatNumber(window.begin) + " and " + formatNumber(window.end) +
                     " s " + describeTimes(options.folder, mine) + " and " +
                     describeTimes(options.reference, theirs) +
                     ". Choose a window that both runs reached, with the same Sampling Interval "
                     "(--from, --to).");
  return mine;
}

struct Errors {
  study::ErrorProfile overTime, overNodes;
  double dyn = 0.0;
};

/// All errors inside the window. UsageError when the motions cannot be measured against each other.
Errors errorsOf(const Motion& motion, const Motion& reference, const study::Window& window) {
  try {
    return {study::errorOverTime(motion.view(), reference.view(), window),
            study::errorOverNodes(motion.view(), reference.view(), window),
            study::vibrationError(motion.view(), reference.view(),
                                  reference.measured("/static/displacement"), window)};
  } catch (const FileError&) {
    throw;
  } catch (const Error& refusal) {  // of the metrics: what the user's files hold cannot be measured
    throw UsageError(refusal.what());
  }
}

}  // namespace

void compare(const CompareOptions& options) {
  const Motion motion(options.folder);
  const Motion reference(options.reference);
  if (motion.shape.size() != 3 || motion.shape[1] != reference.shape[1] ||
      motion.components != reference.components)
    throw UsageError(options.folder + " and " + options.reference +
                     " hold the motion of different scenes.");
  const study::Window window{options.begin, options.end};
  const auto times = commonTimes(options, motion, reference, window);
  const auto errors = errorsOf(motion, reference, window);
  if (options.json) {
    const nlohmann::ordered_json report{
        {"folder", options.folder},
        {"reference", options.reference},
        {"window", {{"begin", times.front()}, {"end", times.back()}, {"samples", times.size()}}},
        {"eps_t", {{"max", errors.overTime.max()}, {"mean", errors.overTime.mean()}}},
        {"eps_n", {{"max", errors.overNodes.max()}}},
        {"dyn", errors.dyn}};
    log::info(report.dump(2));
  } else {
    char line[256];
    std::snprintf(
        line, sizeof line,
        "window %g to %g s (%zu samples): eps_t max %.4e mean %.4e, eps_n max %.4e, dyn %.4e",
        times.front(), times.back(), times.size(), errors.overTime.max(), errors.overTime.mean(),
        errors.overNodes.max(), errors.dyn);
    log::info(line);
  }
  if (options.failAbove && errors.dyn > *options.failAbove)
    throw ConvergenceError("The vibration error dyn of " + options.folder + " is " +
                           formatNumber(errors.dyn) + ", more than the " +
                           formatNumber(*options.failAbove) +
                           " of --fail-above. Reduce Transient/Step, or keep more modes.");
}

}  // namespace tooljoint::app
