// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The folder a run leaves its files in. During the run every file is called NAME.part; only a run
/// that ended well gives them their names, so a finished result is never overwritten by a failed
/// run.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::io {

inline constexpr const char* summaryName = "summary.json";
inline constexpr const char* resultsName = "results.h5";
/// The state an interrupted run goes on from.
inline constexpr const char* checkpointName = "checkpoint.bin";
/// The samples before that state, from the start of the run that goes on until its own file holds
/// them.
inline constexpr const char* checkpointSamplesName = "checkpoint.h5";

/// What happens to the checkpoint of an interrupted run that the folder holds.
enum class OldCheckpoint {
  SetAside,  ///< it moves with its samples and tables into a folder of its own, "interrupted", and
             ///< a warning says so
  GoOn,      ///< this run goes on from it
};

/// Rank 0 does all the work, the other ranks only know the names (wrap calls in parallel::agree to
/// end alike).
class OutputFolder {
 public:
  /// Make the folder if need be, lock it against a second run, and prove that a file can be written
  /// there: call before anything is computed. FileError with the system's reason.
  explicit OutputFolder(const std::string& folder, OldCheckpoint old = OldCheckpoint::SetAside);
  ~OutputFolder();
  OutputFolder(const OutputFolder&) = delete;
  OutputFolder& operator=(const OutputFolder&) = delete;

  const std::string& folder() const { return folder_; }
  /// True when a run that ended with status "finished" left its results here.
  bool hasFinishedResults() const { return finished_; }

  /// FileError when the file system has less room than `bytes`: a full disk is better found before
  /// a long run.
  void requireSpace(double bytes) const;

  /// Path for a file of this run ("results.h5" -> "DIR/results.h5"), to be handed to a writer that
  /// stages it as .part. A .part of that name left by an earlier run is removed.
  std::string file(const std::string& name);
  /// Names given to file(), sorted, without .part: the summary lists them.
  std::vector<std::string> files() const;

  /// The run ended well: give every staged file its name, summary.json last. Files of the run
  /// before that this one did not write are removed; where it wrote none of them but summary.json,
  /// they are those of another command and move into a folder of their own, "earlier".
  void publish();

  /// The run failed or was interrupted. Without finished results here, the files get their names
  /// (their summary says what happened); with them, they stay NAME.part beside the old results.
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
