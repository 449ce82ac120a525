// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/Map.hpp"

#include <filesystem>

#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"

namespace tooljoint::app {

void map(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  study::MapOptions own{options.output, options.fresh, options.ranksPerRow};
  if (!options.plan.empty()) {
    study::planMapRows(*one, options.plan, std::filesystem::read_symlink("/proc/self/exe").string(),
                       own);
  } else if (!options.collect.empty()) {
    own.output = options.collect;
    study::collectMap(*one, own);
    endAnalysis("map", *one, own.output);
  } else if (!options.row.empty()) {
    study::computeMapRow(*one, options.row, own);
  } else {
    study::runMap(*one, own);
    endAnalysis("map", *one, own.output);
  }
}

}  // namespace tooljoint::app
