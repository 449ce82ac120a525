// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/ModesReport.hpp"

namespace tooljoint::app {

void modes(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  cases::listModes(*one, {options.modeCount, options.modeTime, options.output, options.coupledOnly,
                          options.bases});
  if (!options.output.empty()) endAnalysis("modes", *one, options.output);
}

}  // namespace tooljoint::app
