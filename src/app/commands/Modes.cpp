// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"
#include "cases/ModesReport.hpp"

namespace tooljoint::app {

void modes(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  cases::listModes(*one, {options.modeCount, options.modeTime, options.output, options.coupledOnly,
                          options.bases});
  if (!options.output.empty()) reportAtEnd(options.output, one->output().report);
}

}  // namespace tooljoint::app
