// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/StudyProgress.hpp"

#include <algorithm>
#include <cstdio>
#include <string>

#include "common/Parallel.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::study {

std::string duration(double seconds) {
  char text[32];
  if (seconds < 90.0)
    std::snprintf(text, sizeof text, "%.0f s", seconds);
  else if (seconds < 5400.0)
    std::snprintf(text, sizeof text, "%.0f min", seconds / 60.0);
  else
    std::snprintf(text, sizeof text, "%.1f h", seconds / 3600.0);
  return text;
}

void StudyProgress::report(std::size_t run, const StudyRow& row, const std::vector<int>& timed,
                           double wall) {
  if (row.plan.kind != RunKind::Method) return;
  spent_ += wall;
  ++executed_;
  wall_[run] = wall;
  const auto wanted = static_cast<std::size_t>(plan_.settings.repeats);
  std::size_t done = 0, all = 0;
  double left = 0.0;
  for (std::size_t k = plan_.referenceRuns(); k < plan_.runs.size(); ++k) {
    if (plan_.runs[k].twin != k) continue;
    const auto had = timed[k] < 0 ? wanted : std::min(static_cast<std::size_t>(timed[k]), wanted);
    all += wanted;
    done += had;
    // a run without a time yet is assumed to take the average time of the others
    left += static_cast<double>(wanted - had) * (wall_[k] > 0.0 ? wall_[k] : spent_ / executed_);
  }
  char line[512] = "";
  if (row.status == "failed")
    std::snprintf(line, sizeof line, "failed: %.360s", row.reason.c_str());
  else if (parallel::rank() == 0)
    std::snprintf(line, sizeof line, "%.3g s CPU, vibration error %.2e", row.cpu.back(),
                  row.errors->vibration);
  log::info("run " + std::to_string(done) + " of " + std::to_string(all) + "  " + row.plan.label +
            ": " + line + (done < all ? "; about " + duration(left / groups_) + " left" : ""));
}

}  // namespace tooljoint::study
