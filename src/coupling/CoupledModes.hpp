// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Undamped modes of a coupled model, whatever way it was assembled.
#pragma once

#include "coupling/Assembler.hpp"
#include "linalg/EigenSolver.hpp"

namespace tooljoint::coupling {

/// The `count` lowest modes about the initial state (symmetric part of the stiffness at t = 0, closed contacts linear); the vectors are in
/// coordinates of the model, multipliers included. linalg::lowestModes, or, where the mass is singular, linalg::semidefiniteModes (which returns
/// fewer when there are fewer finite ones).
linalg::EigenPairs lowestModes(const model::SecondOrderModel& model, int count);

}  // namespace tooljoint::coupling
