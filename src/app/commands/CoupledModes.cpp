// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/CoupledModes.hpp"

#include "cases/CaseKinds.hpp"
#include "cases/ModesReport.hpp"

namespace tooljoint::app {

void coupledModes(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  cases::listModes(*one, {options.modeCount, options.modeTime, options.output, true});
}

}  // namespace tooljoint::app
