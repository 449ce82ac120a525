// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether steps of one length follow a law of time.
#pragma once

#include "model/ScalarLaw.hpp"

namespace tooljoint::transient {

/// sum |T_h - T_{h/8}| / sum |T_{h/8}|, with T the trapezoidal sums of a law over a step and over
/// its eighths and corners. What the first step has too much is left out: a load that is let go at
/// the start has its value there alone, and no integral to compare that with.
double missedPart(const model::ScalarLaw& law, double start, double end, double h);

}  // namespace tooljoint::transient
