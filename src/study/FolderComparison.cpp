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

/// Largest distance of corresponding nodes in two runs, as a fraction of the extent of the scene:
/// the path of a string depends on its loads.
constexpr double samePlace = 1e-2;

/// A recorded motion in memory: all components of a string, the measured ones of a scene of parts.
struct Motion {
  explicit Motion(const std::string& folder)
      : reader(folder + "/results.h5"), shape(reader.shape("/transient/displacement")) {
    if (reader.has("/model/components"))
      components = cases::measuredComponents(reader.texts("/model/components"));
    time = reader.numbers("/transient/time");
    displacement = measured("/transient/displacement");
    const auto all = shape.size() > 1 ? shape[1] : 0;
    if (reader.has("/transient/node"))
      for (double row : reader.numbers("/transient/node"))
        nodes.push_back(static_cast<std::size_t>(row) - 1);
    else
      for (std::size_t row = 0; row < all; ++row) nodes.push_back(row);
  }

  /// Largest distance of the nodes from those of another file, relative to the extent of both; 0 if
  /// one of them has no positions.
  double apartFrom(const Motion& other) const {
    constexpr const char* places = "/model/position";
    if (!reader.has(places) || !other.reader.has(places)) return 0.0;
    const auto here = reader.numbers(places), there = other.reader.numbers(places);
    if (here.size() != there.size() || here.empty()) return 0.0;
    double apart = 0.0, extent = 0.0;
    for (std::size_t i = 0; i < here.size(); ++i) {
      apart = std::max(apart, std::abs(here[i] - there[i]));
      extent = std::max(extent, std::abs(here[i] - here[i % 3]));
    }
    return extent > 0.0 ? apart / extent : 0.0;
  }

  /// Keeps only the motion of these recorded nodes.
  void keep(const std::vector<std::size_t>& wanted) {
    if (wanted == nodes) return;
    displacement = ofNodes(displacement, nodes, wanted);
    nodes = wanted;
    shape[1] = wanted.size();
  }

  /// Displacements at rest of the remaining nodes.
  std::vector<double> rest() const {
    const auto all = measured("/static/displacement");
    std::vector<std::size_t> rows(all.size() / width());
    for (std::size_t row = 0; row < rows.size(); ++row) rows[row] = row;
    return ofNodes(all, rows, nodes);
  }

  std::vector<double> measured(const std::string& path) const {
    const auto all = reader.numbers(path);
    if (components.empty()) return all;
    std::vector<double> kept;
    for (std::size_t row = 0; row + shape.back() <= all.size(); row += shape.back())
      for (int c : components) kept.push_back(all[row + static_cast<std::size_t>(c)]);
    return kept;
  }

  std::size_t width() const { return components.empty() ? shape.back() : components.size(); }

  /// Selects the values of the nodes `wanted` from those of the nodes `from`, sample by sample;
  /// both increase.
  std::vector<double> ofNodes(const std::vector<double>& values,
                              const std::vector<std::size_t>& from,
                              const std::vector<std::size_t>& wanted) const {
    std::vector<double> kept;
    for (std::size_t first = 0; first < values.size(); first += from.size() * width())
      for (std::size_t node : wanted) {
        const auto place = static_cast<std::size_t>(
            std::lower_bound(from.begin(), from.end(), node) - from.begin());
        const auto begin = values.begin() + static_cast<std::ptrdiff_t>(first + place * width());
        kept.insert(kept.end(), begin, begin + static_cast<std::ptrdiff_t>(width()));
      }
    return kept;
  }

  std::size_t sceneNodes() const { return reader.shape("/static/displacement").front(); }

  HistoryView view() const {
    if (components.empty()) return {time.data(), displacement.data(), shape[0], shape[1], shape[2]};
    return {time.data(), displacement.data(), shape[0], shape[1], width(), width(), width()};
  }

  io::ResultsReader reader;
  std::vector<std::size_t> shape;
  std::vector<int> components;     ///< empty: a string
  std::vector<std::size_t> nodes;  ///< recorded nodes, rows of the arrays of /model
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

std::string describeTimes(const std::string& folder, const Motion& motion,
                          const std::vector<double>& times) {
  const std::string count = folder + " holds " + std::to_string(times.size()) + " samples";
  if (times.empty() && motion.time.empty()) return count;
  return times.empty() ? count + " (it ends at " + formatNumber(motion.time.back()) + " s)"
                       : count + " from " + formatNumber(times.front()) + " to " +
                             formatNumber(times.back()) + " s";
}

/// Common sampling times of both motions inside the window. UsageError if there are none, or if one
/// motion has additional times.
std::vector<double> commonTimes(const ComparedFolders& folders, const Motion& motion,
                                const Motion& reference, const Window& window) {
  const auto mine = timesInside(motion, window), theirs = timesInside(reference, window);
  const auto same = [](double a, double b) { return std::abs(a - b) < 1e-9; };
  if (mine.empty() || !std::equal(mine.begin(), mine.end(), theirs.begin(), theirs.end(), same))
    throw UsageError("Between " + formatNumber(window.begin) + " and " + formatNumber(window.end) +
                     " s " + describeTimes(folders.folder, motion, mine) + " and " +
                     describeTimes(folders.reference, reference, theirs) +
                     ". Choose a window that both runs reached, with the same Sampling Interval "
                     "(--from, --to).");
  return mine;
}

/// All errors inside the window. UsageError when the motions cannot be compared.
MotionErrors errorsOf(const Motion& motion, const Motion& reference, const Window& window,
                      std::vector<double> times) {
  try {
    return {std::move(times), errorOverTime(motion.view(), reference.view(), window),
            errorOverNodes(motion.view(), reference.view(), window),
            vibrationError(motion.view(), reference.view(), reference.rest(), window)};
  } catch (const FileError&) {
    throw;
  } catch (const Error& refusal) {  // thrown by the metrics: the files of the user cannot be
                                    // compared
    throw UsageError(refusal.what());
  }
}

}  // namespace

MotionErrors compareFolders(const ComparedFolders& folders, const Window& window) {
  Motion motion(folders.folder);
  Motion reference(folders.reference);
  if (motion.shape.size() != 3 || motion.sceneNodes() != reference.sceneNodes() ||
      motion.components != reference.components)
    throw UsageError(folders.folder + " and " + folders.reference +
                     " hold the motion of different scenes.");
  if (const double apart = motion.apartFrom(reference); apart > samePlace)
    throw UsageError(folders.folder + " and " + folders.reference +
                     " hold the motion of different scenes: their nodes stand up to " +
                     formatNumber(std::round(1e3 * apart) / 10.0) + " % of their extent apart.");
  std::vector<std::size_t> common;
  std::set_intersection(motion.nodes.begin(), motion.nodes.end(), reference.nodes.begin(),
                        reference.nodes.end(), std::back_inserter(common));
  if (common.empty())
    throw UsageError(folders.folder + " and " + folders.reference +
                     " recorded the motion of different nodes (Output/Depths, Output/Nodes).");
  motion.keep(common);
  reference.keep(common);
  return errorsOf(motion, reference, window, commonTimes(folders, motion, reference, window));
}

}  // namespace tooljoint::study
