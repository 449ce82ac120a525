// SPDX-License-Identifier: BSD-3-Clause
#include "response/Response.hpp"

#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/run/AnalysisFiles.hpp"

namespace tooljoint::app {

void response(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  tooljoint::response::runResponse(*one, options.output, options.fresh);
  reportAtEnd(cases::analysisFolder(*one, options.output, "response"), one->output().report);
}

}  // namespace tooljoint::app
