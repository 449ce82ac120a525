// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A study: many runs of one case against a reference run.
#pragma once

#include <string>

#include "cases/Case.hpp"

namespace tooljoint::study {

struct StudyOptions {
  std::string output;  ///< folder; empty: beside that of a run of the deck
  bool fresh = false;  ///< forget the runs an earlier study left in the folder
};

/// Runs the list Study of the deck into a folder: study.csv, study.h5, summary.json and plots of
/// speed against error. Runs known from before are not repeated. DeckError, ModelError,
/// ConvergenceError (the reference fails), FileError, InterruptedError. Collective.
void run(const cases::Case& one, const StudyOptions& options);

}  // namespace tooljoint::study
