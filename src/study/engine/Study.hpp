// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A study: many runs of one case against a reference run. In one process, in groups of ranks that
/// take rows as they become free, or as a plan of one command per row for a scheduler.
#pragma once

#include <string>

#include "cases/Case.hpp"

namespace tooljoint::study {

struct StudyOptions {
  std::string output;         ///< folder; empty: beside that of a run of the deck
  bool fresh = false;         ///< forget the runs an earlier study left in the folder
  int ranksPerRow = 0;        ///< ranks that work on a row together; 0: all
  bool sharedTiming = false;  ///< rows may be timed while others run on the same machine
};

/// Runs the list Study of the deck into a folder: study.csv, study.h5, summary.json and plots of
/// speed against error. Runs known from before are not repeated. DeckError, ModelError,
/// ConvergenceError (the reference fails), FileError, InterruptedError; UsageError when rows would
/// share a machine without `sharedTiming`, or the ranks do not make whole groups. Collective.
void run(const cases::Case& one, const StudyOptions& options);

/// Writes FOLDER/reference.txt, the command of the reference run, and FOLDER/rows.txt, one command
/// a line for every other run: they need the reference, and nothing of each other. `program` is the
/// file that is to run them. Collective.
void plan(const cases::Case& one, const std::string& folder, const std::string& program,
          const StudyOptions& options);

/// One run of the study into options.output, all its repeats: "reference", or its number in
/// study.h5. FileError when the reference is not there. Collective.
void computeRow(const cases::Case& one, const std::string& row, const StudyOptions& options);

/// Tables and plots of the runs in options.output, wherever they were timed; missing ones are
/// named. FileError when the reference is not there. Collective.
void collect(const cases::Case& one, const StudyOptions& options);

}  // namespace tooljoint::study
