// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>

#include "app/commands/Commands.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "study/FolderComparison.hpp"

namespace tooljoint::app {

void compare(const CompareOptions& options) {
  constexpr double usualSpan = 3.0;  // s, over which motions are told apart by values
  const double end = options.end.value_or(options.begin + usualSpan);
  if (end < options.begin)
    throw UsageError("--to " + formatNumber(end) + " is before --from " +
                     formatNumber(options.begin) + ".");
  const auto errors =
      study::compareFolders({options.folder, options.reference}, {options.begin, end});
  if (options.json) {
    const nlohmann::ordered_json report{
        {"folder", options.folder},
        {"reference", options.reference},
        {"window",
         {{"begin", errors.times.front()},
          {"end", errors.times.back()},
          {"samples", errors.times.size()}}},
        {"eps_t", {{"max", errors.overTime.max()}, {"mean", errors.overTime.mean()}}},
        {"eps_n", {{"max", errors.overNodes.max()}}},
        {"vibration_error", errors.vibration}};
    if (parallel::rank() == 0) std::cout << report.dump(2) << std::endl;
  } else {
    char line[256];
    std::snprintf(line, sizeof line,
                  "window %g to %g s (%zu samples): eps_t max %.4e mean %.4e, eps_n max %.4e, "
                  "vibration error %.4e",
                  errors.times.front(), errors.times.back(), errors.times.size(),
                  errors.overTime.max(), errors.overTime.mean(), errors.overNodes.max(),
                  errors.vibration);
    log::info(line);
  }
  if (!options.failAbove || errors.vibration <= *options.failAbove) return;
  char found[32];
  std::snprintf(found, sizeof found, "%.4g", errors.vibration);
  throw ConvergenceError("The vibration error of " + options.folder + " is " + found +
                         ", more than the " + formatNumber(*options.failAbove) +
                         " of --fail-above. Reduce Transient/Step, or keep more modes.");
}

}  // namespace tooljoint::app
