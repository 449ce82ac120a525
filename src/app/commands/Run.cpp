// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/Run.hpp"

#include "app/commands/Commands.hpp"
#include "app/text/LastScreen.hpp"
#include "cases/CaseKinds.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

namespace tooljoint::app {

void run(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(one.get());
  const bool dragged = string != nullptr && drillstring::torqueDragAfterRun(*string);
  const auto folder = cases::run(*one, {options.output, options.restart});
  if (dragged) drillstring::reportTorqueDrag(*string, folder, false, true);
  reportAtEnd(folder, one->output().report);
  lastScreen(folder, one->deck());
}

}  // namespace tooljoint::app
