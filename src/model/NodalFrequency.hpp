// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The fastest time scale of a model, estimated node by node.
#pragma once

#include "model/SecondOrderModel.hpp"

namespace tooljoint::model {

/// A mass below this part of its row, or of the largest mass of its node, is rounding of a matrix
/// that was turned, projected on a basis or summed.
constexpr double roundingOfMass = 1e-12;

/// The largest omega^2 [rad2/s2] of single nodes (and of coordinates without a node) on springs
/// K_ii
///
///     det(K_D - omega^2 M_nn) = 0,   K_D = diag(|K_ii|) at time t,
///
/// over the motions with mass. K_ii/M_ii of single dofs is no measure: if a node has mass in one
/// direction only, M_ii of a dof nearly normal to it is small, but no frequency is high. 0 if no
/// dof has mass and stiffness.
double fastestNode(const SecondOrderModel& model, double t);

}  // namespace tooljoint::model
