// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `tooljoint modes --coupled`.
#pragma once

#include "app/commands/Commands.hpp"

namespace tooljoint::app {

/// Modes of the coupled model and their estimated errors, without those of the full model.
void coupledModes(const RunOptions& options);

}  // namespace tooljoint::app
