// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Coordinates of a coupled model that follow others are taken out of it.
#pragma once

#include "coupling/Assembler.hpp"
#include "reduction/Basis.hpp"

namespace tooljoint::coupling {

/// q = [1; rows] z in all matrices, loads, point rows, recovery and maps, z the other coordinates;
/// a start that is not in their span is fitted in least squares of mass. Nothing happens without
/// followers. ModelError for a model with multipliers.
void follow(Coupling& coupling, const reduction::Followers& followers);

}  // namespace tooljoint::coupling
