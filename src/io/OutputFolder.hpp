// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The output folder of a run. During the run every file is called NAME.part; only a successful run
/// renames its files, so a failed run never overwrites a finished result.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::io {

inline constexpr const char* summaryName = "summary.json";
inline constexpr const char* resultsName = "results.h5";
/// The state from which an interrupted run continues.
inline constexpr const char* checkpointName = "checkpoint.bin";
/// The samples before that state; needed from the start of the continued run until its own file
/// contains them.
inline constexpr const char* checkpointSamplesName = "checkpoint.h5";

/// Treatment of the checkpoint of an interrupted run in the folder.
enum class OldCheckpoint {
  SetAside,  ///< it is moved with its samples and tables into a new subfolder, "interrupted", with
             ///< a warning
  GoOn,      ///< this run continues from it
};

/// Rank 0 does all the work; the other ranks only know the names (wrap calls in parallel::agree to
/// fail together).
class OutputFolder {
 public:
  /// Makes the folder if needed, locks it against a second run, and checks that a file can be
  /// written there: call before any computation. FileError with the reason of the system.
  explicit OutputFolder(const std::string& folder, OldCheckpoint old = OldCheckpoint::SetAside);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& folder() const { return folder_; }
  /// True if a run with status "finished" left its results here.
  bool hasFinishedResults() const { return finished_; }

  /// FileError if the file system has less space than `bytes`, to detect a full disk before a long
  /// run.
  void requireSpace(double bytes) const;

  /// Path for a file of this run ("results.h5" -> "DIR/results.h5"), for a writer that stages it as
  /// .part. Removes a .part with that name from an earlier run.
  std::string file(const std::string& name);
  /// Names given to file(), sorted, without .part: the summary lists them.
  std::vector<std::string> files() const;

  /// After a successful run: renames every staged file, summary.json last. Files of the previous
  /// run that this one did not write are removed. If this run wrote none of them except
  /// summary.json, they belong to another command and are moved into a new subfolder, "earlier".
  void publish();

  /// After a failure or an interrupt. Without finished results in the folder, the files are renamed
  /// (their summary describes the failure); otherwise they stay NAME.part next to the old results,
  /// and a summary without other files is removed.
  /// Returns true in the first case.
  bool publishUnfinished();

 private:
  void prove() const;
  void setAside();
  void setEarlierAside();
  void renameAll();

  std::string folder_;
  std::vector<std::string> names_;
  std::vector<std::string> previousFiles_;
  bool active_ = false;
  bool finished_ = false;
  int lock_ = -1;
};

}  // namespace tooljoint::io
