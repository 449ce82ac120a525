// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/RunFiles.hpp"

#include <cmath>
#include <filesystem>
#include <fmt/format.h>
#include <sys/resource.h>
#include <utility>
#include <vector>

#include "cases/recording/RecordedNodes.hpp"
#include "cases/run/DeckCommand.hpp"
#include "cases/run/ResultsWriter.hpp"
#include "cases/run/RunIdentity.hpp"
#include "common/Parallel.hpp"
#include "common/Sha256.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/report/Log.hpp"
#include "io/ResultsReader.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::cases {

namespace {

namespace fs = std::filesystem;

/// Attribute of a results file: SHA-256 of runIdentity().
constexpr const char* identityAttribute = "run_sha256";

/// Runs work on rank 0; an error is thrown on all ranks.
template <class Work>
void onFirstRank(const Work& work) {
  parallel::agree([&] {
    if (parallel::rank() == 0) work();
  });
}

/// Largest resident memory so far, sum of the ranks [MB].
double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return parallel::sum(static_cast<double>(usage.ru_maxrss) / 1024.0);
}

/// Folder of the command line, otherwise of the continued run, otherwise of the deck's list
/// "Output", otherwise results/<deck>.
std::string resultsFolder(const RunOptions& options, const Case& one) {
  if (!options.output.empty()) return options.output;
  if (!options.restart.empty()) return options.restart;
  if (!one.output().folder.empty()) return one.output().folder;
  return (fs::path("results") / fs::path(one.deck().file()).stem()).string();
}

}  // namespace

double expectedBytes(const Case& one) {
  constexpr double beside = 1e6;  // model, static state, summary
  if (!one.moves()) return beside;
  const auto& list = one.transient();
  const double samples = (list.get<double>("End Time") - list.get<double>("Start Time")) /
                         list.get<double>("Sampling Interval");
  const double numbers = static_cast<double>(recordedCount(one)) * one.components() *
                         static_cast<double>(one.output().fields.size());
  return beside + 8.0 * samples * numbers;
}

RunFiles::RunFiles(const RunOptions& options, const Case& one)
    : options_(options),
      deck_(inShellQuotes(one.deck().file()) + overrideSwitches(one.deck())),
      identity_(runIdentity(one.deck())) {
  const auto folderName = resultsFolder(options, one);
  onFirstRank([&] {
    if (options_.restart.empty()) return;
    if (!fs::exists(fs::path(options_.restart) / io::checkpointName))
      throw FileError(
          "\"" + options_.restart + "\" holds no " + io::checkpointName +
          ". --restart needs the folder of an interrupted run" +
          (fs::exists(fs::path(options_.restart) / "interrupted")
               ? "; an earlier one is in " + (fs::path(options_.restart) / "interrupted").string()
               : "") +
          ".");
    std::error_code different;
    samePlace_ = fs::equivalent(options_.restart, folderName, different);
  });
  parallel::agree([&] {
    folder_.emplace(folderName, samePlace_ ? io::OldCheckpoint::GoOn : io::OldCheckpoint::SetAside);
  });
  if (!options_.restart.empty()) readCheckpoint(folderName);
  parallel::agree([&] {
    folder_->requireSpace(expectedBytes(one));
    const std::string samples = goesOn() && parallel::rank() == 0 ? keepSamples(findSamples()) : "";
    results_ =
        std::make_unique<io::ResultsFile>(folder_->file(io::resultsName), provenance(one.deck()),
                                          io::ResultsOptions{one.output().compression});
    results_->attribute("/", identityAttribute, sha256(identity_));
    if (goesOn()) results_->continueFrom(samples, checkpoint_->rows);
  });
}

std::string RunFiles::at(const char* name) const {
  return (fs::path(folder_->folder()) / name).string();
}

/// All ranks get the bytes read by rank 0.
void RunFiles::readCheckpoint(const std::string& folderName) {
  const auto file = (fs::path(options_.restart) / io::checkpointName).string();
  std::string bytes;
  onFirstRank([&] { bytes = io::readText(file); });
  parallel::broadcast(bytes);
  parallel::agree([&] { checkpoint_ = transient::Checkpoint::decode(bytes, file); });
  if (checkpoint_->run != identity_)
    throw DeckError("The checkpoint in " + options_.restart +
                    " does not belong to the run of this deck: " +
                    identityDifferences(checkpoint_->run, identity_) +
                    ". Use the deck, --set and --without of the interrupted run.");
  const auto program = programVersion() + " " + gitHash();
  if (checkpoint_->program != program)
    log::warn("The checkpoint was written by program version " + checkpoint_->program +
              "; this is version " + program +
              ". Results may differ from those of an uninterrupted run.");
  log::info("restart     from t = " + formatNumber(checkpoint_->state.t) + " s of " +
            options_.restart + (folderName == options_.restart ? "" : " into " + folderName));
}

/// Reason why a results file does not hold the samples of the checkpoint; empty if it does.
std::string RunFiles::whyNot(const std::string& file) const {
  if (!fs::exists(file)) return file + " is not there";
  try {
    const io::ResultsReader reader(file);
    if (!reader.hasAttribute("/", identityAttribute) ||
        reader.textAttribute("/", identityAttribute) != sha256(identity_))
      return file + " belongs to another run";
    for (const auto& [path, rows] : checkpoint_->rows) {
      const auto shape = reader.has(path) ? reader.shape(path) : std::vector<std::size_t>();
      if (shape.empty() || shape[0] < rows)
        return file + " holds fewer rows of " + path + " than the checkpoint needs";
    }
    return "";
  } catch (const FileError& error) {
    return error.what();
  }
}

std::string RunFiles::findSamples() const {
  std::vector<std::string> reasons;
  for (const std::string& name :
       {std::string(io::resultsName) + ".part", std::string(io::resultsName),
        std::string(io::checkpointSamplesName)}) {
    auto file = (fs::path(options_.restart) / name).string();
    reasons.push_back(whyNot(file));
    if (reasons.back().empty()) return file;
  }
  throw FileError("\"" + options_.restart +
                  "\" holds a checkpoint, but not the samples before it: " + join(reasons, "; ") +
                  ". Restore them from a copy, or run the deck from the start.");
}

/// Renames samples in the output folder to a name that no run writes; returns it. Finished results
/// of a run with the same identity remain.
std::string RunFiles::keepSamples(const std::string& samples) const {
  const bool finished =
      fs::path(samples).filename() == io::resultsName && folder_->hasFinishedResults();
  if (!samePlace_ || finished || fs::path(samples).filename() == io::checkpointSamplesName)
    return samples;
  auto kept = at(io::checkpointSamplesName);
  std::error_code error;
  fs::rename(samples, kept, error);
  if (error)
    throw FileError("The samples before the checkpoint, " + samples + ", cannot be renamed to " +
                    kept + ": " + error.message() + ".");
  return kept;
}

/// Writes the samples first, so that a checkpoint on disk always has them.
void RunFiles::keep(const transient::Checkpoint& checkpoint, const Recorder& recorder) {
  results_->flush();
  if (parallel::rank() != 0) return;
  transient::Checkpoint whole = checkpoint;
  whole.run = identity_;
  recorder.save(whole.recorder);
  whole.rows = results_->rows();
  whole.write(at(io::checkpointName));
  std::error_code ignored;
  fs::remove(at(io::checkpointSamplesName), ignored);
  kept_ = true;
}

transient::TransientReport RunFiles::integrate(const model::SecondOrderModel& model,
                                               const Teuchos::ParameterList& transient,
                                               Recorder& recorder, transient::SampleSink& sink,
                                               transient::RunHooks hooks) {
  if (goesOn()) {
    hooks.resume = &*checkpoint_;
    const double* memory = checkpoint_->recorder.data();
    recorder.restore(memory);
  }
  hooks.keep = [&](const transient::Checkpoint& checkpoint) { keep(checkpoint, recorder); };
  return transient::integrate(model, transient, sink, hooks);
}

void RunFiles::requireComplete(const transient::TransientReport& report) const {
  if (!report.interrupted) return;
  throw InterruptedError(fmt::format(
      "Interrupted at {:g} s. The results so far are in {}; continue with: tooljoint run {} "
      "--restart {}",
      report.end, folder_->folder(), deck_, inShellQuotes(folder_->folder())));
}

void RunFiles::complete(const std::function<void()>& stages, const std::function<void()>& tables) {
  try {
    stages();
    publish(tables);
  } catch (const Error& error) {
    leave(error);
    throw;
  }
}

void RunFiles::publish(const std::function<void()>& tables) {
  stamp("finished", "");
  parallel::agree([&] {
    tables();
    results_->finish();
    summary_.set("files", folder_->files());
    summary_.stage(folder_->file(io::summaryName));
    folder_->publish();
    removeCheckpoint();
  });
  log::info("results     " + folder_->folder() + ": " + join(folder_->files(), ", "));
}

/// A run that does not converge leaves no checkpoint: a restart from it would fail again.
void RunFiles::leave(const Error& error) {
  parallel::meetFailing(error.code(), error.what());
  stamp(error.code() == ExitCode::Interrupted ? "interrupted" : "failed", error.what());
  try {
    results_->close();
    summary_.set("files", folder_->files());
    summary_.stage(folder_->file(io::summaryName));
    folder_->publishUnfinished();
    if (kept_ && error.code() == ExitCode::NotConverged) removeCheckpoint();
  } catch (const Error& second) {
    log::warn(std::string("The results so far could not be kept: ") + second.what());
  }
}

void RunFiles::stamp(const std::string& status, const std::string& message) {
  summary_.set("status", status);
  if (!message.empty()) summary_.set("message", message);
  summary_.set("wall_s", watch_.wall());
  summary_.set("peak_memory_mb", peakMemory());
  summary_.set("warnings", log::warnings());
}

void RunFiles::removeCheckpoint() const {
  if (parallel::rank() != 0) return;
  std::error_code ignored;
  for (const char* name : {io::checkpointName, io::checkpointSamplesName})
    fs::remove(at(name), ignored);
}

}  // namespace tooljoint::cases
