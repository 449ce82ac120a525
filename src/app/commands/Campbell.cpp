// SPDX-License-Identifier: BSD-3-Clause
#include "response/campbell/Campbell.hpp"

#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/run/AnalysisFiles.hpp"

namespace tooljoint::app {

void campbell(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  tooljoint::response::runCampbell(*one, options.output, options.fresh);
  reportAtEnd(cases::analysisFolder(*one, options.output, "campbell"), one->output().report);
}

}  // namespace tooljoint::app
