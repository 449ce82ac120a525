// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The motion of a run compared with that in half the step, and with neighbouring motions.
#include "transient/verdict/StepComparison.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <gtest/gtest.h>
#include <limits>
#include <string>
#include <utility>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient::testing {
namespace StepComparisonTest {

constexpr double w = 10, span = 3;

/// A comparison of generalized-alpha in steps of wh radians on a model that starts at rest.
struct Compared {
  CompiledModel model;
  StepComparison comparison;
  Compared(
      const model::SecondOrderModel& source, double wh, double radius, bool corrected,
      const std::function<bool()>& stop = [] { return false; })
      : model(source),
        comparison(
            model,
            [radius, corrected] {
              Teuchos::ParameterList own("Generalized-alpha");
              own.set("Spectral Radius", radius);
              own.set("Phase Correction", corrected);
              own.set("Tolerance", 1e-10);
              return IntegratorRegistry::instance().make("Generalized-alpha", own);
            },
            Window{0, span, 0, wh / w}, span, start(source), stop) {}
  State start(const model::SecondOrderModel& source) const {
    State state;
    state.resize(model.size(), model.states().size());
    model.toPositions(source.initialDisplacement, state.q);
    return state;
  }
};

/// The trapezoidal rule turns a free vibration by a = 2 atan(wh/2) in a step and by b = 4
/// atan(wh/4) in two halves, and keeps its length:
///
///     D^2 = sum (cos ka - cos kb)^2 / sum (cos kb - 1)^2
///     V^2 = sum (sin ka - sin kb)^2 / sum sin^2 kb
TEST(StepComparison, isThePhaseThatStepsLoseMoreThanHalves) {
  for (const double wh : {0.1, 0.3, 0.6}) {
    const double a = 2 * std::atan(wh / 2), b = 4 * std::atan(wh / 4);
    double apart = 0, moved = 0, speed = 0, other = 0, v = 0, otherV = 0;
    const int steps = static_cast<int>(std::floor(span * w / wh + 1e-6));
    for (int k = 1; k <= steps; ++k) {
      apart += std::pow(std::cos(k * a) - std::cos(k * b), 2);
      moved += std::pow(std::cos(k * b) - 1, 2);
      v += std::pow(std::sin(k * a) - std::sin(k * b), 2);
      otherV += std::pow(std::sin(k * b), 2);
      if (2 * k <= steps) continue;
      speed += std::pow(std::cos(k * a) - std::cos((k - 1) * a), 2);
      other += std::pow(std::cos(k * b) - std::cos((k - 1) * b), 2);
    }
    const auto model = oscillator(1.0, 0.0, w * w, 0.3, 0.0);
    Compared run(model, wh, 1.0, false);
    const auto found = run.comparison.withShorter();
    ASSERT_TRUE(found) << wh;
    EXPECT_NEAR(found->size, std::sqrt(apart / moved), 1e-3 * std::sqrt(apart / moved)) << wh;
    EXPECT_NEAR(found->velocities, std::sqrt(v / otherV), 1e-3 * std::sqrt(v / otherV)) << wh;
    EXPECT_NEAR(found->speeds, std::sqrt(speed / other), 1e-3) << wh;
  }
}

/// A slow mass beside one too fast for the step, with a fiftieth of its displacement and the same
/// velocity, or a third of it: the scheme damps the fast vibration in its first steps, so that S
/// does not contain it.
TEST(StepComparison, warnsOfVelocitiesThatStepsDoNotResolve) {
  struct Fast {
    double part, radius, stiffness;
  };
  for (const auto& [fast, radius, stiffness] :
       {Fast{0.006, 0.8, 2500}, Fast{0.002, 0.5, 2500}, Fast{0.005, 0.5, 1e4}}) {
    Matrix K = Matrix::Zero(2, 2);
    K.diagonal() << w * w, stiffness * w * w;
    auto model = denseModel(Matrix::Identity(2, 2), Matrix(), K);
    model.initialDisplacement << 0.3, fast;
    auto o = options("Generalized-alpha", span, 0.06 / w, 0.06 / w);
    o.own.set("Spectral Radius", radius);
    Keep samples;
    log::clearWarnings();
    const auto report = integrate(model, o, samples);
    EXPECT_GT(report.stepError, o.stepErrorWarning);  // that of the warning, not the small D
    EXPECT_LE(report.stepError, o.stepErrorLimit);    // velocities do not refuse a run
    ASSERT_FALSE(log::warnings().empty()) << fast;
    EXPECT_NE(log::warnings().back().find("and its velocities by"), std::string::npos);
  }
}

/// Half steps have no numerical damping: the loss of amplitude by the scheme shows in the speeds.
TEST(StepComparison, showsWhatTheSchemeTakes) {
  const auto model = oscillator(1.0, 0.0, w * w, 0.3, 0.0);
  for (const double radius : {0.0, 0.2}) {
    const double h = 0.3 / w;
    auto o = options("Generalized-alpha", span, h, h);
    o.own.set("Spectral Radius", radius);
    acceptCoarseSteps(o);
    Keep samples;
    integrate(model, o, samples);
    double mean = 0;
    for (std::size_t i = samples.q.size() / 2; i < samples.q.size(); ++i)
      mean += (std::pow(samples.q[i][0] / 0.3, 2) + std::pow(samples.v[i][0] / (0.3 * w), 2)) /
              static_cast<double>(samples.q.size() - samples.q.size() / 2);
    Compared run(model, 0.3, radius, true);
    const auto found = run.comparison.withShorter();
    ASSERT_TRUE(found);
    EXPECT_LT(std::sqrt(mean), 0.95) << radius;
    EXPECT_NEAR(found->speeds, std::sqrt(mean), 0.03) << radius;
  }
}

/// A disturbance of a thousandth stays small in a vibration, and separates the motions of balls
/// that bounce against each other on a hard floor.
TEST(StepComparison, tellsChaosFromVibration) {
  const auto mass = oscillator(1.0, 0.0, w * w, 0.3, 0.0);
  Compared vibration(mass, 0.1, 1.0, true);
  const auto calm = vibration.comparison.withDisturbed();
  ASSERT_TRUE(calm);
  EXPECT_GT(calm->size, 1e-5);
  EXPECT_LT(calm->size, 5e-3);
  const auto dropped = droppedBalls(6, 1e7, 0, 7e11, 2e4);
  Compared balls(dropped, 0.01, 0.8, true);
  const auto wild = balls.comparison.withDisturbed();
  ASSERT_TRUE(wild);
  EXPECT_GT(wild->size, 0.1);
}

/// A mass rests on a floor with (w h / 2)^2 = 6, which is an impact for half steps, too, beside a
/// mass that swings freely. A negative damper makes vibration of the contact grow by exp(10 t).
/// Steps and half steps suppress it, and S is that of the other mass.
TEST(StepComparison, seesContactThatHalvesHoldDownToo) {
  const auto said = [](double damper, double floor) {
    const Vector both = (Vector(2) << 0, w * w).finished(),
                 first = (Vector(2) << damper, 0).finished();
    auto model = denseModel(Matrix::Identity(2, 2), first.asDiagonal(), both.asDiagonal());
    model.loads.push_back({"weight", (Vector(2) << -9.81, w * w).finished(), 0});
    model.initialDisplacement << -9.81e-6, 1 + 3e-4;
    model.initialVelocity << 1e-5, 0;
    addFloor(model, 1e6, floor, 7e11);
    auto o = options("Generalized-alpha", 2.0, 5e-3, 0.05);
    o.own.set("Resolve Impacts", false);
    o.energyResidualLimit = std::numeric_limits<double>::infinity();
    Keep samples;
    log::clearWarnings();
    try {
      integrate(model, o, samples);
    } catch (const ConvergenceError& e) {
      return std::string(e.what());
    }
    return log::warnings().empty() ? std::string() : log::warnings().front();
  };
  const auto refused = said(-20, 0);
  EXPECT_NE(refused.find("too large: step error 1"), std::string::npos) << refused;
  EXPECT_NE(refused.find("estimated 0"), std::string::npos) << refused;
  EXPECT_NE(refused.find("from that in steps of 0.00063 s"), std::string::npos) << refused;
  EXPECT_EQ(said(-20, 1e3), "");  // the floor dissipates more than the damper supplies
  EXPECT_EQ(said(0, 0), "");
}

/// The error of a run of generalized-alpha, or else its warning. One number decides: the run is
/// refused if its step error is above the limit.
std::string saidOf(const model::SecondOrderModel& model, double end, double step,
                   double radius = 1.0, double limit = 0.2) {
  auto o = options("Generalized-alpha", end, step, step);
  o.own.set("Spectral Radius", radius);
  o.stepErrorLimit = limit;
  o.ledger = false;  // its balance would refuse some runs first
  Keep samples;
  log::clearWarnings();
  try {
    EXPECT_LE(integrate(model, o, samples).stepError, limit);
  } catch (const ConvergenceError& error) {
    const std::string text = error.what(), name = "step error ";
    const auto found = text.find(name);
    EXPECT_NE(found, std::string::npos) << text;
    EXPECT_GT(std::stod(text.substr(found + name.size())), 100 * limit) << text;
    return text;
  }
  return log::warnings().empty() ? "" : log::warnings().front();
}

/// A mass rests until a load moves it to another position in 50 ms: the vibration is compared, not
/// the rest. A step is half a radian of the vibration.
TEST(StepComparison, beginsWhereTheMotionDoes) {
  auto model = oscillator(1.0, 0.0, 50 * w * w, 0.0, 0.0);
  const int ramp = model.lawIndex(
      {"ramp", [](double t) { return std::min(std::max((t - 5) / 0.05, 0.0), 1.0); }});
  model.loads.push_back({"late", Vector::Constant(1, 50.0), ramp});
  const auto said = saidOf(model, 8, 8e-3);
  EXPECT_NE(said.find("in the 3 s from t = 4"), std::string::npos) << said;
  EXPECT_EQ(saidOf(model, 8, 1e-3), "");
}

/// A mass swings; after 6 s a load leaves a second one vibrating with a thirtieth of its
/// displacement and, at 1.2 radians in a step, more than its velocity.
TEST(StepComparison, looksAtTheBusiestMotionThatComesLater) {
  Matrix K = Matrix::Zero(2, 2);
  K.diagonal() << 0.25 * w * w, 900 * w * w;
  auto model = denseModel(Matrix::Identity(2, 2), Matrix(), K);
  model.initialDisplacement << 0.3, 0;
  EXPECT_EQ(saidOf(model, 12, 4e-3), "");
  const int late = model.lawIndex({"late", [](double t) { return t < 6 ? 0.0 : 1.0; }});
  const auto loaded = [&](double offset) {
    model.loads = {{"late", (Vector(2) << 0, 900 * w * w * offset).finished(), late}};
    return saidOf(model, 12, 4e-3);
  };
  const auto said = loaded(0.01);
  EXPECT_NE(said.find("step error"), std::string::npos) << said;
  const auto from = said.find("in the 1 s from t = ");
  ASSERT_NE(from, std::string::npos) << said;
  EXPECT_GT(std::stod(said.substr(from + 20)), 5) << said;
  EXPECT_EQ(loaded(1e-5), "");
}

/// Balls that swing against each other fall after 6 s. On a floor of 5e5 N/m neighbouring motions
/// separate, and a D of 40 % does not measure the step; on a softer floor they do not, and a D of
/// 13 % does.
TEST(StepComparison, saysNothingOfLaterChaos) {
  const auto said = [](double floor) {
    auto model = droppedBalls(6, floor, 0, 7e11, 1e5);
    model.loads[0].law = model.lawIndex({"late", [](double t) { return t < 6 ? 0.0 : 1.0; }});
    return saidOf(model, 11, 1e-3, 0.8);
  };
  EXPECT_EQ(said(5e5), "");
  const auto warned = said(1e5);
  EXPECT_NE(warned.find("step error 13 %: in the 1 s from t = 10 s"), std::string::npos) << warned;
}

/// A fast rotation beside a slow translation in one model: its loss counts if it has the energy,
/// and has no weight if its energy is small.
TEST(StepComparison, seesRotationsBesideTranslations) {
  Matrix K = Matrix::Zero(2, 2);
  K.diagonal() << 0.25 * w * w, 900 * w * w;
  auto model = denseModel(Matrix::Identity(2, 2), Matrix(), K, 2);
  model.componentNames = {"u", "theta_z"};
  model.recovery = Matrix(Matrix::Identity(2, 2)).sparseView();
  const auto said = [&](double angle) {
    model.initialDisplacement << 0.01, angle;
    return saidOf(model, span, 4e-3);
  };
  EXPECT_NE(said(0.3).find("is too large"), std::string::npos) << said(0.3);
  EXPECT_EQ(said(1e-6), "");
}

/// A mass creeps back to rest beside a vibration of a thirtieth of its displacement: the scheme
/// damps the vibration, which is all the speed of the second half.
TEST(StepComparison, hearsSpeedsOfMotionWithAShare) {
  Matrix C = Matrix::Zero(2, 2), K = Matrix::Zero(2, 2);
  C(0, 0) = 4 * w;
  K.diagonal() << w * w, 100 * w * w;
  auto model = denseModel(Matrix::Identity(2, 2), C, K);
  const auto said = [&](double vibration) {
    model.initialDisplacement << 0.3, vibration;
    return saidOf(model, 1.0, 5e-3, 0.0, 0.06);
  };
  EXPECT_EQ(said(0.01).find("too large"), std::string::npos) << said(0.01);
  EXPECT_NE(said(0.3).find("too large"), std::string::npos) << said(0.3);
  // displacements within the warning of 5 %, uncorrelated velocities
  K(1, 1) *= 4;
  model = denseModel(Matrix::Identity(2, 2), C, K);
  EXPECT_NE(said(0.013).find("too large"), std::string::npos) << said(0.013);
}

/// Vibration of many radians per step whose amplitude is a thousandth of the motion: S is above 1,
/// D is not, and only a motion that is compared in full passes.
TEST(StepComparison, savesAMotionOfWhichSSaysTooMuch) {
  Matrix K = Matrix::Zero(2, 2);
  K.diagonal() << w * w, 1e5 * w * w;
  auto model = denseModel(Matrix::Identity(2, 2), Matrix(), K);
  model.initialDisplacement << 0.3, 0.003;
  const auto brief = saidOf(model, span, 5e-4), whole = saidOf(model, 4 * span, 5e-4);
  EXPECT_NE(brief.find("is coarse"), std::string::npos) << brief;
  EXPECT_NE(whole.find("is too large"), std::string::npos) << whole;
}

/// A vibration of 5 Hz with a vibration error of 6 % after 3 s, a phase of 0.2 rad in second order:
/// half steps differ by 3/4 of that, within the warning, but S is above the limit, and eighths of
/// the step, which differ by 63/64, do not confirm the motion.
TEST(StepComparison, doubtsHalvesBesideALargerS) {
  const double fast = 10 * constants::pi, phase = 0.19, h = 0.01 * std::sqrt(phase / 0.775);
  auto o = options("Generalized-alpha", span, span / std::round(span / h), span);
  o.own.set("Spectral Radius", 1.0);
  o.own.set("Phase Correction", false);
  o.stepErrorLimit = 0.1;
  Keep samples;
  log::clearWarnings();
  integrate(oscillator(1.0, 0.0, fast * fast, 1e-3, 0.0), o, samples);
  ASSERT_FALSE(log::warnings().empty());
  const auto& said = log::warnings().front();
  EXPECT_NE(said.find("step error 6"), std::string::npos) << said;
  EXPECT_NE(said.find("from that in steps of 0.0006"), std::string::npos) << said;
}

/// Balls that strike a hard floor: the run halves its steps for each impact, whatever their length.
/// The comparison halves them once more.
TEST(StepComparison, halvesTheStepsOfImpactsToo) {
  const auto taken = [](bool sharp) {
    const auto balls = droppedBalls(6, 1e7, 0, 7e11, 2e4);
    CompiledModel model(balls);
    Teuchos::ParameterList own("Generalized-alpha");
    own.set("Spectral Radius", 1.0);
    const auto scheme = IntegratorRegistry::instance().make("Generalized-alpha", own);
    if (sharp) scheme->sharpen();
    State from, to;
    from.resize(model.size(), model.states().size());
    to = from;
    model.toPositions(balls.initialDisplacement, from.q);
    scheme->prepare(model, Window{0, 0.5, 0, 2e-3}, from);
    while (from.t < 0.5 - 1e-9) {
      scheme->advance(from, to);
      std::swap(from, to);
    }
    return scheme->counters().steps;
  };
  const long usual = taken(false), sharp = taken(true);
  EXPECT_GT(usual, 750);  // 250 without impacts
  EXPECT_GT(sharp, 1.5 * static_cast<double>(usual));
}

TEST(StepComparison, endsWhenItIsStopped) {
  const auto model = oscillator(1.0, 0.0, w * w, 0.3, 0.0);
  int looks = 0;
  Compared run(model, 0.1, 1.0, true, [&] { return ++looks > 10; });
  EXPECT_THROW(run.comparison.withShorter(), InterruptedError);
  EXPECT_EQ(looks, 11);
}

/// S is an estimate: steps with S above the warning differ from half steps by less. A vibration is
/// refused if no error is allowed. For impacts there is no message, and the report is that of a run
/// without comparison.
TEST(StepComparison, leavesTheRunAlone) {
  auto o = options("Generalized-alpha", 1.0, 2e-3, 0.01);
  o.stepErrorLimit = 1e-12;
  Keep compared, alone;
  EXPECT_THROW(integrate(oscillator(1.0, 0.0, 900 * w * w, 0.3, 0.0), o, compared),
               ConvergenceError);
  const auto model = eventful();
  const auto warnings = [] { return log::warnings().size(); };
  log::clearWarnings();
  o.stepErrorLimit = 0.02;
  o.stepErrorWarning = 0.01;
  const auto first = integrate(model, o, compared);
  EXPECT_EQ(warnings(), 0u);
  acceptCoarseSteps(o);
  const auto second = integrate(model, o, alone);
  EXPECT_EQ(warnings(), 1u);
  EXPECT_GT(second.stepError, o.stepErrorWarning);
  EXPECT_LT(first.stepError, o.stepErrorWarning);
  EXPECT_EQ(first.counters.newtonIterations, second.counters.newtonIterations);
  EXPECT_EQ(first.counters.factorisations, second.counters.factorisations);
  EXPECT_EQ(first.contactEvaluations, second.contactEvaluations);
  EXPECT_EQ(first.energy.residual(), second.energy.residual());
  EXPECT_EQ(first.energy.contact, second.energy.contact);
}

}  // namespace StepComparisonTest
}  // namespace tooljoint::transient::testing
