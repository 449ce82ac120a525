// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether steps of one length follow a law of time.
#pragma once

#include "model/ScalarLaw.hpp"

namespace tooljoint::transient {

/// How much of a law the steps miss: the sum of |T_h - T_{h/8}| over that of |T_{h/8}|, with T the
/// trapezoidal sums of the law over a step and over its eighths.
double missedPart(const model::ScalarLaw& law, double start, double end, double h);

}  // namespace tooljoint::transient
