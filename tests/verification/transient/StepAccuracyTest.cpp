// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A time step that is too large ends a run; smaller ones, and models at rest, pass.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
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
  anyway.own.set("Accept Coarse Steps", true);
  EXPECT_NO_THROW(integrate(model, anyway, sink));
}

/// Sixty steps are enough for both measures.
TEST(StepAccuracy, refusesShortRuns) {
  const double w = 2 * constants::pi * 10;
  NoSamples sink;
  try {
    integrate(oscillator(1.0, 0.0, w * w, 1e-3, 0.0), steps(5e-2, 3.0), sink);
    ADD_FAILURE() << "two steps a period were taken for a result";
  } catch (const ConvergenceError& error) {
    const std::string said = error.what();
    EXPECT_NE(said.find("is too large"), std::string::npos) << said;
    EXPECT_NE(said.find("step-doubling"), std::string::npos) << said;
  }
}

/// What is damped out long before a step ends does not move any more.
TEST(StepAccuracy, passesWhatStandsStillOrCreeps) {
  NoSamples sink;
  EXPECT_NO_THROW(integrate(oscillator(1.0, 0.0, 1e8, 0.0, 0.0), steps(5e-2, 20.0), sink));
  auto creeping = oscillator(1e-6, 1e3, 1e3, 1e-3, -1e-3);
  EXPECT_NO_THROW(integrate(creeping, steps(5e-2, 20.0), sink));
}

/// What a run with these steps says of them: the error it ends with, or else its warning.
std::string saidOf(const model::SecondOrderModel& model, const TransientOptions& options,
                   StepErrors* errors = nullptr) {
  NoSamples sink;
  log::clearWarnings();
  try {
    const auto report = integrate(model, options, sink);
    if (errors != nullptr) *errors = report.stepErrors;
  } catch (const ConvergenceError& error) {
    return error.what();
  }
  for (const auto& line : log::warnings())
    if (line.find("The time step (") != std::string::npos) return line;
  return "";
}

/// With r = 1 the scheme has d = 0 and b = 1/4, and A is the acceleration -w^2 q: e = h^2/12
/// (A_{n+1} - A_n), so R = (w h)^2 / 12. Runs of 300 periods; the bounds of R are 1 % and 2.5 %.
TEST(StepAccuracy, judgesVibrationByTheStepsOfAPeriod) {
  const double w = 10;
  const auto model = oscillator(1.0, 0.0, w * w, 1e-3, 0.0);
  const auto said = [&](double r, bool accept, StepErrors* errors) {
    const double h = std::sqrt(12 * r) / w;
    auto o = steps(h, 300 * 2 * constants::pi / w);
    o.own.set("Spectral Radius", 1.0);
    o.own.set("Phase Correction", false);
    o.own.set("Accept Coarse Steps", accept);
    return saidOf(model, o, errors);
  };
  for (const double r : {0.004, 0.008, 0.0125, 0.02, 0.03, 0.05}) {
    StepErrors errors;
    const auto warning = said(r, true, &errors);
    EXPECT_NEAR(errors.local, r, 0.02 * r);
    EXPECT_EQ(warning.empty(), r < 0.01) << r << ": " << warning;
    EXPECT_EQ(warning.find("is too large") != std::string::npos, r > 0.025) << r << ": " << warning;
    EXPECT_EQ(warning.find("is coarse") != std::string::npos, r > 0.01 && r < 0.025)
        << r << ": " << warning;
    EXPECT_EQ(said(r, false, nullptr),
              warning);  // the same sentence, as an error where steps are lost
  }
}

/// A mass on a spring of 5 Hz in steps of 14 ms, beside a wall: 1.7 % of what moves in a step, a
/// warning (2.7 % with r = 0.2, an error).
TEST(StepAccuracy, saysWhatMakesItWorse) {
  const std::string loose = "(Transient/Generalized-alpha/Tolerance = 0.01) adds to the error";
  const std::string impacts = "Resolve Impacts switched on";
  const auto said = [](double wall, double tolerance, double radius) {
    auto model = oscillator(5.0, 0.0, 5e3, 0.005, 0.3);
    if (wall > 0) addFloor(model, wall, 0, 7e11);
    auto o = steps(14e-3, 14.0);
    o.own.set("Tolerance", tolerance);
    o.own.set("Spectral Radius", radius);
    o.own.set("Resolve Impacts", false);
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

/// D of a kilometre hanging, its first two seconds, which is measured in contact: vibration error
/// beside 0.125 ms and 1e-8 is 6 % with steps of 10 ms and 0.1 % with steps of 1 ms. Other gravity
/// (9.80 to 9.83 m/s2) changes neither D (0.67 % and 0.02 %) in its second digit.
TEST(StepAccuracy, warnsOfAStringThatIsHardlyFollowed) {
  const auto hang = [](const std::string& step) {
    const auto scene = drillstring::readScene(
        std::string(TOOLJOINT_SOURCE_DIR) + "/xml/vertical_1000m.xml",
        {"Transient/End Time=2", "Transient/Step=" + step, "Transient/Progress=false", "!Study"});
    const auto model = drillstring::fullModel(drillstring::solveStatic(scene));
    NoSamples sink;
    log::clearWarnings();
    return integrate(model, scene.list().sublist("Transient"), sink).stepErrors;
  };
  const auto warned = [] {
    const auto& lines = log::warnings();
    return std::any_of(lines.begin(), lines.end(), [](const auto& line) {
      return line.find("is coarse") != std::string::npos;
    });
  };
  const auto coarse = hang("10 ms");
  EXPECT_TRUE(warned());
  EXPECT_LT(coarse.local, 0.01);  // which alone would have said nothing
  const auto fine = hang("1 ms");
  EXPECT_FALSE(warned());
  EXPECT_LT(10 * fine.stepDoubling, coarse.stepDoubling);
}

}  // namespace
}  // namespace tooljoint::transient
