// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/Map.hpp"

#include <filesystem>

#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/run/AnalysisFiles.hpp"

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
    reportAtEnd(cases::analysisFolder(*one, own.output, "map"), one->output().report);
  } else if (!options.row.empty()) {
    study::computeMapRow(*one, options.row, own);
  } else {
    study::runMap(*one, own);
    reportAtEnd(cases::analysisFolder(*one, own.output, "map"), one->output().report);
  }
}

}  // namespace tooljoint::app
