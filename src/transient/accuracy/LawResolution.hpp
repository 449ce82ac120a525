// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How well steps of equal length resolve a law of time.
#pragma once

#include "model/ScalarLaw.hpp"

namespace tooljoint::transient {

/// Moments of a law f over a step; s runs from 0 at its start to 1 at its end.
struct LawMoments {
  double mean = 0;   ///< int f ds
  double first = 0;  ///< int s f ds
};

/// Whether a law has a corner with begin < corner <= end.
bool hasCorner(const model::ScalarLaw& law, double begin, double end);

/// Pieces between corners are smooth; each is integrated by Gauss' rule with three points.
LawMoments momentsOf(const model::ScalarLaw& law, double begin, double end);

/// sum |T_h - T_{h/8}| / sum |T_{h/8}|, with T the trapezoidal sums of a law over a step and over
/// its eighths and corners. An excess of the first step is ignored: a load released at the start
/// has its value only there, and no integral for comparison.
/// \param followsCorners steps with a corner integrate the moments of the law, as for loads, and
/// miss nothing
double missedPart(const model::ScalarLaw& law, double start, double end, double h,
                  bool followsCorners);

}  // namespace tooljoint::transient
