// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps that do not follow the motion end a run; those that do, and models at rest, pass.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Log.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/unit/transient/Models.hpp"

namespace tooljoint::transient {
namespace {

using namespace testing;

struct NoSamples final : SampleSink {
  void sample(double, const Vector&, const Vector&, const Vector&) override {}
};

TransientOptions steps(double h, double end) {
  TransientOptions o;
  o.integrator = "Generalized-alpha";
  o.end = end;
  o.step = h;
  o.progress = false;
  return o;
}

/// 10 Hz: 100 steps a period, 20, 2.
TEST(StepResolution, refusesStepsThatLoseTheVibration) {
  const double w = 2 * 3.14159265358979 * 10;
  const auto model = oscillator(1.0, 0.0, w * w, 1e-3, 0.0);
  NoSamples sink;
  EXPECT_NO_THROW(integrate(model, steps(1e-3, 1.0), sink));
  EXPECT_NO_THROW(integrate(model, steps(5e-3, 2.0), sink));
  try {
    integrate(model, steps(5e-2, 20.0), sink);
    ADD_FAILURE() << "two steps a period were taken for a result";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("do not follow the motion"), std::string::npos) << error.what();
  }
  auto anyway = steps(5e-2, 20.0);
  anyway.own.set("Accept Coarse Steps", true);
  EXPECT_NO_THROW(integrate(model, anyway, sink));
}

/// Too short for steps to be taken twice: nothing is said of what was not measured.
TEST(StepResolution, refusesShortRunsByTheLocalErrorAlone) {
  const double w = 2 * 3.14159265358979 * 10;
  NoSamples sink;
  try {
    integrate(oscillator(1.0, 0.0, w * w, 1e-3, 0.0), steps(5e-2, 3.0), sink);
    ADD_FAILURE() << "two steps a period were taken for a result";
  } catch (const ConvergenceError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("do not follow the motion"), std::string::npos) << said;
    EXPECT_EQ(said.find("half the length"), std::string::npos) << said;
  }
}

/// What is damped out long before a step ends does not move any more.
TEST(StepResolution, passesWhatStandsStillOrCreeps) {
  NoSamples sink;
  EXPECT_NO_THROW(integrate(oscillator(1.0, 0.0, 1e8, 0.0, 0.0), steps(5e-2, 20.0), sink));
  auto creeping = oscillator(1e-6, 1e3, 1e3, 1e-3, -1e-3);
  EXPECT_NO_THROW(integrate(creeping, steps(5e-2, 20.0), sink));
}

/// The motion of the full model of a scene.
StepErrors move(const std::string& scene, std::vector<std::string> overrides) {
  overrides.push_back("Transient/Progress=false");
  const auto read = app::readScene(std::string(TOOLJOINT_SOURCE_DIR) + "/xml/" + scene + ".xml", overrides);
  const auto model = app::fullModel(app::settle(read));
  NoSamples sink;
  log::clearWarnings();
  return integrate(model, read.list().sublist("Transient"), sink).stepErrors;
}

/// A kilometre hanging, its first two seconds. Its motion is wrong by 6 % with steps of 10 ms and by 0.1 % with steps of 1 ms (dyn beside 0.125 ms and
/// 1e-8); where iterations of the former stop at 1e-2, by two fifths.
StepErrors hang(std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), {"Transient/End Time=2", "!Study"});
  return move("vertical_1000m", overrides);
}

bool warned(const std::string& of = "hardly follow the motion") {
  for (const auto& line : log::warnings())
    if (line.find(of) != std::string::npos) return true;
  return false;
}

TEST(StepResolution, refusesAStringThatContactAndIterationsLeadAstray) {
  try {
    hang({"Transient/Step=10 ms", "Transient/Generalized-alpha/Tolerance=1e-2"});
    ADD_FAILURE() << "a motion that has been led astray was taken for a result";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("Choose a smaller Transient/Step"), std::string::npos) << error.what();
  }
}

TEST(StepResolution, warnsOfAStringThatIsHardlyFollowed) {
  const auto coarse = hang({"Transient/Step=10 ms"});
  EXPECT_TRUE(warned());
  EXPECT_LT(coarse.local, 0.01);  // which alone would have said nothing
  const auto stopped = hang({"Transient/Step=10 ms", "Transient/Generalized-alpha/Tolerance=1e-2", "Transient/Generalized-alpha/Accept Coarse Steps=true"});
  EXPECT_GT(stopped.halving, 3 * coarse.halving);  // what iterations leave is in it
  EXPECT_TRUE(warned("Iterations that stop at a Transient/Generalized-alpha/Tolerance of 0.01 add to it"));
  const auto fine = hang({"Transient/Step=1 ms"});
  EXPECT_FALSE(warned());
  EXPECT_LT(10 * fine.halving, coarse.halving);
}

/// Walls of 1e9 N/m at 1 ms: with the usual damping of high frequencies a step leaves seven times as much (D of 2.1 %) as with that of impacts.
TEST(StepResolution, saysWhatWallsTooStiffForTheStepNeed) {
  const std::vector<std::string> hard = {"Contact/Stiffness=1e9", "Transient/End Time=1.5"};
  try {
    move("helical_170m", hard);
    ADD_FAILURE() << "rebounds that are not those of the wall were taken for a result";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("Spectral Radius of 0.2 or less"), std::string::npos) << error.what();
  }
  auto damped = hard;
  damped.push_back("Transient/Generalized-alpha/Spectral Radius=0.2");
  EXPECT_NO_THROW(move("helical_170m", damped));
  for (const auto& line : log::warnings()) EXPECT_EQ(line.find("Spectral Radius of"), std::string::npos) << line;
}

}  // namespace
}  // namespace tooljoint::transient
