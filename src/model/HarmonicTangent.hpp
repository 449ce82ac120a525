// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws with states in small motions e^{s t}, which the states follow.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "model/SecondOrderModel.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::model {

/// What the states of a law add to its tangent df/dd + s df/dv in a motion e^{s t} about (d, v):
///
///     (h - 1) f_d + f_x (s - g_x)^-1 (g_d + s g_v)
///
/// with h of StatefulPointLaw::heldFactor(), 1 where a law does not know it; width x width per
/// point, row-major.
std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, Complex s);
/// The same of s = i omega. At omega = 0, where an integral has no value, that of slowestOmega.
std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, double omega);

/// Smallest omega that tangentByStates() separates from rest [rad/s].
constexpr double slowestOmega = 1e-6;

/// Point sets whose states change the tangent of small motions about q(0) of the model at the time
/// t, or may do so.
std::vector<std::string> setsWithMovingStates(const SecondOrderModel& model, double t);
/// Those of them whose laws do not say how their held states follow.
std::vector<std::string> setsWithUnknownStates(const SecondOrderModel& model, double t);

}  // namespace tooljoint::model
