// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <cstdio>

#include "app/Commands.hpp"
#include "app/PartsDeck.hpp"
#include "common/Error.hpp"
#include "common/Log.hpp"
#include "common/Text.hpp"
#include "io/ResultsReader.hpp"
#include "study/Metrics.hpp"

namespace tooljoint::app {

namespace {

/// A recorded motion in memory: all components of a string, the measured ones of a scene of parts.
struct Motion {
  explicit Motion(const std::string& folder) : reader(folder + "/results.h5"), shape(reader.shape("/transient/displacement")) {
    if (reader.has("/model/components")) components = measuredComponents(reader.texts("/model/components"));
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

}  // namespace

void compare(const CompareOptions& options) {
  const Motion motion(options.folder);
  const Motion reference(options.reference);
  if (motion.shape.size() != 3 || motion.shape[1] != reference.shape[1] || motion.components != reference.components)
    throw UsageError(options.folder + " and " + options.reference + " hold the motion of different scenes.");
  const auto samples = [&](const Motion& of) {
    return std::count_if(of.time.begin(), of.time.end(), [&](double t) { return t >= options.begin - 1e-9 && t <= options.end + 1e-9; });
  };
  if (samples(motion) != samples(reference) || samples(motion) == 0)
    throw UsageError("Between " + formatNumber(options.begin) + " and " + formatNumber(options.end) + " s " + options.folder + " holds " +
                     std::to_string(samples(motion)) + " samples and " + options.reference + " " + std::to_string(samples(reference)) +
                     ". Choose a window that both runs reached, with the same Sampling Interval (--from, --to).");
  const study::Window window{options.begin, options.end};
  const auto overTime = study::errorOverTime(motion.view(), reference.view(), window);
  const auto overNodes = study::errorOverNodes(motion.view(), reference.view(), window);
  const double dyn = study::vibrationError(motion.view(), reference.view(), reference.measured("/static/displacement"), window);
  char line[256];
  std::snprintf(line, sizeof line, "window %g to %g s: eps_t max %.4e mean %.4e, eps_n max %.4e, dyn %.4e", options.begin, options.end,
                overTime.max(), overTime.mean(), overNodes.max(), dyn);
  log::info(line);
}

}  // namespace tooljoint::app
