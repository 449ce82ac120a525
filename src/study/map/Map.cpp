// SPDX-License-Identifier: BSD-3-Clause
#include "study/map/Map.hpp"

#include <algorithm>
#include <fmt/format.h>
#include <optional>
#include <set>
#include <vector>

#include "cases/run/AnalysisFiles.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/Text.hpp"
#include "common/Version.hpp"
#include "common/ranks/RankGroups.hpp"
#include "common/report/Log.hpp"
#include "common/report/WarnOnce.hpp"
#include "deck/PrintedUnits.hpp"
#include "io/summary/SummaryUnits.hpp"
#include "study/engine/RowCommands.hpp"
#include "study/engine/RunDecks.hpp"
#include "study/engine/StudyProgress.hpp"
#include "study/map/MapFiles.hpp"
#include "study/map/MapRows.hpp"

namespace tooljoint::study {

namespace {

/// Largest number of missing points named in a warning; the others are counted.
constexpr std::size_t mostNamed = 10;

/// One map in one folder.
class Map {
 public:
  Map(const cases::Case& scene, const MapOptions& options)
      : scene_(scene),
        plan_(planMap(scene)),
        groups_(options.ranksPerRow),
        files_(scene, options.output, "map") {
    if (options.fresh) parallel::agree([&] { RowStore(folder()).clear(); });
  }

  /// \param computes  false: only makes the tables of the stored points
  void go(bool computes) {
    announce();
    files_.complete(
        [&] {
          {
            const log::WarnOnce once;  // of points that differ only in numbers
            if (computes) computeAll();
            rows_.emplace(plan_, folder());
            repeatWarnings();
          }
          report();
        },
        [&](io::ResultsFile& file) {
          stageMapTable(plan_, rows_->rows(), files_.folder());
          writeMap(plan_, rows_->rows(), file);
          summarise(plan_, rows_->rows(), files_.summary());
        });
    if (plan_.settings.pictures) parallel::agree([&] { drawMap(folder()); });
    refuseIfAllFailed();
  }

 private:
  const std::string& folder() { return files_.folder().folder(); }

  void announce() {
    log::info("Tooljoint " + programVersion() + ": map of " + scene_.deck().name());
    for (const auto& remark : scene_.remarks()) log::warn(remark);
    log::info("map         " + describe(plan_));
  }

  void computeAll() {
    try {
      // all groups read the folder before any of them adds to it, so that all have the same jobs
      groups_.apart([&] { rows_.emplace(plan_, folder()); });
      if (const auto known = rows_->completed(); known > 0)
        log::info("            " + std::to_string(known) + " of " +
                  std::to_string(plan_.points.size()) +
                  " points are known from before (--fresh forgets them)");
      groups_.apart([&] { deal(); });
    } catch (const InterruptedError&) {
      rows_.emplace(plan_, folder());
      stageTable();
      throw InterruptedError("Interrupted with " + std::to_string(rows_->completed()) + " of " +
                             std::to_string(plan_.points.size()) +
                             " points done. They are kept in " + folder() +
                             "; the same command goes on from there.");
    }
  }

  /// Each group takes the next point when it is free.
  void deal() {
    std::vector<std::size_t> jobs;
    for (std::size_t i = 0; i < plan_.points.size(); ++i)
      if (!rows_->isComplete(i)) jobs.push_back(i);
    double spent = 0.0, computed = 0.0;
    for (int n = groups_.next(); n >= 0 && n < static_cast<int>(jobs.size()); n = groups_.next()) {
      const auto i = jobs[static_cast<std::size_t>(n)];
      rows_->compute(i);
      mine_.insert(i);
      const auto& row = rows_->rows()[i];
      spent += row.wall;
      computed += 1.0;
      // the groups work at the same time
      const double left = static_cast<double>(jobs.size() - static_cast<std::size_t>(n) - 1) *
                          spent / computed / groups_.count();
      log::info("point " + std::to_string(i + 1) + " of " + std::to_string(plan_.points.size()) +
                "  " + plan_.points[i].plan.label + ": " + told(row) +
                (left > 0.0 ? "; about " + duration(left) + " left" : ""));
      if (groups_.count() == 1) stageTable();
    }
  }

  std::string told(const MapRow& row) const {
    if (row.status == "failed") return "failed: " + row.reason;
    std::string text;
    for (const auto& value : plan_.settings.values)
      if (const auto number = row.number(value.key)) {
        const deck::PrintedUnit unit(io::unitOfKey(value.key));
        text += fmt::format("{} {:.4g}{}{}, ", value.name, unit(*number),
                            unit.name().empty() ? "" : " ", unit.name());
      }
    return text + fmt::format("{:.3g} s", row.wall);
  }

  void stageTable() {
    parallel::agree([&] { stageMapTable(plan_, rows_->rows(), files_.folder()); });
  }

  /// Repeats the warnings of stored points and of points of other groups. Rank 0 has the rows.
  void repeatWarnings() {
    if (parallel::rank() != 0) return;
    for (std::size_t i = 0; i < rows_->rows().size(); ++i)
      if (mine_.count(i) == 0)
        for (const auto& warning : rows_->rows()[i].warnings) log::warn(warning);
  }

  /// Rank 0 has the rows.
  void report() {
    if (parallel::rank() != 0) return;
    log::info(describe(plan_, rows_->rows()));
    const auto missing = missingPoints(plan_, rows_->rows());
    for (std::size_t i = 0; i < std::min(missing.size(), mostNamed); ++i) log::warn(missing[i]);
    if (missing.size() > mostNamed)
      log::warn(std::to_string(missing.size() - mostNamed) +
                " further cells are missing; map.csv has their reasons.");
    if (const auto text = unsettledPoints(plan_, rows_->rows()); !text.empty()) log::warn(text);
  }

  /// Rank 0 has the rows.
  void refuseIfAllFailed() {
    parallel::agree([&] {
      if (parallel::rank() != 0) return;
      const auto& rows = rows_->rows();
      const auto failed = std::find_if(rows.begin(), rows.end(),
                                       [](const MapRow& row) { return row.status == "failed"; });
      if (failed == rows.end() || std::any_of(rows.begin(), rows.end(), [](const MapRow& row) {
            return row.status == "done";
          }))
        return;
      throw ConvergenceError(
          "No point of the map could be computed; map.csv has the reasons. The first, " +
          plan_.points[static_cast<std::size_t>(failed - rows.begin())].plan.label + ": " +
          failed->reason);
    });
  }

  const cases::Case& scene_;
  MapPlan plan_;
  parallel::RankGroups groups_;
  cases::AnalysisFiles files_;
  std::optional<MapRows> rows_;
  std::set<std::size_t> mine_;  ///< points that the group of this rank has computed
};

}  // namespace

void runMap(const cases::Case& one, const MapOptions& options) { Map(one, options).go(true); }

void collectMap(const cases::Case& one, const MapOptions& options) {
  auto alone = options;
  alone.ranksPerRow = 0;
  Map(one, alone).go(false);
}

void planMapRows(const cases::Case& one, const std::string& folder, const std::string& program,
                 const MapOptions& options) {
  const auto plan = planMap(one);
  const auto command = rowCommand(one, {program, "map", folder, options.ranksPerRow, ""});
  std::string rows;
  for (std::size_t i = 0; i < plan.points.size(); ++i)
    rows += command + std::to_string(i + 1) + "\n";
  writePlan(folder, "rows.txt", rows);
  log::info("plan        " + folder + "/rows.txt has " + std::to_string(plan.points.size()) +
            " commands that may run in any order, each in a process of its own");
  log::info("            tooljoint map " + one.deck().file() + " --collect " + folder +
            " makes the table and the pictures of what is there");
}

void computeMapRow(const cases::Case& one, const std::string& row, const MapOptions& options) {
  const auto plan = planMap(one, row);
  const auto wanted = rowNumber(row, plan.points.size(), "map");
  MapRows rows(plan, cases::analysisFolder(one, options.output, "map"));
  if (!rows.isComplete(wanted)) rows.compute(wanted);
  if (parallel::rank() != 0) return;
  const auto& found = rows.rows()[wanted];
  log::info("point       " + plan.points[wanted].plan.label + ": " + found.status +
            (found.reason.empty() ? "" : ", " + found.reason));
}

}  // namespace tooljoint::study
