// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/Command.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "common/report/PythonScript.hpp"

namespace tooljoint::app {

namespace {

constexpr const char* kScript = "report";
constexpr const char* kSwitch = "TOOLJOINT_REPORT";

bool switchedOff() {
  const char* value = std::getenv(kSwitch);
  return value != nullptr && std::string(value) == "off";
}

std::string without(const std::string& endings, std::string text) {
  text.erase(text.find_last_not_of(endings) + 1);
  return text;
}

Action prepareReport(CLI::App& line) {
  struct Options {
    std::string folder;
    std::string output;
    bool quiet = false;
  };
  auto options = std::make_shared<Options>();
  line.add_option("DIR", options->folder,
                  "folder of run, study or map, or the --output of torque-drag, bha, buckling, "
                  "campbell, response or modes")
      ->type_name("DIR")
      ->required();
  line.add_option("--output,-o", options->output, "file to write (default: DIR/report.html)")
      ->type_name("FILE");
  line.add_flag("--quiet,-q", options->quiet, "print warnings and errors only");
  return [options] {
    log::setQuiet(options->quiet);
    std::vector<std::string> arguments{options->folder};
    if (!options->output.empty()) arguments.insert(arguments.end(), {"--output", options->output});
    runScript(kScript, "The report was not written", arguments);
  };
}

const bool reportRegistered = addCommand(
    {Group::Results, "report",
     "one HTML file with figures, plots and a 3-D view of a results folder", prepareReport});

}  // namespace

void reportAtEnd(const std::string& folder, bool wanted) {
  if (parallel::rank() != 0) return;
  std::error_code ignored;
  const auto page = std::filesystem::path(folder) / "report.html";
  // the page of an earlier run shows results that no longer exist
  std::filesystem::remove(page, ignored);
  if (!wanted || switchedOff()) return;
  const PythonScript script(kScript);
  std::vector<std::string> arguments{folder};
  if (log::quiet()) arguments.emplace_back("--quiet");
  const auto end = script.run(arguments);
  const auto said = without(".\n", end.errors);
  // a report is valid without the damaged files
  if (!end.started || (end.code != 0 && !std::filesystem::exists(page, ignored)))
    log::warn("The report was not written: " + said + ". Write it later with: tooljoint report " +
              folder);
  else if (!said.empty())
    log::warn(said);
}

}  // namespace tooljoint::app
