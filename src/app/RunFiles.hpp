// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The files of one run, of a string or of imported parts: its folder, results.h5, summary.json,
/// its checkpoint, and what an interrupted run has left to go on from.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "app/Commands.hpp"
#include "app/Recorder.hpp"
#include "app/RunSupport.hpp"
#include "common/Error.hpp"
#include "deck/Deck.hpp"
#include "io/OutputFolder.hpp"
#include "io/OutputParameters.hpp"
#include "io/ResultsFile.hpp"
#include "io/Summary.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

/// A checkpoint and its samples form a pair that carries the identity of its run (RunIdentity.hpp).
/// A pair is replaced only by a later one of the same run: the run that goes on keeps the samples
/// of the other as checkpoint.h5 until its own file holds them.
class RunFiles {
 public:
  /// Opens the folder and, with --restart, reads and verifies the checkpoint before anything is
  /// computed. \param bytes what the results will take, about. Collective. FileError; DeckError
  /// when the checkpoint belongs to another run.
  RunFiles(const RunOptions& options, const deck::Deck& deck, const io::OutputSettings& output,
           double bytes);

  io::OutputFolder& folder() { return *folder_; }
  io::ResultsFile& results() { return *results_; }
  io::Summary& summary() { return summary_; }
  bool goesOn() const { return checkpoint_.has_value(); }

  /// Runs the stages, then `tables`, and publishes; an error leaves what is there readable, with a
  /// summary that says what happened, and is thrown on. Collective.
  void complete(const std::function<void()>& stages, const std::function<void()>& tables);

  /// The motion, with checkpoints, from the start or from the checkpoint. `sink` receives the
  /// samples and hands them to `recorder`.
  transient::TransientReport integrate(const model::SecondOrderModel& model,
                                       const Teuchos::ParameterList& transient, Recorder& recorder,
                                       transient::SampleSink& sink);
  /// Throws InterruptedError, which says how to go on, when the motion did not reach its end.
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
  Clock::time_point start_ = Clock::now();
  std::string identity_;
  bool samePlace_ = false;  ///< --restart names the output folder
  std::optional<transient::Checkpoint> checkpoint_;
  std::optional<io::OutputFolder> folder_;
  std::unique_ptr<io::ResultsFile> results_;
  io::Summary summary_;
  bool kept_ = false;  ///< this run has written a checkpoint
};

/// Rough size of results: 8 bytes for every number recorded. `width` numbers describe the motion of
/// a node.
double expectedBytes(const Teuchos::ParameterList& deck, const io::OutputSettings& output,
                     std::size_t nodes, std::size_t width);

}  // namespace tooljoint::app
