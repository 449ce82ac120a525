// SPDX-License-Identifier: BSD-3-Clause
#include "run.hpp"

#include "app/commands/Commands.hpp"

namespace tooljoint::app {

void run(const RunOptions& options) {
  runDeck(options.deck, options.overrides, MPI_COMM_WORLD, {options.output, options.restart});
}

}  // namespace tooljoint::app
