// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A reference fitted to the runs of a study, for decks that give none.
#pragma once

#include <string>
#include <vector>

#include "study/StudyParameters.hpp"

namespace tooljoint::study {

/// The steps of the reference are the shortest of the runs divided by this, those of its check half
/// as long: at second order its error is a sixteenth of that of the best run.
constexpr double referenceRefinement = 4.0;

/// RK4 at half its stability limit, as overrides.
std::vector<std::string> explicitReference();

/// Sets reference and check if the deck gives neither (both are empty).
/// \param shortest  step of the runs [s]; 0: all are explicit or choose their steps
void fitReference(StudySettings& settings, double shortest);

/// True if the steps of the reference were fitted to those of the runs.
bool hasFittedSteps(const StudySettings& settings);

/// "Generalized-alpha, steps of 0.25 ms, ...": a readable description of the reference run.
/// \param transient  list of its deck
std::string describeReference(const StudySettings& settings,
                              const Teuchos::ParameterList& transient);

}  // namespace tooljoint::study
