// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A study as one command per row: the plan of the commands, and what each of them does.
#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <system_error>

#include "cases/run/AnalysisFiles.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "io/TextFile.hpp"
#include "study/engine/Study.hpp"
#include "study/engine/StudyFiles.hpp"
#include "study/engine/StudyRows.hpp"

namespace tooljoint::study {

namespace {

/// In single quotes, as a shell reads it.
std::string quoted(const std::string& text) {
  std::string out = "'";
  for (char c : text) out += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return out + "'";
}

}  // namespace

void plan(const cases::Case& one, const std::string& folder, const std::string& program,
          const StudyOptions& options) {
  const auto plan = planStudy(one);
  const auto absolute = [](const std::string& path) {
    return quoted(std::filesystem::absolute(path).lexically_normal().string());
  };
  std::string command = quoted(program) + " study " + absolute(one.deck().file());
  if (options.ranksPerRow > 1)
    command = "mpiexec -n " + std::to_string(options.ranksPerRow) + " " + command;
  for (const auto& item : one.deck().overrides())
    command += item[0] == '!' ? " --without " + quoted(item.substr(1)) : " --set " + quoted(item);
  if (options.sharedTiming) command += " --timing shared";
  command += " --output " + absolute(folder) + " --row ";
  std::string rows;
  std::size_t count = 0;
  for (std::size_t i = plan.referenceRuns(); i < plan.runs.size(); ++i)
    if (plan.runs[i].twin == i) rows += command + std::to_string(i + 1) + "\n", ++count;
  parallel::agree([&] {
    if (parallel::rank() != 0) return;
    std::error_code error;
    std::filesystem::create_directories(folder, error);
    if (error)
      throw FileError("The folder " + folder + " cannot be made: " + error.message() + ".");
    io::writeText(folder + "/reference.txt", command + "reference\n");
    io::writeText(folder + "/rows.txt", rows);
  });
  log::info("plan        " + folder + "/reference.txt is the command to run first, " + folder +
            "/rows.txt has " + std::to_string(count) +
            " commands that may run in any order, each in a process of its own");
  log::info(
      "            tooljoint study " + one.deck().file() + " --collect " + folder +
      (options.ranksPerRow > 1 ? " --ranks-per-row " + std::to_string(options.ranksPerRow) : "") +
      " makes the tables of what is there");
}

void computeRow(const cases::Case& one, const std::string& row, const StudyOptions& options) {
  const auto plan = planStudy(one, row);
  const auto wanted = runNumber(plan, row);
  Timing timing{parallel::size(), std::nullopt, false};
  if (!options.sharedTiming) timing.beside = 0;
  StudyRows rows(plan, cases::analysisFolder(one, options.output, "study"), timing);
  if (wanted < plan.referenceRuns()) return rows.computeReference();
  rows.takeReference();
  while (!rows.isComplete(wanted)) rows.run(wanted, "");
  const auto& found = rows.result().rows[wanted];
  log::info("row         " + plan.runs[wanted].plan.label + ": " + found.status +
            (found.reason.empty() ? "" : ", " + found.reason));
}

}  // namespace tooljoint::study
