// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/Run.hpp"

#include "app/commands/Command.hpp"
#include "substructures/drillstring/analyses/TorqueDrag.hpp"
#include "texts/LastScreen.hpp"

namespace tooljoint::app {

namespace {

struct RunCommandOptions : DeckOptions {
  std::string restart;  ///< folder of an interrupted run; empty: start anew
};

void run(const RunCommandOptions& options) {
  const auto one = readCase(options);
  const auto* string = dynamic_cast<const drillstring::DrillstringCase*>(one.get());
  const bool dragged = string != nullptr && drillstring::torqueDragAfterRun(*string);
  const auto folder = cases::run(*one, {options.output, options.restart});
  if (dragged) drillstring::reportTorqueDrag(*string, folder, false, true);
  reportAtEnd(folder, one->output().report);
  texts::lastScreen(folder, one->deck());
}

Action prepareRun(CLI::App& line) {
  auto options = std::make_shared<RunCommandOptions>();
  addDeckOptions(line, *options, Output::Always);
  addVerbose(line, *options);
  line.add_option("--restart", options->restart, "folder of an interrupted run to go on from")
      ->type_name("DIR");
  return [options] { run(*options); };
}

const bool runRegistered =
    addCommand({Group::Runs, "run",
                "path, static state, reduction, transient: from deck to results", prepareRun});

}  // namespace

}  // namespace tooljoint::app
