// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How steps of one length follow a law of time.
#pragma once

#include "model/ScalarLaw.hpp"

namespace tooljoint::transient {

/// Of a law f over a step, with s from 0 at its begin to 1 at its end.
struct LawMoments {
  double mean = 0;   ///< int f ds
  double first = 0;  ///< int s f ds
};

/// Whether a law has a corner with begin < corner <= end.
bool hasCorner(const model::ScalarLaw& law, double begin, double end);

/// Pieces between corners are smooth: three points of Gauss each.
LawMoments momentsOf(const model::ScalarLaw& law, double begin, double end);

/// sum |T_h - T_{h/8}| / sum |T_{h/8}|, with T the trapezoidal sums of a law over a step and over
/// its eighths and corners. What the first step has too much is left out: a load that is let go at
/// the start has its value there alone, and no integral to compare that with. \param followsCorners
/// steps with a corner have the moments of the law, as loads have, and miss nothing
double missedPart(const model::ScalarLaw& law, double start, double end, double h,
                  bool followsCorners);

}  // namespace tooljoint::transient
