// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Detects reduced runs whose errors are due not to their bases but to a common cause: the time
/// step.
#pragma once

#include <string>
#include <vector>

#include "study/Row.hpp"

namespace tooljoint::study {

/// One sentence for each group of runs with the same list `Transient` in which two or more reduced
/// runs all have the error of the full run: the step limits them, not the basis. Without a full
/// run, three or more reduced runs of different sizes must have similar errors. Errors close to
/// that of the reference itself prove nothing. \param transient  of each row, a text that is the
/// same for the same list
std::vector<std::string> stepLimits(const std::vector<StudyRow>& rows,
                                    const std::vector<std::string>& transient);

}  // namespace tooljoint::study
