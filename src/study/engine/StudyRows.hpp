// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The rows of a study: found again in its folder, computed, timed, and kept there. What is kept is
/// what a later study, another group of ranks or another process goes on from.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/RowStore.hpp"
#include "study/engine/StudyComparison.hpp"
#include "study/engine/StudyFiles.hpp"
#include "study/engine/StudyPlan.hpp"
#include "study/engine/StudyRunner.hpp"

namespace tooljoint::study {

/// Under which circumstances rows are timed.
struct Timing {
  int ranks = 1;              ///< that work on a row together
  std::optional<int> beside;  ///< rows that run on the same machine meanwhile; none: not known
  bool anyMachine = false;    ///< rows of other machines and circumstances are taken too
};

/// All calls are collective.
class StudyRows {
 public:
  /// Finds what the folder knows.
  StudyRows(const StudyPlan& plan, const std::string& folder, const Timing& timing);

  StudyResult& result() { return result_; }
  /// Repeats done of each run, -1 for one that failed; the same on every rank.
  const std::vector<int>& timed() const { return timed_; }
  bool isComplete(std::size_t i) const;
  std::size_t completed() const;
  /// Not the same deck as an earlier run.
  bool isFirst(std::size_t i) const { return plan_.runs[i].twin == i; }

  /// Computes the reference where it is not known. ConvergenceError: it fails, so that there is
  /// nothing to compare with.
  void computeReference();
  /// The check of the reference and the perturbed run, where they are not known.
  void computeCompanions();
  /// Takes the reference another process has computed. FileError when it is not there.
  void takeReference();
  /// One more repeat of a run. What fails of it is its row. `title` is that of the progress bar.
  void run(std::size_t i, const std::string& title);
  /// Runs of the same deck as an earlier one get its row.
  void copyRepeatedRows();

 private:
  void makeKeys();
  void find();
  void moveReference();
  void sayCost(const PreparedModel& prepared);
  void setReference();
  void execute(std::size_t i, const std::string& title);
  void fail(std::size_t i, const std::string& reason, double givenUpAfter);
  void sign(StudyRow& row) const;
  bool usable(const StudyRow& row) const;
  int wantedRepeats(std::size_t i) const;

  const StudyPlan& plan_;
  Timing timing_;
  StudyResult result_;
  std::vector<int> timed_;
  std::vector<std::string> keys_;  ///< rank 0
  std::optional<RowStore> store_;
  std::optional<RecordedHistory> history_;  ///< of a reference known from before, rank 0
  StudyRunner runner_;
  StudyComparison comparison_;
};

}  // namespace tooljoint::study
