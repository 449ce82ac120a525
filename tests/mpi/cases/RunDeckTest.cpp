// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Decks of both kinds run in this process: their results against closed forms and against each
/// other, on all ranks and on some, and their errors.
#include <algorithm>
#include <cmath>
#include <filesystem>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "common/report/Log.hpp"
#include "run.hpp"
#include "tests/support/SourceFolder.hpp"

namespace RunDeckTest {

using namespace tooljoint;

const std::string source = testing_::sourceFolder();
const std::string pipes = source + "/examples/01_vertical_string/deck.xml";
const std::string frame = source + "/xml/frame.xml";
/// A short motion, and the full model of the frame.
const std::vector<std::string> brief{"Transient/End Time=0.05", "Transient/Progress=false",
                                     "Transient/Step=2e-4"};
const std::vector<std::string> full{"!Reduction", brief[0], brief[1], brief[2]};

std::string refused() { return "refused_" + std::to_string(parallel::size()); }

class RunDeck : public ::testing::Test {
 protected:
  void SetUp() override { log::setQuiet(true); }
  void TearDown() override { log::setQuiet(false); }
  static std::string folder(const std::string& name) {
    return name + "_" + std::to_string(parallel::size());
  }
};

/// The first of thirty elements of 3 m carries in its middle the weight below: rho A g 88.5 m.
TEST_F(RunDeck, aStringGivesItsSummary) {
  const auto results = runDeck(pipes, {}, MPI_COMM_WORLD, {folder("pipes"), ""});
  const double perMetre = 7850 * constants::pi * (0.0635 * 0.0635 - 0.054 * 0.054) * 9.81;
  EXPECT_NEAR(results.number("static.top_axial_force"), 88.5 * perMetre, 1e-6 * 90 * perMetre);
  EXPECT_NEAR(results.number("static.hook_load"), 90 * perMetre, 1e-6 * 90 * perMetre);
  EXPECT_EQ(results.number("model.nodes"), 31);
  EXPECT_EQ(results.number("ranks"), parallel::size());
  EXPECT_EQ(results.status(), "finished");
  EXPECT_TRUE(results.flag("static.converged"));
  EXPECT_FALSE(results.has("transient.steps"));
  EXPECT_EQ(results.folder(), folder("pipes"));
  EXPECT_EQ(results.files().front(), "results.h5");
}

double largest(const std::vector<double>& values) {
  double most = 0;
  for (const double x : values) most = std::max(most, std::abs(x));
  return most;
}

TEST_F(RunDeck, importedPartsMoveFullAndReduced) {
  auto every = brief;
  every.emplace_back("Reduction/Mode Selection/Cut-off Frequency=1e7");
  const auto small = runDeck(frame, every, MPI_COMM_WORLD, {folder("reduced"), ""});
  const auto whole = runDeck(frame, full, MPI_COMM_WORLD, {folder("full"), ""});
  EXPECT_EQ(small.text("transient.model"), "reduced");
  EXPECT_EQ(whole.text("transient.model"), "full");
  EXPECT_GT(small.number("reduction.substructures.0.modes"), 0);
  const auto a = small.histories().numbers("/transient/displacement");
  const auto b = whole.histories().numbers("/transient/displacement");
  EXPECT_EQ(a.size(), b.size());
  double difference = 0;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    difference = std::max(difference, std::abs(a[i] - b[i]));
  EXPECT_GT(difference, 0);
  EXPECT_LT(difference, 1e-6 * largest(b));  // rounding: every mode is kept
  const auto time = whole.histories().numbers("/transient/time");
  EXPECT_DOUBLE_EQ(time.back(), 0.05);
}

/// Every rank runs its own deck at the same time.
TEST_F(RunDeck, ranksOfACommunicatorWorkAlone) {
  MPI_Comm mine = MPI_COMM_NULL;
  const int rank = parallel::rank();
  MPI_Comm_split(MPI_COMM_WORLD, rank, 0, &mine);
  const auto name = folder("alone") + "_" + std::to_string(rank);
  const double length = 0.05 + 0.005 * rank;
  {
    const auto results =
        runDeck(frame, {full[0], full[2], full[3], "Transient/End Time=" + std::to_string(length)},
                mine, {name, ""});
    EXPECT_EQ(results.number("ranks"), 1);
    EXPECT_NEAR(results.number("transient.end"), length, 1e-12);
  }
  MPI_Comm_free(&mine);
  EXPECT_EQ(parallel::rank(), rank);
}

std::string refusal(const std::string& deck, const std::vector<std::string>& overrides,
                    ExitCode expected) {
  try {
    runDeck(deck, overrides, MPI_COMM_WORLD, {refused(), ""});
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), expected) << error.what();
    return error.what();
  }
  return "";
}

TEST_F(RunDeck, errorsAreTheSentencesOfTheProgram) {
  parallel::agree([] {  // results of an earlier test would stay
    if (parallel::rank() == 0) std::filesystem::remove_all(refused());
  });
  EXPECT_NE(
      refusal(pipes, {"Loads/Gravitas=3"}, ExitCode::InvalidDeck).find("Did you mean \"Gravity\"?"),
      std::string::npos);
  EXPECT_NE(refusal("no_such_deck.xml", {}, ExitCode::Files).find("no_such_deck.xml"),
            std::string::npos);
  const auto unstable =
      refusal(frame, {full[0], full[2], "Transient/Integrator=RK4", "Transient/Step=0.005"},
              ExitCode::NotConverged);
  EXPECT_NE(unstable.find("The motion blew up in the step from t = "), std::string::npos)
      << unstable;
  // the folder says so too
  EXPECT_EQ(Results(refused()).status(), "failed");
}

TEST_F(RunDeck, valuesThatAreNotThereAreTold) {
  const auto results = runDeck(pipes, {}, MPI_COMM_WORLD, {folder("asked"), ""});
  const auto asked = [&](const std::string& key) {
    try {
      results.number(key);
    } catch (const UsageError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(asked("static.top_axial_forces"),
            "summary.json has no value \"static.top_axial_forces\". Did you mean "
            "\"static.top_axial_force\"?");
  EXPECT_EQ(asked("transient.steps"),
            "\"transient.steps\" of summary.json is null: the stage that computes it did not run.");
  EXPECT_EQ(asked("status"),
            "The value of \"status\" in summary.json is \"finished\", which is no number.");
}

}  // namespace RunDeckTest
