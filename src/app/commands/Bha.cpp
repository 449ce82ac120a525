// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"
#include "common/Error.hpp"
#include "substructures/drillstring/analyses/bottom_hole/BottomHole.hpp"

namespace tooljoint::app {

void bha(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(one.get());
  if (string == nullptr)
    throw DeckError(options.deck +
                    ": a bottom-hole assembly needs a string in its well. Give a deck with the "
                    "lists Well and Drillstring.");
  drillstring::reportBottomHole(*string, options.output, options.fresh);
  endAnalysis("bha", *one, options.output);
}

}  // namespace tooljoint::app
