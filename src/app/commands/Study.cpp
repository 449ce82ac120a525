// SPDX-License-Identifier: BSD-3-Clause
#include "study/engine/Study.hpp"

#include "app/commands/Command.hpp"

namespace tooljoint::app {

namespace {

struct StudyCommandOptions : RowOptions {
  std::string timing = "alone";  ///< or "shared"
};

void study(const StudyCommandOptions& options) {
  const auto one = readCase(options);
  study::StudyOptions own{options.output, options.fresh, options.ranksPerRow,
                          options.timing == "shared"};
  if (!options.plan.empty()) {
    study::plan(*one, options.plan, programPath(), own);
  } else if (!options.collect.empty()) {
    own.output = options.collect;
    study::collect(*one, own);
    endAnalysis("study", *one, own.output);
  } else if (!options.row.empty()) {
    study::computeRow(*one, options.row, own);
  } else {
    study::run(*one, own);
    endAnalysis("study", *one, own.output);
  }
}

Action prepareStudy(CLI::App& line) {
  auto options = std::make_shared<StudyCommandOptions>();
  addDeckOptions(line, *options, Output::Always, "_study");
  addVerbose(line, *options);
  addRowOptions(line, *options, "\"reference\", or its number (the commands of --plan)");
  line.add_option("--timing", options->timing,
                  "alone: refuse to time rows that share a machine; shared: time them all the same")
      ->check(CLI::IsMember({"alone", "shared"}));
  return [options] { app::study(*options); };
}

const bool studyRegistered =
    addCommand({Group::Runs, "study",
                "speed against error: the runs of the deck's Study list against its reference run",
                prepareStudy});

}  // namespace

}  // namespace tooljoint::app
