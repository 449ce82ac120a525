// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "app/text/AnalysisScreens.hpp"
#include "cases/CaseKinds.hpp"
#include "common/Error.hpp"
#include "substructures/drillstring/buckling/BucklingPath.hpp"

namespace tooljoint::app {

void buckling(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(one.get());
  if (string == nullptr)
    throw DeckError(
        options.deck +
        ": buckling needs a string in its well. Give a deck with the lists Well and Drillstring.");
  drillstring::reportBuckling(*string, options.output, options.fresh);
  endAnalysis("buckling", *one, options.output);
}

}  // namespace tooljoint::app
