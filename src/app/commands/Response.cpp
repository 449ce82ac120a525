// SPDX-License-Identifier: BSD-3-Clause
#include "response/Response.hpp"

#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"

namespace tooljoint::app {

void response(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  tooljoint::response::runResponse(*one, options.output, options.fresh);
  endAnalysis("response", *one, options.output);
}

}  // namespace tooljoint::app
