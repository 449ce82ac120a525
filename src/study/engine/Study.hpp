// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A study: many runs of one case compared with a reference run. In one process, in groups of ranks
/// that take rows as they become free, or as a plan of one command per row for a scheduler.
#pragma once

#include <string>

#include "cases/Case.hpp"

namespace tooljoint::study {

struct StudyOptions {
  std::string output;         ///< folder; empty: next to that of a run of the deck
  bool fresh = false;         ///< remove the runs of an earlier study from the folder
  int ranksPerRow = 0;        ///< ranks that compute a row together; 0: all
  bool sharedTiming = false;  ///< rows may be timed while others run on the same machine
};

/// Runs the list Study of the deck into a folder: study.csv, study.h5, summary.json and plots of
/// speed against error. Stored runs are not repeated. DeckError, ModelError, ConvergenceError (the
/// reference fails), FileError, InterruptedError; UsageError when rows would share a machine
/// without `sharedTiming`, or the number of ranks is not a multiple of the group size. Collective.
void run(const cases::Case& one, const StudyOptions& options);

/// Writes FOLDER/reference.txt, the command of the reference run, and FOLDER/rows.txt, one command
/// per line for every other run: these need the reference, but not each other. `program` is the
/// file that runs them. Collective.
void plan(const cases::Case& one, const std::string& folder, const std::string& program,
          const StudyOptions& options);

/// One run of the study with all its repeats into options.output: "reference", or its number in
/// study.h5. FileError if the reference is missing. Collective.
void computeRow(const cases::Case& one, const std::string& row, const StudyOptions& options);

/// Tables and plots of the runs in options.output, whichever process timed them; missing runs are
/// named. FileError if the reference is missing. Collective.
void collect(const cases::Case& one, const StudyOptions& options);

}  // namespace tooljoint::study
