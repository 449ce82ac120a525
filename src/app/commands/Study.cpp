// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/Study.hpp"

#include <filesystem>

#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"

namespace tooljoint::app {

void study(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  study::StudyOptions own{options.output, options.fresh, options.ranksPerRow,
                          options.timing == "shared"};
  if (!options.plan.empty()) {
    study::plan(*one, options.plan, std::filesystem::read_symlink("/proc/self/exe").string(), own);
  } else if (!options.collect.empty()) {
    own.output = options.collect;
    study::collect(*one, own);
    endAnalysis("study", *one, own.output);
  } else if (!options.row.empty()) {
    study::computeRow(*one, options.row, own);
  } else {
    study::run(*one, own);
    endAnalysis("study", *one, own.output);
  }
}

}  // namespace tooljoint::app
