// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rows of a study: storing and reading back, ratios, tables.
#include "study/Row.hpp"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>

#include "cases/ListText.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "study/RowStore.hpp"

namespace RowTest {

using namespace tooljoint;

study::StudyRow row(const std::string& line, bool reduced, double vibration, double cpu) {
  study::StudyRow r;
  r.plan.line = line;
  r.plan.label = line + ", " + formatNumber(vibration);
  r.plan.reduced = reduced;
  r.status = "done";
  r.simulated = 2.0;
  r.cpu = {1.5 * cpu, cpu};
  r.wall = {cpu, 2.0 * cpu};
  r.errors = study::PointwiseErrors{0.1 * vibration, 0.05 * vibration, 0.2 * vibration, vibration};
  return r;
}

TEST(StudyRow, TimesAreTheShortestOfTheRepeats) {
  const auto r = row("a", false, 0.1, 4.0);
  EXPECT_EQ(r.bestCpu(), 4.0);
  EXPECT_EQ(r.cpuPerSimulatedSecond(), 2.0);
  EXPECT_EQ(r.spread(), 0.5);
  EXPECT_EQ(r.realTimeFactor(), 0.5);
  EXPECT_EQ(study::StudyRow().spread(), 0.0);
}

TEST(StudyRow, ComesBackFromItsText) {
  auto r = row("a", true, 0.1, 1.0 / 3.0);
  r.basis = "Craig-Bampton";
  r.counters.steps = 12345678901L;
  r.energyResidual = 1e-17;
  r.statistics = study::StatisticsDifference{1.0, 2.0, 3.0, 4.0, 5.0};
  r.curves.errorOverTime = {0.1, 1e-300};
  r.modeErrors = {{1.0, 2.0}, {1.1, 1.9}, {0.99, 0.5}, {0.1, -0.2}, {}, {1.0, 0.0}};
  r.curves.statistics.contactDuty = {0.0, 1.0 / 3.0};
  study::StudyRow back;
  back.fromJson(r.toJson());
  EXPECT_EQ(back.cpu, r.cpu);
  EXPECT_EQ(back.counters.steps, r.counters.steps);
  EXPECT_EQ(back.basis, r.basis);
  EXPECT_EQ(back.energyResidual, r.energyResidual);
  EXPECT_FALSE(back.stepOrTolerance);
  EXPECT_EQ(back.errors->vibration, r.errors->vibration);
  EXPECT_EQ(back.statistics->spectrum, 5.0);
  EXPECT_EQ(back.curves.errorOverTime, r.curves.errorOverTime);
  EXPECT_EQ(back.modeErrors.coupled, r.modeErrors.coupled);
  EXPECT_TRUE(back.modeErrors.estimate.empty());
  EXPECT_EQ(back.modeErrors.worst(), 0.2);
  EXPECT_EQ(back.modeErrors.leastMac(), 0.5);
  EXPECT_EQ(back.curves.statistics.contactDuty, r.curves.statistics.contactDuty);
  EXPECT_EQ(back.toJson(), [&] {
    auto same = r;
    same.plan = {};
    return same.toJson();
  }());
}

TEST(StudyRow, AHalfWrittenTextIsRefused) {
  const auto whole = row("a", true, 0.1, 1.0).toJson();
  study::StudyRow back;
  EXPECT_THROW(back.fromJson(whole.substr(0, whole.size() / 2)), FileError);
  EXPECT_THROW(back.fromJson("{}"), FileError);
}

TEST(Ratios, AgainstTheBaselineAndTheBestFullRun) {
  // full: cost 2 at 1e-1 and 20 at 1e-3, so 2 sqrt(10) at 1e-2; CPU per simulated second is half of
  // it
  std::vector<study::StudyRow> rows{row("full", false, 1e-1, 2.0), row("full", false, 1e-3, 20.0),
                                    row("reduced", true, 1e-2, 1.0),
                                    row("reduced", true, 1e-5, 1.0),
                                    row("slow", false, 1e-2, 100.0)};
  auto failed = row("full", false, 1e-3, 1.0);
  failed.status = "failed";
  rows.push_back(failed);
  const auto ratios = study::ratios(rows, rows[4].plan.label);
  EXPECT_NEAR(*ratios[2].baseline, 100.0, 1e-9);
  EXPECT_NEAR(*ratios[2].bestFull, 2.0 * std::sqrt(10.0), 1e-9);
  EXPECT_NEAR(*ratios[0].bestFull, 1.0, 1e-12);
  EXPECT_NEAR(*ratios[4].bestFull, 0.02 * std::sqrt(10.0), 1e-9);
  EXPECT_FALSE(ratios[3].bestFull);  // no full run is that accurate
  EXPECT_FALSE(ratios[5].bestFull);
  EXPECT_FALSE(ratios[5].baseline);
  EXPECT_FALSE(study::ratios(rows, "")[2].baseline);
}

TEST(StudyTable, EveryRowHasEveryColumnAndAFailureItsReason) {
  std::vector<study::StudyRow> rows{row("a", false, 0.1, 1.0), row("b", true, 0.1, 1.0)};
  rows[1].status = "failed";
  rows[1].reason = "it blew up, at once";
  const auto ratios = study::ratios(rows, "");
  const auto lines = split(study::table(rows, ratios), '\n');
  const auto header = split(lines[0], ',');
  EXPECT_EQ(split(lines[1], ',').size(),
            header.size() + 1);  // its label "a, 0.1" is quoted and holds one more
  EXPECT_NE(lines[2].find("\"it blew up, at once\""), std::string::npos);
  EXPECT_EQ(lines[2].find("0.05"), std::string::npos) << "no number of a failed run may be shown";
  EXPECT_NE(study::printedTable(rows, ratios).find("failed: it blew up"), std::string::npos);
}

TEST(StudyTable, AMotionThatFailsLeavesWhatWasKnownOfItsModel) {
  std::vector<study::StudyRow> rows{row("a", true, 0.1, 1.0)};
  rows[0].status = "failed";
  rows[0].dofs = 321;
  rows[0].modes = 17;
  rows[0].modeErrors = {{1.0}, {1.25}, {0.75}, {0.25}, {0.25}, {1.0}};
  const auto lines = split(study::table(rows, study::ratios(rows, "")), '\n');
  EXPECT_NE(lines[0].find("reduced_dofs,frequency_error,least_mac"), std::string::npos);
  EXPECT_NE(lines[1].find(",17,321,0.25,0.75,"), std::string::npos) << lines[1];
}

TEST(CanonicalText, DependsOnValuesAndNotOnTheirOrder) {
  Teuchos::ParameterList one, two;
  one.set("a", 0.1).set("b", 2);
  one.sublist("c").set("d", std::string("x"));
  two.sublist("c").set("d", std::string("x"));
  two.set("b", 2).set("a", 0.1);
  EXPECT_EQ(cases::canonicalText(one), cases::canonicalText(two));
  two.set("a", 0.1 + 1e-16);
  EXPECT_NE(cases::canonicalText(one), cases::canonicalText(two)) << "all digits count";
}

TEST(RowStore, GivesBackWhatItKeptUnderItsKey) {
  const std::string folder = "store";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder);
  const study::RowStore store(folder);
  const auto kept = row("a", true, 0.1, 1.0);
  store.keep("0123456789abcdef", kept);
  study::StudyRow found;
  found.plan.label = "new name";
  EXPECT_TRUE(store.restore("0123456789abcdef", found));
  EXPECT_EQ(found.cpu, kept.cpu);
  EXPECT_EQ(found.plan.label, "new name");
  EXPECT_FALSE(store.restore("fedcba9876543210", found));

  study::RecordedHistory history;
  history.nodes = 1;
  history.time = {0.0, 0.1};
  history.displacement = {1.0, 2.0, 3.0, 4.0, 5.0, 6.0};
  history.bitSpeed = {7.0, 8.0};
  store.keepHistory("0123", history);
  const auto back = store.restoreHistory("0123");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->displacement, history.displacement);
  EXPECT_EQ(back->nodes, 1u);

  for (const auto& entry : std::filesystem::directory_iterator(folder + "/cache"))
    std::ofstream(entry.path()) << "{";
  EXPECT_FALSE(store.restore("0123456789abcdef", found)) << "a damaged file counts as absent";
  EXPECT_FALSE(store.restoreHistory("0123"));
  store.clear();
  EXPECT_TRUE(std::filesystem::is_empty(folder + "/cache"));
}

}  // namespace RowTest
