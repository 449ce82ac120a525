// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The files of one run: its folder, results.h5, summary.json, its checkpoint, and the files of an
/// interrupted run to continue from.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "cases/recording/Recorder.hpp"
#include "common/Error.hpp"
#include "common/report/Stopwatch.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::cases {

/// Folders of a run.
struct RunOptions {
  std::string output;   ///< of the results; empty: that of the restart, else of the deck, else
                        ///< results/NAME for NAME.xml
  std::string restart;  ///< folder of an interrupted run; empty: new run
};

/// A checkpoint and its samples form a pair with the identity of its run (RunIdentity.hpp). A pair
/// is replaced only by a later one of the same run: a continued run keeps the earlier samples as
/// checkpoint.h5 until its own file contains them.
class RunFiles {
 public:
  /// Opens the folder and, with --restart, reads and verifies the checkpoint before any
  /// computation. Collective. FileError, also when the disk has too little space for the results;
  /// DeckError when the checkpoint belongs to another run. The arguments must outlive the object.
  RunFiles(const RunOptions& options, const Case& one);

  io::OutputFolder& folder() { return *folder_; }
  io::ResultsFile& results() { return *results_; }
  io::Summary& summary() { return summary_; }
  bool goesOn() const { return checkpoint_.has_value(); }

  /// Runs the stages, then `tables`, and publishes. After an error the files remain readable, the
  /// summary describes the error, and it is rethrown. Collective.
  void complete(const std::function<void()>& stages, const std::function<void()>& tables);

  /// The motion, with checkpoints, from the start or from the checkpoint. `sink` receives the
  /// samples and passes them to `recorder`. \param hooks  of the reduction: `keep` and `resume` are
  /// set here
  transient::TransientReport integrate(const model::SecondOrderModel& model,
                                       const Teuchos::ParameterList& transient, Recorder& recorder,
                                       transient::SampleSink& sink, transient::RunHooks hooks);
  /// Throws InterruptedError with the restart command when the motion did not reach its end.
  void requireComplete(const transient::TransientReport& report) const;

 private:
  void readCheckpoint(const std::string& folderName);
  std::string findSamples() const;
  std::string whyNot(const std::string& file) const;
  std::string keepSamples(const std::string& samples) const;
  void keep(const transient::Checkpoint& checkpoint, const Recorder& recorder);
  void publish(const std::function<void()>& tables);
  void leave(const Error& error);
  void stamp(const std::string& status, const std::string& message);
  void removeCheckpoint() const;
  std::string at(const char* name) const;

  const RunOptions& options_;
  std::string deck_;  ///< file and overrides, as options of a command
  Stopwatch watch_;
  std::string identity_;
  bool samePlace_ = false;  ///< --restart names the output folder
  std::optional<transient::Checkpoint> checkpoint_;
  std::optional<io::OutputFolder> folder_;
  std::unique_ptr<io::ResultsFile> results_;
  io::Summary summary_;
  bool kept_ = false;  ///< this run has written a checkpoint
};

/// Approximate size of the results [bytes]: 8 per recorded number.
double expectedBytes(const Case& one);

}  // namespace tooljoint::cases
