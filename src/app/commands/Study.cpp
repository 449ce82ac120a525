// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/Study.hpp"

#include "app/commands/Commands.hpp"
#include "cases/CaseKinds.hpp"

namespace tooljoint::app {

void study(const RunOptions& options) {
  const auto one = cases::readCase(options.deck, options.overrides);
  tooljoint::study::run(*one, {options.output, options.fresh});
}

}  // namespace tooljoint::app
