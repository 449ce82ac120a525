// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is said of laws of time that change faster than the steps of a run follow.
#pragma once

#include "model/SecondOrderModel.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

struct JudgedSpan {
  double start, end;      ///< [s]
  double stepErrorLimit;  ///< of the run; from 1 on no law is refused
};

/// Of steps of one length that miss more than 1 % of the integral of a law over time it warns
/// (missedPart()); more than half is refused. Of steps that follow their error it says nothing.
/// Throws ConvergenceError.
void judgeLaws(const model::SecondOrderModel& model, const Integrator& run, const JudgedSpan& span);

}  // namespace tooljoint::transient
