// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/AnalysisFiles.hpp"

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "cases/run/ResultsWriter.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "io/TextFile.hpp"

namespace tooljoint::cases {

std::string analysisFolder(const Case& one, const std::string& given, const std::string& analysis) {
  if (!given.empty()) return given;
  const auto& ofDeck = one.output().folder;
  if (!ofDeck.empty()) return ofDeck + "_" + analysis;
  const auto stem = std::filesystem::path(one.deck().file()).stem();
  return (std::filesystem::path("results") / stem).string() + "_" + analysis;
}

AnalysisFiles::AnalysisFiles(const Case& one, const std::string& given, const std::string& analysis,
                             Beside beside)
    : case_(one), name_(analysis) {
  parallel::agree([&] {
    folder_ = std::make_unique<io::OutputFolder>(analysisFolder(one, given, analysis));
    if (beside == Beside::Results && folder_->hasFinishedResults()) keepOthers();
  });
  one.summarise(summary_);
}

void AnalysisFiles::complete(const std::function<void()>& work,
                             const std::function<void(io::ResultsFile&)>& write) {
  try {
    work();
    stamp("finished", "");
    parallel::agree([&] {
      io::ResultsFile file(folder_->file(name_ + ".h5"), provenance(case_.deck()));
      write(file);
      file.flush();
      file.close();
      summary_.set("files", folder_->files());
      stageSummary();
      folder_->publish();
    });
  } catch (const Error& error) {
    leave(error);
    throw;
  }
  log::info("results     " + folder_->folder() + ": " + join(folder_->files(), ", "));
}

/// Registers the files of another command's results, so that they are not removed.
void AnalysisFiles::keepOthers() {
  const auto others = io::readPreviousRun(folder_->folder() + "/" + io::summaryName).files;
  beside_ = std::find(others.begin(), others.end(), name_ + ".h5") == others.end();
  if (!beside_) return;
  for (const auto& name : others) folder_->file(name);
}

void AnalysisFiles::stageSummary() {
  const auto path = folder_->file(io::summaryName);
  if (!beside_) return summary_.stage(path);
  using Json = nlohmann::ordered_json;
  Json theirs = Json::parse(io::readText(path), nullptr, false);
  if (!theirs.is_object())
    throw FileError(path + " is no summary of a run. Name another folder with --output.");
  const Json ours = Json::parse(summary_.text());
  for (const auto* key : {name_.c_str(), "files"}) theirs[key] = ours.at(key);
  io::stageText(path, theirs.dump(2) + "\n");
}

void AnalysisFiles::stamp(const std::string& status, const std::string& message) {
  summary_.set("status", status);
  if (!message.empty()) summary_.set("message", message);
  summary_.set("wall_s", watch_.wall());
  summary_.set("warnings", log::warnings());
}

void AnalysisFiles::leave(const Error& error) {
  parallel::meetFailing(error.code(), error.what());
  stamp(error.code() == ExitCode::Interrupted ? "interrupted" : "failed", error.what());
  try {
    if (!beside_) summary_.stage(folder_->file(io::summaryName));
    folder_->publishUnfinished();
  } catch (const Error& second) {
    log::warn(std::string("The summary could not be written: ") + second.what());
  }
}

}  // namespace tooljoint::cases
