// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What is said of the equal steps of a run that has ended: nothing, a warning, or that they are
/// too large.
#pragma once

#include <functional>

#include "transient/TransientParameters.hpp"
#include "transient/verdict/StepComparison.hpp"
#include "transient/verdict/StepError.hpp"

namespace tooljoint::transient {

/// Of `span` seconds from a state on.
using Comparison = std::function<StepComparison(const State& from, double span)>;

/// \return the step error: S; of compared motion D where that is found right, else the largest of
/// S, D and a quarter of the difference V of the velocities; 0 where contact that no step resolves
/// leaves it unknown. Above `Step Error Warning` it warns, and so does a scheme that damps more of
/// the vibration than that; the run fails with an S above 1, unless all of its motion is compared
/// and D within half of the limit. Where S is above half of `Step Error Limit`, or the scheme damps
/// more than a fifth of `Step Error Warning`, or contact rests on walls too stiff for the step, its
/// motion is compared (StepComparison.hpp): it fails when D is above the limit, unless neighbours
/// part as far, and when its speeds are more than 2.5 limits off while D is above the warning, or
/// above 0.4 times that with V above 0.8; right is a D within `Step Error Warning`, with speeds as
/// near and velocities four times as near. Where far more is to follow later in the run
/// (BusiestSpan.hpp), that motion is compared too, and judged alike by D and V alone; where its
/// neighbours part as far it says nothing. A limit of 1 and more is one of S alone. Throws
/// ConvergenceError. Collective.
double judgeSteps(const Integrator& run, const StepError& error, const TransientOptions& options,
                  const Comparison& comparison);

}  // namespace tooljoint::transient
