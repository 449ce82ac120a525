// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The identity of a run, which a checkpoint must match, contains every input that affects the
/// results, and nothing else.
#include "cases/run/RunIdentity.hpp"

#include <filesystem>
#include <gtest/gtest.h>
#include <map>
#include <string>
#include <vector>

#include "cases/imported/ImportedDeck.hpp"
#include "io/TextFile.hpp"
#include "substructures/drillstring/scene/Scene.hpp"
#include "tests/support/SourceFolder.hpp"
#include "tests/unit/io/Scratch.hpp"

namespace RunIdentityTest {

using namespace tooljoint;

const std::string source = testing_::sourceFolder();

std::string ofString(const std::vector<std::string>& overrides) {
  return cases::runIdentity(
      deck::Deck::read(source + "/tests/effects/scene.xml", drillstring::sceneSpec(), overrides));
}

TEST(RunIdentity, hasEveryInput) {
  const auto same = ofString({});
  EXPECT_EQ(ofString({}), same);
  for (const char* change : {"Well/Bore Radius=0.1081",
                             "Drillstring/Material/Density=7851",
                             "Drillstring/Components/collar/Elements=5",
                             "Supports/guide/Dofs=v",
                             "Mud/Density=1201",
                             "Contact/Stiffness=1.1e7",
                             "Contact/Friction/Dynamic=0.21",
                             "Contact/Intervals/deep/From=13",
                             "Loads/Weight On Bit=11 kN",
                             "Loads/Forces/push/Frequency=4",
                             "Loads/Unbalance/collar/Moment=0.6",
                             "Rotary Speed/Exponential/Final Speed=121 rpm",
                             "Damping/Mass Coefficient=0.11",
                             "Path/Pre-stress=Axial and torque",
                             "Static/Max Iterations=77",
                             "Substructures/Rule=Single",
                             "Reduction/Mode Selection/Modes=5",
                             "Transient/End Time=0.31",
                             "Transient/Step=0.0011",
                             "Transient/Sampling Interval=0.0051",
                             "Transient/Energy Ledger=false",
                             "Transient/Integrator=RK4",
                             "Transient/Generalized-alpha/Tolerance=1e-6",
                             "Output/Fields={displacement}",
                             "Output/XDMF=false",
                             "!Mud",
                             "!Reduction"})
    EXPECT_NE(ofString({change}), same) << change;
  for (const char* change : {"Transient/Progress=true", "Transient/Checkpoint Interval=0.01",
                             "Output/Folder=elsewhere", "Output/CSV=false", "Output/Compression=9"})
    EXPECT_EQ(ofString({change}), same)
        << change << ": " << cases::identityDifferences(same, ofString({change}));
}

/// The times of checkpoints affect SUNDIALS, which begins anew there.
TEST(RunIdentity, hasTheCheckpointIntervalWhereItMatters) {
  const std::string sundials = "Transient/Integrator=SUNDIALS CVODE";
  EXPECT_NE(ofString({sundials, "Transient/Checkpoint Interval=0.01"}),
            ofString({sundials, "Transient/Checkpoint Interval=0.02"}));
}

TEST(RunIdentity, namesWhatDiffers) {
  const auto same = ofString({});
  EXPECT_EQ(cases::identityDifferences(same, same), "");
  EXPECT_EQ(cases::identityDifferences(same, ofString({"Contact/Stiffness=1.5e7"})),
            "Contact/Stiffness was 1e+07 and is 1.5e+07");
  const auto fewer = cases::identityDifferences(same, ofString({"!Damping"}));
  EXPECT_EQ(fewer,
            "Damping was list and is not given; Damping/Mass Coefficient was 0.1 and is not given; "
            "Damping/Stiffness Coefficient "
            "was 0 and is not given");
}

/// Files are compared by content: those of a part, those in its folder, and those that match a
/// pattern.
TEST(RunIdentity, hasTheContentOfFiles) {
  const test::Scratch scratch;
  namespace fs = std::filesystem;
  fs::copy(source + "/xml/frame", scratch / "frame", fs::copy_options::recursive);
  fs::copy(source + "/xml/frame.xml", scratch / "frame.xml");
  const auto now = [&](const std::vector<std::string>& overrides) {
    return cases::runIdentity(
        deck::Deck::read(scratch / "frame.xml", cases::importedSpec(), overrides));
  };
  const auto change = [&](const std::string& name) {
    io::writeText(scratch / name, io::readText(scratch / name) + "\n");
  };
  auto before = now({});
  change("frame/arm/K.mtx");
  EXPECT_EQ(cases::identityDifferences(before, now({})),
            "the content of the file of Parts/Imported/arm/File/K.mtx has changed");
  before = now({});
  change("frame/arm/part.json");
  EXPECT_NE(now({}), before);
  const std::vector<std::string> one{"Parts/Imported/arm/File=frame/arm/part.json"};
  before = now(one);
  change("frame/arm/M.mtx");
  EXPECT_NE(now(one), before);

  io::writeText(scratch / "vectors of arm.mtx", "1");
  io::writeText(scratch / "other.mtx", "1");
  const std::vector<std::string> user{"Reduction/Basis=User Vectors",
                                      "Reduction/User Vectors/File=vectors of %.mtx"};
  before = now(user);
  change("other.mtx");
  EXPECT_EQ(now(user), before);
  change("vectors of arm.mtx");
  EXPECT_NE(now(user), before);
}

TEST(RunIdentity, hasTheContentOfATableOfPipes) {
  const test::Scratch scratch;
  io::writeText(scratch / "pipes.csv", "Name\n");
  const std::vector<std::string> table{"Drillstring/Pipe Table=" + (scratch / "pipes.csv")};
  const auto before = ofString(table);
  EXPECT_EQ(ofString(table), before);
  io::writeText(scratch / "pipes.csv", "Name,Length [m]\n");
  EXPECT_EQ(cases::identityDifferences(before, ofString(table)),
            "the content of the file of Drillstring/Pipe Table has changed");
}

/// Additional files read by a format are included: the other matrices of an Abaqus job, the mapping
/// of a Harwell-Boeing matrix, and files in another folder named by a JSON file; other files are
/// not.
TEST(RunIdentity, hasWhatAFormatReadsBesideItsFile) {
  const test::Scratch scratch;
  namespace fs = std::filesystem;
  fs::copy(source + "/xml/frame", scratch / "frame", fs::copy_options::recursive);
  fs::copy(source + "/xml/frame.xml", scratch / "frame.xml");
  fs::create_directory(scratch / "other");
  for (const char* name : {"job_STIF1.mtx", "job_MASS1.mtx", "job_DMPV1.mtx", "job_STIF2.mtx",
                           "other/K.hb", "other/K.mapping", "other/M.mapping"})
    io::writeText(scratch / name, "1");
  io::writeText(scratch / "part.json", R"({"matrices": {"stiffness": "other/K.hb"}})");
  const auto changes = [&](const std::string& part, const std::string& name) {
    const auto now = [&] {
      return cases::runIdentity(deck::Deck::read(scratch / "frame.xml", cases::importedSpec(),
                                                 {"Parts/Imported/arm/File=" + part}));
    };
    const auto before = now();
    io::writeText(scratch / name, io::readText(scratch / name) + "\n");
    return now() != before;
  };
  for (const char* read : {"job_STIF1.mtx", "job_MASS1.mtx", "job_DMPV1.mtx"})
    EXPECT_TRUE(changes("job_STIF1.mtx", read)) << read;
  EXPECT_FALSE(changes("job_STIF1.mtx", "job_STIF2.mtx"));
  for (const char* read : {"part.json", "other/K.hb", "other/K.mapping"})
    EXPECT_TRUE(changes("part.json", read)) << read;
  EXPECT_FALSE(changes("part.json", "other/M.mapping"));
}

}  // namespace RunIdentityTest
