// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Verdict on the equal steps of a finished run: accepted, a warning, or too large.
#pragma once

#include <functional>

#include "transient/TransientParameters.hpp"
#include "transient/verdict/StepComparison.hpp"
#include "transient/verdict/StepError.hpp"

namespace tooljoint::transient {

/// Compares `span` seconds from a state on.
using Comparison = std::function<StepComparison(const State& from, double span)>;

/// The motion is compared (StepComparison.hpp) if S is above half of `Step Error Limit`, if the
/// scheme damps more than a fifth of `Step Error Warning`, or if contact rests on walls too stiff
/// for the step. If S is above the limit and D within the warning, it is compared once more with
/// steps a quarter as long, because halves may miss what the steps miss. The step error is then the
/// largest of
///
///     D                       at most the limit if neighbours differ as much: chaotic motion
///     (max(r, 1/r) - 1)/2.5   at most 1, if V is above 0.8 and D above 0.4 times the warning
///     min(V/4, limit)         if V/4 is above the warning
///
/// Without a comparison it is min(S, limit). It is S if S is above 1, unless all of the motion is
/// compared and D is within half of the limit. If a later span is far harder for the steps
/// (BusiestSpan.hpp), its motion is compared too and the larger step error counts; if neighbours
/// differ as much there, the span gives no verdict. A limit of 1 or more is a limit of S alone.
///
/// \return the step error; 0 if it is unknown because no step resolves the contact. The run warns
/// above `Step Error Warning`, also if the scheme damps more of the vibration than that, and fails
/// above `Step Error Limit`. Throws ConvergenceError, and InterruptedError if a comparison was
/// stopped. Collective.
double judgeSteps(const Integrator& run, const StepError& error, const TransientOptions& options,
                  const Comparison& comparison);

}  // namespace tooljoint::transient
