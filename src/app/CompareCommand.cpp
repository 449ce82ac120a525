// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>

#include "app/Commands.hpp"
#include "common/Log.hpp"
#include "io/ResultsReader.hpp"
#include "study/Metrics.hpp"

namespace tooljoint::app {

namespace {

/// A recorded motion in memory.
struct Motion {
  explicit Motion(const std::string& folder) : reader(folder + "/results.h5"), shape(reader.shape("/transient/displacement")) {
    time = reader.numbers("/transient/time");
    displacement = reader.numbers("/transient/displacement");
  }
  study::HistoryView view() const { return {time.data(), displacement.data(), shape[0], shape[1], shape[2]}; }

  io::ResultsReader reader;
  std::vector<std::size_t> shape;
  std::vector<double> time, displacement;
};

}  // namespace

void compare(const CompareOptions& options) {
  const Motion motion(options.folder);
  const Motion reference(options.reference);
  const study::Window window{options.begin, options.end};
  const auto overTime = study::errorOverTime(motion.view(), reference.view(), window);
  const auto overNodes = study::errorOverNodes(motion.view(), reference.view(), window);
  const double dyn = study::vibrationError(motion.view(), reference.view(), reference.reader.numbers("/static/displacement"), window);
  char line[256];
  std::snprintf(line, sizeof line, "window %g to %g s: eps_t max %.4e mean %.4e, eps_n max %.4e, dyn %.4e", options.begin, options.end,
                overTime.max(), overTime.mean(), overNodes.max(), dyn);
  log::info(line);
}

}  // namespace tooljoint::app
