// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>

#include "app/commands/Command.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "study/FolderComparison.hpp"

namespace tooljoint::app {

namespace {

/// Two results folders, and the window of time for the comparison [s].
struct CompareOptions {
  std::string folder;
  std::string reference;
  double begin = 0.0;
  std::optional<double> end;        ///< by default 3 s after the beginning
  std::optional<double> failAbove;  ///< largest accepted vibration error
  bool json = false;                ///< print JSON instead of the readable line
};

/// eps_t, eps_n ((45) and (46) of Nguyen et al. 2020) and the vibration error. UsageError: the
/// folders hold different scenes or different times in the window, or the reference does not move
/// in it; ConvergenceError: the vibration error is above options.failAbove.
void compare(const CompareOptions& options) {
  constexpr double usualSpan = 3.0;  // s, over which motions are compared by values
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

Action prepareCompare(CLI::App& line) {
  auto options = std::make_shared<CompareOptions>();
  line.add_option("DIR", options->folder, "results folder")->type_name("DIR")->required();
  line.add_option("REFERENCE", options->reference, "results folder of the reference run")
      ->type_name("DIR")
      ->required();
  line.add_option("--from", options->begin, "start of the window [s]")->check(anyNumber());
  line.add_option("--to", options->end, "end of the window [s] (default: 3 s after --from)")
      ->check(anyNumber());
  line.add_option("--fail-above", options->failAbove,
                  "end with exit code 4 when the vibration error is larger than this")
      ->check(zeroOrMore());
  line.add_flag("--json", options->json, "print the errors and the window as JSON");
  return [options] { compare(*options); };
}

const bool compareRegistered =
    addCommand({Group::Results, "compare",
                "errors eps_t, eps_n and the vibration error of one run against a reference run",
                prepareCompare});

}  // namespace

}  // namespace tooljoint::app
