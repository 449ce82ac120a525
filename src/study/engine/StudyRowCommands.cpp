// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A study as one command per row: the plan of the commands, and their implementation.
#include <cstddef>
#include <optional>
#include <string>

#include "cases/run/AnalysisFiles.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "study/engine/RowCommands.hpp"
#include "study/engine/Study.hpp"
#include "study/engine/StudyFiles.hpp"
#include "study/engine/StudyRows.hpp"

namespace tooljoint::study {

void plan(const cases::Case& one, const std::string& folder, const std::string& program,
          const StudyOptions& options) {
  const auto plan = planStudy(one);
  const auto command = rowCommand(one, {program, "study", folder, options.ranksPerRow,
                                        options.sharedTiming ? " --timing shared" : ""});
  std::string rows;
  std::size_t count = 0;
  for (std::size_t i = plan.referenceRuns(); i < plan.runs.size(); ++i)
    if (plan.runs[i].twin == i) rows += command + std::to_string(i + 1) + "\n", ++count;
  writePlan(folder, "reference.txt", command + "reference\n");
  writePlan(folder, "rows.txt", rows);
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
  if (wanted < plan.referenceRuns()) {
    rows.computeReference();
    return rows.computeCompanions();
  }
  rows.takeReference();
  while (!rows.isComplete(wanted)) rows.run(wanted, "");
  const auto& found = rows.result().rows[wanted];
  log::info("row         " + plan.runs[wanted].plan.label + ": " + found.status +
            (found.reason.empty() ? "" : ", " + found.reason));
}

}  // namespace tooljoint::study
