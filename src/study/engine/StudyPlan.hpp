// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A study before it runs: every run with its deck, read and checked.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "study/Expansion.hpp"
#include "study/StudyParameters.hpp"

namespace tooljoint::study {

/// One run and its case, made by its overrides of the deck.
struct StudyRun {
  PlannedRun plan;
  std::unique_ptr<cases::Case> scene;
  std::size_t twin = 0;  ///< the first run of a method with the same deck, usually itself: lines of
                         ///< the plots may cross
};

struct StudyPlan {
  StudySettings settings;
  double start = 0.0;      ///< of every run [s]
  double end = 0.0;        ///< [s]
  double windowEnd = 0.0;  ///< pointwise errors are evaluated from start to here [s]
  std::vector<StudyRun>
      runs;  ///< reference, check, sensitivity (unless switched off), then the methods

  double simulated() const { return end - start; }
  /// True if at least two samples lie beyond the window and the deck requests their statistics.
  bool hasStatistics() const;
  std::size_t referenceRuns() const;  ///< number of leading runs that belong to the reference
};

/// Reads the deck once for every run. DeckError that points into the Study list: overrides that do
/// not fit the deck, runs that cannot be compared (other nodes), a window beyond the end, a method
/// with two equal runs. ModelError: a run whose parts make no model.
/// \param row  if given, the only run to read besides the reference: "reference" (with its
///             companions), or its number in study.h5. UsageError if it does not exist. Other runs
///             then have no scene.
StudyPlan planStudy(const cases::Case& scene, const std::string& row = "");

/// Index of a run, as above; 0 for the reference.
std::size_t runNumber(const StudyPlan& plan, const std::string& row);

/// "12 runs of 4 methods, ...": a readable summary.
std::string describe(const StudyPlan& plan);

/// Data that determine the numbers of a run: the lists of its deck except Output, and the files
/// they name. On rank 0 only (reads those files).
std::string contentOf(const cases::Case& scene);

}  // namespace tooljoint::study
