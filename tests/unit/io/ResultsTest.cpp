// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// results.h5, summary.json and the output folder: round trips, units on every dataset, refusals,
/// no incomplete file under its final name.
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "io/Csv.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/ResultsReader.hpp"
#include "io/TextFile.hpp"
#include "io/Xdmf.hpp"
#include "io/summary/Summary.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace ResultsTest {

using namespace tooljoint;
namespace fs = std::filesystem;

/// A separate folder for each test.
class Io : public ::testing::Test {
 protected:
  std::string at(const std::string& name) const { return scratch_ / name; }

  const test::Scratch scratch_;
  const io::Provenance provenance_{
      "deck.xml", "<ParameterList name=\"x\"/>", "abc", {"Loads/Gravity=1"}};
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
  using Kind = io::ResultsReader::Kind;
  EXPECT_EQ(reader.kind("/model/s"), Kind::Real);
  EXPECT_EQ(reader.kind("/model/nodes"), Kind::Integer);
  EXPECT_THROW(reader.kind("/model/nothing"), FileError);
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
  EXPECT_EQ(io::ResultsReader(at("results.h5.part")).numbers("/transient/time"),
            std::vector<double>{0.5});
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
  EXPECT_TRUE(fs::exists(at("run/table.csv.part")));
  EXPECT_TRUE(fs::exists(at("run/summary.json.part")));
  {
    io::OutputFolder folder(at("run"));
    io::Summary summary;
    summary.set("status", "failed");
    summary.stage(folder.file("summary.json"));
    EXPECT_FALSE(folder.publishUnfinished());
  }
  EXPECT_FALSE(fs::exists(at("run/summary.json.part"))) << "a refused run left its summary alone";
  EXPECT_EQ(io::readText(at("run/table.csv")), "good");
  EXPECT_EQ(io::readPreviousRun(at("run/summary.json")).status, "finished");
}

/// Text of a file in the scratch folder.
void put(const std::string& path, const std::string& text) {
  fs::create_directories(fs::path(path).parent_path());
  io::writeText(path, text);
}

TEST_F(Io, ResultsOfAnotherCommandAreSetAside) {
  for (int i = 0; i < 2; ++i) {
    put(at("run/summary.json"),
        R"({"status": "finished", "files": ["results.h5", "motion.csv", "summary.json"]})");
    for (const char* name : {"results.h5", "motion.csv"})
      put(at(std::string("run/") + name), std::to_string(i));
    {
      io::OutputFolder folder(at("run"));
      io::stageText(folder.file("response.csv"), "response");
      io::stageText(folder.file("summary.json"), "{}");
      folder.publish();
    }
    const std::string aside = at(i == 0 ? "run/earlier" : "run/earlier_2");
    for (const char* name : {"results.h5", "motion.csv"}) {
      EXPECT_FALSE(fs::exists(at(std::string("run/") + name))) << name;
      EXPECT_EQ(io::readText(aside + "/" + name), std::to_string(i)) << name;
    }
    EXPECT_EQ(io::readPreviousRun(aside + "/summary.json").status, "finished");
    EXPECT_EQ(io::readText(at("run/response.csv")), "response");
  }
}

TEST_F(Io, FilesThatTheSameCommandNoLongerWritesAreRemoved) {
  put(at("run/summary.json"),
      R"({"status": "finished", "files": ["results.h5", "motion.csv", "summary.json"]})");
  for (const char* name : {"results.h5", "motion.csv"}) put(at(std::string("run/") + name), "old");
  {
    io::OutputFolder folder(at("run"));
    io::stageText(folder.file("results.h5"), "new");
    io::stageText(folder.file("summary.json"), "{}");
    folder.publish();
  }
  EXPECT_EQ(io::readText(at("run/results.h5")), "new");
  EXPECT_FALSE(fs::exists(at("run/motion.csv")));
  EXPECT_FALSE(fs::exists(at("run/earlier")));
}

TEST_F(Io, ResultsLargerThanTheDiskAreRefusedBeforeTheyAreComputed) {
  const io::OutputFolder folder(at("run"));
  EXPECT_NO_THROW(folder.requireSpace(1.0));
  for (const double bytes : {1e18, 1e30}) {
    try {
      folder.requireSpace(bytes);
      ADD_FAILURE() << bytes;
    } catch (const FileError& error) {
      EXPECT_NE(std::string(error.what())
                    .find("MB, but the results need about " +
                          std::string(bytes > 1e20 ? "9.5" : "953674316407 MB")),
                std::string::npos)
          << error.what();
    }
  }
}

TEST_F(Io, TheCheckpointOfAnotherRunIsSetAsideWithAllThatBelongsToIt) {
  for (int i = 0; i < 2; ++i) {
    for (const char* name :
         {"checkpoint.bin", "checkpoint.h5", "results.h5", "results.h5.part", "motion.csv"})
      put(at(std::string("run/") + name), std::to_string(i));
    put(at("run/summary.json"),
        R"({"status": "interrupted", "files": ["motion.csv", "results.h5", "summary.json", "../other.txt"]})");
    put(at("other.txt"), "not of the run");
    put(at("run/notes.txt"), "the user's own");
    const io::OutputFolder folder(at("run"));
    const std::string aside = at(i == 0 ? "run/interrupted" : "run/interrupted_2");
    for (const char* name :
         {"checkpoint.bin", "checkpoint.h5", "results.h5", "results.h5.part", "motion.csv"}) {
      EXPECT_FALSE(fs::exists(at(std::string("run/") + name))) << name;
      EXPECT_EQ(io::readText(aside + "/" + name), std::to_string(i)) << name;
    }
    EXPECT_TRUE(fs::exists(aside + "/summary.json"));
    EXPECT_TRUE(fs::exists(at("other.txt")));
    EXPECT_TRUE(fs::exists(at("run/notes.txt")));
  }
}

TEST_F(Io, FinishedResultsStayWhereTheyAreWhenACheckpointIsSetAside) {
  put(at("run/summary.json"), R"({"status": "finished", "files": ["results.h5", "summary.json"]})");
  put(at("run/results.h5"), "finished");
  put(at("run/results.h5.part"), "interrupted");
  put(at("run/checkpoint.bin"), "interrupted");
  const io::OutputFolder folder(at("run"));
  EXPECT_TRUE(folder.hasFinishedResults());
  EXPECT_EQ(io::readText(at("run/results.h5")), "finished");
  EXPECT_EQ(io::readText(at("run/interrupted/results.h5.part")), "interrupted");
  EXPECT_TRUE(fs::exists(at("run/interrupted/checkpoint.bin")));
  EXPECT_FALSE(fs::exists(at("run/interrupted/summary.json")));
}

TEST_F(Io, ARunThatGoesOnFindsItsCheckpointInPlace) {
  put(at("run/checkpoint.bin"), "mine");
  const io::OutputFolder folder(at("run"), io::OldCheckpoint::GoOn);
  EXPECT_EQ(io::readText(at("run/checkpoint.bin")), "mine");
}

TEST_F(Io, SeriesContinueThoseOfAnotherFile) {
  const auto row = [](double x) { return std::vector<double>{x, -x}; };
  {
    io::ResultsFile file(at("first.h5"), provenance_);
    auto& series = file.series("/a", {2}, "m", "A");
    for (int i = 0; i < 5000; ++i) series.append(row(0.5 * i).data());
    EXPECT_EQ(file.rows(), (std::map<std::string, std::uint64_t>{{"/a", 5000}}));
    file.finish();
  }
  {
    io::ResultsFile file(at("second.h5"), provenance_);
    file.continueFrom(at("first.h5"), {{"/a", 4321}});
    EXPECT_EQ(file.carried("/a").size(), 2 * 4321u);
    EXPECT_TRUE(file.carried("/b").empty());
    auto& series = file.series("/a", {2}, "m", "A");
    EXPECT_EQ(series.rows(), 4321u);
    EXPECT_EQ(file.series("/b", {}, "m", "B").rows(), 0u);
    series.append(row(-1).data());
    file.finish();
  }
  const io::ResultsReader reader(at("second.h5"));
  EXPECT_EQ(reader.shape("/a"), (std::vector<std::size_t>{4322, 2}));
  EXPECT_EQ(reader.rows("/a", 4320, 2), (std::vector<double>{2160, -2160, -1, 1}));
  EXPECT_EQ(reader.rows("/a", 0, 1), row(0));
}

TEST_F(Io, PicturesContinueWithTheirTimes) {
  io::XdmfScene scene;
  scene.positions.assign(1, Vector3::Zero());
  scene.frames.assign(1, Matrix3::Identity());
  const std::vector<double> motion(6, 0.1);
  io::XdmfFrame frame;
  frame.displacement = frame.velocity = motion.data();
  const auto pictures = [&](const std::string& name, const std::vector<double>& times,
                            const std::vector<double>* before, std::vector<double>& memory) {
    io::ResultsFile file(at(name), provenance_);
    if (before != nullptr)
      file.continueFrom(
          at("first.h5"),
          {{"/xdmf/time", 2}, {"/xdmf/displacement", 2}, {"/xdmf/speed", 2}, {"/xdmf/spin", 2}});
    io::XdmfRecorder recorder(file, scene, 0.1);
    if (before != nullptr) {
      const double* at = before->data();
      recorder.restore(at, frame);
      EXPECT_EQ(at, before->data() + before->size());
    }
    for (double t : times) {
      frame.time = t;
      recorder.append(frame);
    }
    recorder.save(memory);
    file.finish();
    return recorder.text("results.h5");
  };
  std::vector<double> memory, ignored;
  pictures("first.h5", {0.0, 0.05, 0.1, 0.15}, nullptr, memory);
  const auto later = pictures("second.h5", {0.19, 0.2, 0.25}, &memory, ignored);
  EXPECT_EQ(later, pictures("whole.h5", {0.0, 0.05, 0.1, 0.15, 0.19, 0.2, 0.25}, nullptr, ignored));
  EXPECT_EQ(io::ResultsReader(at("second.h5")).numbers("/xdmf/time"),
            (std::vector<double>{0.0, 0.1, 0.2}));
  // none due after the restart: the earlier ones are present all the same
  pictures("third.h5", {0.15}, &memory, ignored);
  EXPECT_EQ(io::ResultsReader(at("third.h5")).numbers("/xdmf/time"),
            (std::vector<double>{0.0, 0.1}));
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

}  // namespace ResultsTest
