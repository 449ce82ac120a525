// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/TorqueDrag.hpp"

#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"
#include "common/Error.hpp"
#include "substructures/drillstring/case/DrillstringCase.hpp"

namespace tooljoint::app {

void torqueDrag(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(one.get());
  if (string == nullptr)
    throw DeckError(options.deck +
                    ": torque and drag needs a string in its well. Give a deck with the lists Well "
                    "and Drillstring.");
  drillstring::reportTorqueDrag(*string, options.output, options.fresh);
  endAnalysis("torque_drag", *one, options.output);
}

}  // namespace tooljoint::app
