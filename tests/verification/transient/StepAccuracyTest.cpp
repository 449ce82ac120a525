// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A time step that is too large ends a run; smaller ones, and models at rest, pass.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"
#include "tests/unit/transient/Models.hpp"

namespace tooljoint::transient {
namespace StepAccuracyTest {

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
  o.ledger = false;  // the energy balance would refuse the worst of them first
  return o;
}

/// 10 Hz: 100 steps a period, 20, 2.
TEST(StepAccuracy, refusesStepsThatLoseTheVibration) {
  const double w = 2 * constants::pi * 10;
  const auto model = oscillator(1.0, 0.0, w * w, 1e-3, 0.0);
  NoSamples sink;
  EXPECT_NO_THROW(integrate(model, steps(1e-3, 1.0), sink));
  EXPECT_NO_THROW(integrate(model, steps(5e-3, 2.0), sink));
  try {
    integrate(model, steps(5e-2, 20.0), sink);
    ADD_FAILURE() << "two steps a period were taken for a result";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("is too large"), std::string::npos) << error.what();
  }
  auto anyway = steps(5e-2, 20.0);
  anyway.stepErrorLimit = 1e6;
  EXPECT_NO_THROW(integrate(model, anyway, sink));
}

/// Sixty steps are enough.
TEST(StepAccuracy, refusesShortRuns) {
  const double w = 2 * constants::pi * 10;
  NoSamples sink;
  try {
    integrate(oscillator(1.0, 0.0, w * w, 1e-3, 0.0), steps(5e-2, 3.0), sink);
    ADD_FAILURE() << "two steps a period were taken for a result";
  } catch (const ConvergenceError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("is too large: step error"), std::string::npos) << said;
  }
}

/// A strongly damped motion has ended long before the end of a step.
TEST(StepAccuracy, passesWhatStandsStillOrCreeps) {
  NoSamples sink;
  EXPECT_NO_THROW(integrate(oscillator(1.0, 0.0, 1e8, 0.0, 0.0), steps(5e-2, 20.0), sink));
  auto creeping = oscillator(1e-6, 1e3, 1e3, 1e-3, -1e-3);
  EXPECT_NO_THROW(integrate(creeping, steps(5e-2, 20.0), sink));
}

/// The error of a run with these steps, or else its warning.
std::string saidOf(const model::SecondOrderModel& model, const TransientOptions& options) {
  NoSamples sink;
  log::clearWarnings();
  try {
    integrate(model, options, sink);
  } catch (const ConvergenceError& error) {
    return error.what();
  }
  for (const auto& line : log::warnings())
    if (line.find("The time step (") != std::string::npos) return line;
  return "";
}

/// With r = 1 the scheme loses a phase of (w h)^2 / 12 per radian. Its vibration error in a run of
/// 3 s at 5 Hz is 1/3 of the phase at the end, S 1/3 to 3/5 of it (formulas of the scheme,
/// evaluated separately): 3 % at 0.1 rad, 15 and 29 % at 0.3 and 0.5, 61 % at 1. The difference
/// from half the step is 3/4 of the error. Bounds of 5 and 20 %.
TEST(StepAccuracy, judgesVibrationByItsPhaseAtTheEnd) {
  const double w = 2 * constants::pi * 5, end = 3;
  const auto model = oscillator(1.0, 0.0, w * w, 1e-3, 0.0);
  for (const double phase : {0.01, 0.03, 0.1, 0.3, 0.5, 1.0, 2.0}) {
    const double h = end / std::round(end * w / std::sqrt(12 * phase / (w * end)));
    auto o = steps(h, end);
    o.own.set("Spectral Radius", 1.0);
    o.own.set("Phase Correction", false);
    const auto said = saidOf(model, o);
    EXPECT_EQ(said.empty(), phase < 0.2) << phase << ": " << said;
    EXPECT_EQ(said.find("is too large: step error") != std::string::npos, phase > 0.9)
        << phase << ": " << said;
    EXPECT_EQ(said.find("is coarse: step error") != std::string::npos, phase > 0.2 && phase < 0.9)
        << phase << ": " << said;
    o.stepErrorWarning = 10;
    o.stepErrorLimit = 10;
    EXPECT_EQ(saidOf(model, o), "") << phase;
  }
}

/// A mass on a spring of 5 Hz in steps of 14 ms, beside a wall, until it has come to rest there.
TEST(StepAccuracy, saysWhatMakesItWorse) {
  const std::string loose = "(Transient/Generalized-alpha/Tolerance = 0.01) adds to the error";
  const std::string impacts = "Resolve Impacts switched on";
  const auto said = [](double wall, double tolerance, double radius) {
    auto model = oscillator(5.0, 0.0, 5e3, 0.005, 0.3);
    if (wall > 0) addFloor(model, wall, 0, 7e11);
    auto o = steps(14e-3, 0.28);
    o.own.set("Tolerance", tolerance);
    o.own.set("Spectral Radius", radius);
    o.own.set("Resolve Impacts", false);
    o.stepErrorWarning = 1e-4;
    return saidOf(model, o);
  };
  for (const double tolerance : {1e-5, 1e-2})
    for (const double wall :
         {0.0, 1e7, 1e9})  // contact frequencies of 20 and 200 rad per step: impacts
      for (const double radius : {0.8, 0.2}) {
        const auto text = said(wall, tolerance, radius);
        EXPECT_NE(text.find("Reduce Transient/Step"), std::string::npos) << "\"" << text << "\"";
        EXPECT_EQ(text.find(loose) != std::string::npos, tolerance > 1e-5) << text;
        EXPECT_EQ(text.find(impacts) != std::string::npos, wall > 0) << text;
      }
}

/// A hanging kilometre, its first two seconds: the vibration error relative to 0.125 ms and 1e-8 is
/// 6 % with steps of 10 ms and 0.1 % with steps of 1 ms.
TEST(StepAccuracy, warnsOfAStringThatIsHardlyFollowed) {
  const auto hang = [](const std::string& step) {
    const auto scene = drillstring::readScene(
        testing_::sourceFolder() + "/xml/vertical_1000m.xml",
        {"Transient/End Time=2", "Transient/Step=" + step, "Transient/Progress=false", "!Study"});
    const auto model = drillstring::fullModel(drillstring::solveStatic(scene));
    NoSamples sink;
    return integrate(model, scene.list().sublist("Transient"), sink).stepError;
  };
  const double coarse = hang("10 ms"), fine = hang("1 ms");
  std::printf("step error %g and %g\n", coarse, fine);
  EXPECT_GT(coarse, 0.02);
  EXPECT_LT(coarse, 0.5);
  EXPECT_LT(fine, 0.02);
}

/// Message of a run of a scene for 2 s on its steps.
std::string saidOfScene(const std::string& deck, std::vector<std::string> more) {
  more.insert(more.end(), {"Transient/End Time=2", "Transient/Progress=false", "!Study"});
  const auto scene =
      drillstring::readScene(testing_::sourceFolder() + "/xml/" + deck + ".xml", more);
  const auto model = drillstring::fullModel(drillstring::solveStatic(scene));
  return saidOf(model, readOptions(scene.list().sublist("Transient")));
}

bool isRefused(const std::string& said) { return said.find("is too large") != std::string::npos; }

/// The string of stress_170m on walls of 1e8 and 1e9 N/m without damping: friction makes it
/// vibrate. With RK4 the lateral speed is 0.16 m/s rms from 1 to 2 s on the first wall. Steps with
/// a radius of 0.2 and of 0 suppress it to a tenth and less, with a step error of 2 % and a closed
/// energy balance, and so do half steps. With friction of 0.2 the measured loss of amplitude is
/// only 2 %, because the loss occurs in the first steps. On the wall of the scene the loss is
/// negligible.
TEST(StepAccuracy, refusesDampingThatHoldsVibrationDown) {
  const auto said = [](const std::string& stiffness, const std::string& radius,
                       std::vector<std::string> more) {
    more.insert(more.end(),
                {"Contact/Law=Clamped", "Contact/Stiffness=" + stiffness, "Contact/Damping=0",
                 "Transient/Generalized-alpha/Spectral Radius=" + radius});
    return saidOfScene("stress_170m", more);
  };
  for (const auto& text :
       {said("1e8", "0.2", {}), said("1e9", "0",
                                     {"Transient/Step=5e-4", "Contact/Friction/Static=0.2",
                                      "Contact/Friction/Dynamic=0.15"})}) {
    EXPECT_TRUE(isRefused(text)) << text;
    EXPECT_NE(text.find("Spectral Radius nearer to 1"), std::string::npos) << text;
  }
  const auto soft = said("1e7", "0", {"Transient/Step=5e-4"});
  EXPECT_FALSE(isRefused(soft)) << soft;
  EXPECT_EQ(saidOfScene("stress_170m", {}), "");
}

/// The inclined kilometre, relative to steps of 0.125 ms: 10 ms have a vibration error of 64 % with
/// a step error of 32 %, and 2.5 ms one of 13 %. Steps of 20 ms on helical_170m have a step error
/// of 17 % and a vibration error of 1.3 %.
TEST(StepAccuracy, judgesStringsByTheirMotion) {
  EXPECT_TRUE(isRefused(saidOfScene("inclined_1000m", {"Transient/Step=0.01"})));
  EXPECT_FALSE(isRefused(saidOfScene("inclined_1000m", {"Transient/Step=0.0025"})));
  EXPECT_FALSE(isRefused(
      saidOfScene("helical_170m", {"Transient/Step=0.02", "Transient/Sampling Interval=0.02"})));
}

}  // namespace StepAccuracyTest
}  // namespace tooljoint::transient
