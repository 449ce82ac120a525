// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Modes.hpp"

#include "cases/CaseKinds.hpp"
#include "cases/ModesReport.hpp"

namespace tooljoint::app {

void modes(const RunOptions& options) { modes(options, {}); }

void modes(const RunOptions& options, const ModesChoice& choice) {
  const auto one = cases::readCase(options.deck, options.overrides);
  cases::listModes(
      *one, {options.modeCount, options.modeTime, options.output, choice.coupled, choice.bases});
}

}  // namespace tooljoint::app
