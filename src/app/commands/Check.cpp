// SPDX-License-Identifier: BSD-3-Clause
#include "app/commands/Commands.hpp"
#include "cases/CaseCheck.hpp"
#include "cases/CaseKinds.hpp"

namespace tooljoint::app {

void check(const RunOptions& options) {
  cases::check(*cases::readCase(options.deck, options.overrides), options.cost);
}

}  // namespace tooljoint::app
