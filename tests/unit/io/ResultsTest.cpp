// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// results.h5, summary.json and the output folder: round trips, units on every dataset, refusals, nothing half-written under its name.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "io/Csv.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/ResultsReader.hpp"
#include "io/Summary.hpp"
#include "io/TextFile.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace {

using namespace tooljoint;
namespace fs = std::filesystem;

/// A folder of its own for each test.
class Io : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return scratch_ / name; }

  const test::Scratch scratch_;
  const io::Provenance provenance_{"deck.xml", "<ParameterList name=\"x\"/>", "abc", {"Loads/Gravity=1"}};
};

TEST_F(Io, DatasetsComeBackWithUnitsAndNames) {
  {
    io::ResultsFile file(at("results.h5"), provenance_);
    file.write("/model/s", std::vector<double>{0.0, 1.5, 4.0}, {3}, "m", "Depth");
    file.write("/model/nodes", std::vector<int>{1, 2}, {2}, "1", "Numbers");
    auto& series = file.series("/transient/displacement", {2, 3}, "m", "Motion");
    for (int i = 0; i < 5; ++i) {
      const std::vector<double> row(6, 0.25 * i);
      series.append(row.data());
    }
    EXPECT_FALSE(fs::exists(at("results.h5"))) << "an unfinished file stands under its final name";
    file.finish();
  }
  const io::ResultsReader reader(at("results.h5"));
  EXPECT_EQ(reader.numbers("/model/s"), (std::vector<double>{0.0, 1.5, 4.0}));
  EXPECT_EQ(reader.unit("/model/s"), "m");
  EXPECT_EQ(reader.longName("/model/s"), "Depth");
  EXPECT_EQ(reader.integers("/model/nodes"), (std::vector<int>{1, 2}));
  EXPECT_EQ(reader.shape("/transient/displacement"), (std::vector<std::size_t>{5, 2, 3}));
  EXPECT_EQ(reader.rows("/transient/displacement", 4, 1), std::vector<double>(6, 1.0));
  EXPECT_EQ(reader.textAttribute("/", "deck_text"), provenance_.deckText);
  EXPECT_EQ(reader.textAttribute("/", "deck_sha256"), "abc");
  EXPECT_THROW(reader.numbers("/model/nothing"), FileError);
}

TEST_F(Io, WhatWasFlushedIsReadableAlthoughTheFileWasNeverFinished) {
  {
    io::ResultsFile file(at("results.h5"), provenance_);
    file.series("/transient/time", {}, "s", "Time").append(0.5);
    file.flush();
  }
  EXPECT_EQ(io::ResultsReader(at("results.h5.part")).numbers("/transient/time"), std::vector<double>{0.5});
}

TEST_F(Io, NumbersThatAreNotFiniteAndMissingUnitsAreRefused) {
  io::ResultsFile file(at("results.h5"), provenance_);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(file.write("/a", nan, "m", "A"), Error);
  EXPECT_THROW(file.series("/b", {}, "s", "B").append(nan), Error);
  EXPECT_THROW(file.write("/c", 1.0, "", "C"), Error);
}

TEST_F(Io, AFolderThatCannotBeMadeIsAFileError) {
  io::writeText(at("file"), "not a folder");
  EXPECT_THROW(io::OutputFolder(at("file") + "/results"), FileError);
  EXPECT_THROW(io::ResultsFile(at("file") + "/results.h5", provenance_), FileError);
  EXPECT_THROW(io::ResultsReader(at("nowhere.h5")), FileError);
}

TEST_F(Io, AFailedRunLeavesFinishedResultsAlone) {
  const auto stage = [&](io::OutputFolder& folder, const char* status, const char* text) {
    io::Summary summary;
    summary.set("status", status);
    io::stageText(folder.file("table.csv"), text);
    summary.set("files", folder.files());
    summary.stage(folder.file("summary.json"));
  };
  {
    io::OutputFolder folder(at("run"));
    stage(folder, "finished", "good");
    folder.publish();
  }
  {
    io::OutputFolder folder(at("run"));
    EXPECT_TRUE(folder.hasFinishedResults());
    stage(folder, "failed", "bad");
    EXPECT_FALSE(folder.publishUnfinished());
  }
  EXPECT_EQ(io::readText(at("run/table.csv")), "good");
  EXPECT_EQ(io::readPreviousRun(at("run/summary.json")).status, "finished");
}

TEST_F(Io, TheSummaryKnowsItsKeys) {
  io::Summary summary;
  summary.set("static.contact_nodes", 81);
  EXPECT_THROW(summary.set("static.contact_node", 81), Error);
  EXPECT_THROW(summary.set("static.residual", std::numeric_limits<double>::infinity()), Error);
  EXPECT_NE(summary.text().find("\"contact_nodes\": 81"), std::string::npos);
  EXPECT_NE(summary.text().find("\"top_axial_force\": null"), std::string::npos);
}

TEST_F(Io, TablesReadBackAsTheSameDoubles) {
  io::Csv table({{"s", "m"}, {"name", ""}});
  table.row(std::vector<double>{0.1, 1.0 / 3.0});
  table.row(std::vector<std::string>{"a,b", "plain"});
  EXPECT_EQ(table.text().substr(0, table.text().find('\n')), "s [m],name");
  EXPECT_NE(table.text().find("0.3333333333333333"), std::string::npos);
  EXPECT_NE(table.text().find("\"a,b\""), std::string::npos);
  EXPECT_THROW(table.row(std::vector<double>{1.0}), Error);
}

}  // namespace
