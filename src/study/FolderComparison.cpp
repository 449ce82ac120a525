// SPDX-License-Identifier: BSD-3-Clause
#include "study/FolderComparison.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <utility>

#include "cases/imported/MeasuredComponents.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "io/ResultsReader.hpp"

namespace tooljoint::study {

namespace {

/// A recorded motion in memory: all components of a string, the measured ones of a scene of parts.
struct Motion {
  explicit Motion(const std::string& folder)
      : reader(folder + "/results.h5"), shape(reader.shape("/transient/displacement")) {
    if (reader.has("/model/components"))
      components = cases::measuredComponents(reader.texts("/model/components"));
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

  HistoryView view() const {
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
std::vector<double> timesInside(const Motion& motion, const Window& window) {
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
std::vector<double> commonTimes(const ComparedFolders& folders, const Motion& motion,
                                const Motion& reference, const Window& window) {
  const auto mine = timesInside(motion, window), theirs = timesInside(reference, window);
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  if (mine.empty() || !std::equal(mine.begin(), mine.end(), theirs.begin(), theirs.end(), same))
    throw UsageError("Between " + formatNumber(window.begin) + " and " + formatNumber(window.end) +
                     " s " + describeTimes(folders.folder, mine) + " and " +
                     describeTimes(folders.reference, theirs) +
                     ". Choose a window that both runs reached, with the same Sampling Interval "
                     "(--from, --to).");
  return mine;
}

/// All errors inside the window. UsageError when the motions cannot be measured against each other.
MotionErrors errorsOf(const Motion& motion, const Motion& reference, const Window& window,
                      std::vector<double> times) {
  try {
    return {std::move(times), errorOverTime(motion.view(), reference.view(), window),
            errorOverNodes(motion.view(), reference.view(), window),
            vibrationError(motion.view(), reference.view(),
                           reference.measured("/static/displacement"), window)};
  } catch (const FileError&) {
    throw;
  } catch (const Error& refusal) {  // of the metrics: what the user's files hold cannot be measured
    throw UsageError(refusal.what());
  }
}

}  // namespace

MotionErrors compareFolders(const ComparedFolders& folders, const Window& window) {
  const Motion motion(folders.folder);
  const Motion reference(folders.reference);
  if (motion.shape.size() != 3 || motion.shape[1] != reference.shape[1] ||
      motion.components != reference.components)
    throw UsageError(folders.folder + " and " + folders.reference +
                     " hold the motion of different scenes.");
  return errorsOf(motion, reference, window, commonTimes(folders, motion, reference, window));
}

}  // namespace tooljoint::study
