// SPDX-License-Identifier: BSD-3-Clause
#include "response/campbell/Campbell.hpp"

#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"

namespace tooljoint::app {

void campbell(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  tooljoint::response::runCampbell(*one, options.output, options.fresh);
  endAnalysis("campbell", *one, options.output);
}

}  // namespace tooljoint::app
