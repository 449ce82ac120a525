// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A bound of time scales of a model, found node by node.
#pragma once

#include "model/SecondOrderModel.hpp"

namespace tooljoint::model {

/// The largest omega^2 [rad2/s2] of single nodes (and of coordinates without a node) on springs
/// K_ii
///
///     det(K_D - omega^2 M_nn) = 0,   K_D = diag(|K_ii|) at time t,
///
/// over the motions that have mass: where a node has mass in one direction alone, M_ii of a dof
/// nearly across it is small, but no frequency is high. 0 where nothing has mass and stiffness.
double fastestNode(const SecondOrderModel& model, double t);

}  // namespace tooljoint::model
