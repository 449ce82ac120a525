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

/// Where S is above half of `Step Error Limit`, or the scheme damps more than a fifth of `Step
/// Error Warning`, or contact rests on walls too stiff for the step, the motion is compared
/// (StepComparison.hpp), and where S is above the limit and D within the warning once more, with
/// steps a quarter as long: halves may miss what the steps miss. The step error is then the largest
/// of
///
///     D                       at most the limit where neighbours part as far: chaotic motion
///     (max(r, 1/r) - 1)/2.5   at most 1, where V is above 0.8 and D above 0.4 times the warning
///     min(V/4, limit)         where V/4 is above the warning
///
/// It is min(S, limit) where nothing is compared, and S where that is above 1, unless all of the
/// motion is compared and D within half of the limit. Where far more is to follow later in the run
/// (BusiestSpan.hpp), that motion is compared too, and the larger step error counts; where its
/// neighbours part as far it says nothing. A limit of 1 and more is one of S alone.
///
/// \return the step error; 0 where contact that no step resolves leaves it unknown. Above `Step
/// Error Warning` it warns, and so does a scheme that damps more of the vibration than that; above
/// `Step Error Limit` the run fails. Throws ConvergenceError, and
/// InterruptedError where a comparison was stopped. Collective.
double judgeSteps(const Integrator& run, const StepError& error, const TransientOptions& options,
                  const Comparison& comparison);

}  // namespace tooljoint::transient
