// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `tooljoint modes` with what its flags choose.
#pragma once

#include "app/commands/Commands.hpp"

namespace tooljoint::app {

struct ModesChoice {
  bool coupled = false;  ///< undamped modes of the coupled model and their estimated errors alone
  bool bases = false;    ///< the vectors of the bases too
};

void modes(const RunOptions& options, const ModesChoice& choice);

}  // namespace tooljoint::app
