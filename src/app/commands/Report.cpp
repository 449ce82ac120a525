// SPDX-License-Identifier: BSD-3-Clause
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "app/commands/Commands.hpp"
#include "app/commands/Scripts.hpp"
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

}  // namespace

void report(const std::string& folder, const std::string& output) {
  std::vector<std::string> arguments{folder};
  if (!output.empty()) arguments.insert(arguments.end(), {"--output", output});
  runScript(kScript, "The report was not written", arguments);
}

void reportAtEnd(const std::string& folder, bool wanted) {
  if (parallel::rank() != 0) return;
  std::error_code ignored;
  const auto page = std::filesystem::path(folder) / "report.html";
  // that of an earlier run shows results that are no longer here
  std::filesystem::remove(page, ignored);
  if (!wanted || switchedOff()) return;
  const PythonScript script(kScript);
  std::vector<std::string> arguments{folder};
  if (log::quiet()) arguments.emplace_back("--quiet");
  const auto end = script.run(arguments);
  const auto said = without(".\n", end.errors);
  // a report without the files that are damaged is one
  if (!end.started || (end.code != 0 && !std::filesystem::exists(page, ignored)))
    log::warn("The report was not written: " + said + ". Write it later with: tooljoint report " +
              folder);
  else if (!said.empty())
    log::warn(said);
}

}  // namespace tooljoint::app
