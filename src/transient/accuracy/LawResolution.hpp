// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether steps of one length follow a law of time.
#pragma once

#include "model/ScalarLaw.hpp"

namespace tooljoint::transient {

/// Parts of the sum of |T_{h/8}|, with T the trapezoidal sums of a law over a step and over its
/// eighths.
struct LawParts {
  double missed = 0;  ///< sum of |T_h - T_{h/8}|
  double lost = 0;    ///< of it where |T_h| is the smaller: the steps do not see the law
};
LawParts missedParts(const model::ScalarLaw& law, double start, double end, double h);

}  // namespace tooljoint::transient
