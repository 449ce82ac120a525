// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Whether the errors of reduced runs are those of their bases, or of something that all have in
/// common: the time step.
#pragma once

#include <string>
#include <vector>

#include "study/Row.hpp"

namespace tooljoint::study {

/// One sentence for each group of runs with the same list `Transient` whose reduced runs, two or
/// more, all have the error of the full run beside them: the step limits them, not the basis.
/// Without a full run the sentence says so of three or more reduced runs of different sizes whose
/// errors are alike. Errors near that of the reference itself prove nothing.
/// \param transient  of each row, a text that is the same for the same list
std::vector<std::string> stepLimits(const std::vector<StudyRow>& rows,
                                    const std::vector<std::string>& transient);

}  // namespace tooljoint::study
