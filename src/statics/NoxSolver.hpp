// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Binds the nonlinear problems of the path and of the static state to the NOX driver of this room.
#pragma once

#include <Teuchos_ParameterList.hpp>

#include "model/NonlinearSolve.hpp"

namespace tooljoint::statics {

/// Solver with the sublists `NOX` and `Belos` of `list` (a validated `Path` or `Static` list), if
/// present. All ranks of parallel::communicator() call it together with the same problem; long
/// chains (model::ChainProblem) are divided among them.
model::NonlinearSolver noxSolver(const Teuchos::ParameterList& list);

}  // namespace tooljoint::statics
