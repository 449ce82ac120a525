// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws with moving states in small motions e^{s t}.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/SecondOrderModel.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::model {

/// Contribution of the states of a law to its tangent df/dd + s df/dv in a motion e^{s t} about (d,
/// v):
///
///     (h - 1) f_d + f_x (s - g_x)^-1 (g_d + s g_v)
///
/// with h of StatefulPointLaw::heldFactor(), 1 if the law does not define it; width x width per
/// point, row-major.
std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, Complex s);
/// The same for s = i omega. omega = 0, where an integral has no value, is replaced by
/// slowestOmega.
std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, double omega);

/// Smallest omega that tangentByStates() separates from rest [rad/s].
constexpr double slowestOmega = 1e-6;

/// Point sets whose states change, or may change, the tangent of small motions about q(0) of the
/// model at the time t.
std::vector<std::string> setsWithMovingStates(const SecondOrderModel& model, double t);
/// Those of them whose laws do not define the motion of their held states.
std::vector<std::string> setsWithUnknownStates(const SecondOrderModel& model, double t);

}  // namespace tooljoint::model
