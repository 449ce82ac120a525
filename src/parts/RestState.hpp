// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static equilibrium of any second-order model.
#pragma once

#include "model/NonlinearSolve.hpp"
#include "model/SecondOrderModel.hpp"

namespace tooljoint::parts {

/// q with K(t) q = F(t) + sum R' f(d, 0, t), starting from the initial displacement of the model.
/// ConvergenceError; ModelError if a dof is not supported.
Vector restState(const model::SecondOrderModel& model, double t,
                 const model::NonlinearSolver& solver);

}  // namespace tooljoint::parts
