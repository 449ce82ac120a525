// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A model at a constant rotary speed.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "model/SecondOrderModel.hpp"

namespace tooljoint::model {

/// The model with its laws of the rotary speed (SpeedLaw, laws::Turning) at this constant speed
/// [rad/s]; rotating loads are zero in it. \param friction false: point laws without friction
SecondOrderModel atSpeed(SecondOrderModel model, double speed, bool friction);

/// Complex f of the loads of the model that rotate with the string at this speed, Re(f exp(i speed
/// t)), dofs [N, N m]: mass unbalances.
Eigen::VectorXcd turningLoad(const SecondOrderModel& model, double speed);

/// Names of the laws of the matrices: those that depend on the rotary speed, or the others (except
/// "1").
std::vector<std::string> matrixLaws(const SecondOrderModel& model, bool ofSpeed);

/// Laws of speed that are not defined over this whole range of speeds [rad/s], as text: "stiffness"
/// (0 to 9549 rpm).
std::vector<std::string> matrixLawsBeyond(const SecondOrderModel& model, double least, double most);

}  // namespace tooljoint::model
