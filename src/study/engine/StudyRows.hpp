// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The rows of a study: read from its folder, computed, timed, and stored there. A later study,
/// another group of ranks or another process continues from the stored rows.
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

/// Conditions under which rows are timed.
struct Timing {
  int ranks = 1;              ///< that compute a row together
  std::optional<int> beside;  ///< rows running on the same machine at the same time; none: not
                              ///< known
  bool anyMachine = false;    ///< also accept rows of other machines and conditions
};

/// All calls are collective.
class StudyRows {
 public:
  /// Reads the stored rows of the folder.
  StudyRows(const StudyPlan& plan, const std::string& folder, const Timing& timing);

  StudyResult& result() { return result_; }
  /// Completed repeats of each run, -1 for a failed run; the same on every rank.
  const std::vector<int>& timed() const { return timed_; }
  bool isComplete(std::size_t i) const;
  std::size_t completed() const;
  /// True unless an earlier run has the same deck.
  bool isFirst(std::size_t i) const { return plan_.runs[i].twin == i; }

  /// Computes the reference if it is not stored. ConvergenceError if it fails, since nothing can
  /// then be compared.
  void computeReference();
  /// Computes the check of the reference and the perturbed run if they are not stored.
  void computeCompanions();
  /// Reads the reference that another process has computed. FileError if it is missing.
  void takeReference();
  /// One more repeat of a run. A failure is stored in its row. `title` is that of the progress bar.
  void run(std::size_t i, const std::string& title);
  /// Copies rows to runs with the same deck as an earlier one.
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
  std::optional<RecordedHistory> history_;  ///< of a stored reference, rank 0
  StudyRunner runner_;
  StudyComparison comparison_;
};

}  // namespace tooljoint::study
