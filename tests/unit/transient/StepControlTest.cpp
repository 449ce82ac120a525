// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steps of Generalized-alpha controlled by their error: accuracy, length near impacts, and
/// refusals.
#include "transient/accuracy/StepControl.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "tests/support/ErrorText.hpp"
#include "transient/accuracy/StepGrid.hpp"

namespace tooljoint::transient::testing {
namespace StepControlTest {

TransientOptions controlled(double tolerance, double end, double step, double sampling) {
  auto o = options("Generalized-alpha", end, step, sampling);
  o.own.set("Step Tolerance", tolerance);
  return o;
}

/// Each accepted step.
class Steps final : public SampleSink {
 public:
  void sample(double t, const Vector& q, const Vector& v, const Vector&) override {
    time.push_back(t);
    place.push_back(q[0]);
    speed.push_back(v[0]);
  }
  std::vector<double> time, place, speed;
};

// The grid
// -------------------------------------------------------------------------------------------------

TEST(StepGrid, longerStepsBeginAtMultiplesOfThemselves) {
  StepGrid grid;
  grid.set({1.0, 1.5, 0, 0}, 0.1, 4);
  EXPECT_EQ(grid.next(), 1.1);
  grid.setLevel(2);
  EXPECT_EQ(grid.nextLength(1.0), 0.025);
  grid.advance();
  EXPECT_EQ(grid.lowest(0), 2);  // a quarter of the step is done
  EXPECT_DOUBLE_EQ(grid.next(), 1.05);
  grid.advance();
  EXPECT_EQ(grid.lowest(0), 1);
  EXPECT_EQ(grid.lowest(2), 2);
  grid.setLevel(1);
  grid.advance();
  EXPECT_EQ(grid.index(), 1);
  EXPECT_EQ(grid.lowest(0), 0);
}

TEST(StepGrid, theLastStepEndsWhereTheMotionDoes) {
  StepGrid grid;
  grid.set({0.0, 0.25, 0, 0}, 0.1, 4);
  grid.advance(), grid.advance();
  EXPECT_EQ(grid.next(), 0.25);
  EXPECT_DOUBLE_EQ(grid.nextLength(0.2), 0.05);
}

// The rule
// -------------------------------------------------------------------------------------------------

TEST(StepControl, halvesAsOftenAsAnErrorOfThirdOrderAsksFor) {
  StepControl control;
  control.set(1e-6, 10, 10);
  EXPECT_TRUE(control.accepts(1e-6));
  EXPECT_FALSE(control.accepts(1.01e-6));
  EXPECT_EQ(control.shorter(2e-6, 3), 4);    // to an eighth, half of the tolerance being aimed at
  EXPECT_EQ(control.shorter(3.9e-6, 3), 4);  // 4.9e-7 after one
  EXPECT_EQ(control.shorter(8e-6, 3), 5);    // 1e-6 after one, 1.25e-7 after two
  EXPECT_EQ(control.shorter(31e-6, 3), 5);   // 4.8e-7 after two
  EXPECT_EQ(control.shorter(1.0, 3), 10);    // the deepest level
  EXPECT_EQ(control.shorter(2e-6, 10), 11);  // nothing left
  EXPECT_EQ(control.shorter(std::nan(""), 3), 10);
}

TEST(StepControl, lengthensOnlyWhatWasCalmForAWhileAndAtMultiplesOfTheLongerStep) {
  StepControl control;
  control.set(1e-6, 4, 4);
  EXPECT_FALSE(control.accepts(2e-6));
  int level = control.shorter(2e-6, 0);
  ASSERT_EQ(level, 1);  // sub-steps of 8 sixteenths
  long done = 0;
  int steps = 0;
  while (level == 1 && steps < 100) level = control.next(5e-8, level, done += 8), ++steps;
  EXPECT_EQ(level, 0);
  EXPECT_EQ(done % 16, 0);
  EXPECT_GE(steps, 4);
  EXPECT_LE(steps, 6);
  // The error is too large for a longer step at any time: an error eight times as large would be
  // refused at once.
  level = control.shorter(2e-6, 0);
  for (int i = 0; i < 1000; ++i) ASSERT_EQ(control.next(1.3e-7, level, done += 8), 1);
}

/// If another reason, such as an impact, delays the longer step, it is offered again afterwards.
TEST(StepControl, offersALongerStepAgainUntilItIsTaken) {
  StepControl control;
  control.set(1e-6, 4, 4);
  ASSERT_EQ(control.shorter(2e-6, 0), 1);
  long done = 0;
  for (int i = 0; i < 8; ++i) control.next(5e-8, 1, done += 8);
  for (int i = 0; i < 8; ++i) {
    const int level = control.next(5e-8, 1, done += 8);
    EXPECT_EQ(level, done % 16 == 0 ? 0 : 1) << i;
  }
  control.lengthened();
  EXPECT_EQ(control.next(5e-8, 1, 16), 1);
}

TEST(StepControl, isMorePatientAfterALongerStepThatFailed) {
  StepControl control;
  control.set(1e-6, 4, 4);
  int level = control.shorter(2e-6, 0);
  long done = 0;
  std::vector<int> waits;
  for (int turn = 0; turn < 8; ++turn) {
    int steps = 0;
    while (level == 1) level = control.next(5e-8, level, done += 8), ++steps;
    control.lengthened();
    waits.push_back(steps);
    level = control.shorter(2e-6, level);
    done += 16;
  }
  EXPECT_GE(waits.back(), 8 * waits.front());
  EXPECT_LE(waits.back(), 260);
}

// The length
// -------------------------------------------------------------------------------------------------

/// Ten masses that move along x and turn, in physical coordinates and in modes of any scale: the
/// same displacement has the same norm.
TEST(MassNorm, isTheSameInAllCoordinates) {
  const int n = 10;
  Matrix M = Matrix::Zero(2 * n, 2 * n);
  for (int i = 0; i < n; ++i) M(2 * i, 2 * i) = 4.0, M(2 * i + 1, 2 * i + 1) = 1e-3;
  auto full = denseModel(M, Matrix(), 1e3 * M, 2);
  full.componentNames = {"u", "theta_x"};
  full.recovery.resize(2 * n, 2 * n);
  full.recovery.setIdentity();
  full.recoveryOffset = Vector::Zero(2 * n);

  Matrix T = Matrix::Zero(2 * n, 3);
  for (int i = 0; i < n; ++i) {
    const double x = (i + 0.5) / n * constants::pi;
    T(2 * i, 0) = 0.3 * std::sin(x), T(2 * i, 1) = 7.0 * std::sin(2 * x),
             T(2 * i, 2) = 100 * std::sin(3 * x);
  }
  auto reduced = denseModel(T.transpose() * M * T, Matrix(), 1e3 * T.transpose() * M * T);
  reduced.componentNames = full.componentNames;
  for (int j = 0; j < 3; ++j)
    reduced.dofs[static_cast<std::size_t>(j)] = model::DofLabel::modal(0, j);
  reduced.recovery = T.sparseView();
  reduced.recoveryOffset = Vector::Zero(2 * n);

  const Vector y = (Vector(3) << 1e-3, 2e-4, -3e-5).finished();
  double lengths[2];
  int k = 0;
  for (const auto* model : {&full, &reduced}) {
    const CompiledModel compiled(*model);
    MassNorm norm;
    norm.bind(compiled);
    Vector positions(model->size());
    compiled.toPositions(model == &full ? Vector(T * y) : y, positions);
    lengths[k++] = norm(positions);
  }
  const Vector moved = T * y;
  EXPECT_NEAR(lengths[0], moved.norm() / std::sqrt(n),
              1e-3 * lengths[0]);  // rotation adds its small inertia
  EXPECT_NEAR(lengths[1], lengths[0], 1e-3 * lengths[0]);
}

TEST(MassNorm, takesCoordinatesAsLengthsWhereNothingMovesAlong) {
  auto model = oscillator(7.0, 0, 1, 0, 0);
  const CompiledModel compiled(model);
  MassNorm norm;
  norm.bind(compiled);
  EXPECT_DOUBLE_EQ(norm(Vector::Constant(1, -0.02)), 0.02);
}

// Motion
// -------------------------------------------------------------------------------------------------

/// Largest error of a free vibration of 10 rad/s that is 0.3 m wide, over 2 s.
double vibrationError(const TransientOptions& o, TransientReport& report) {
  Steps samples;
  report = integrate(oscillator(2, 0, 200, 0.3, 0), o, samples);
  double error = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i)
    error = std::max(error, std::abs(samples.place[i] - 0.3 * std::cos(10 * samples.time[i])));
  return error;
}

/// The local error is of third order, the scheme of second: errors fall as tolerance^(2/3), by 16
/// for a tolerance 64 times as small. The steps are powers of two, so 64 is two halvings. With
/// phase correction they are smaller at the same steps; each change of the step then adds a single
/// error of third order.
TEST(ControlledSteps, errorFollowsTheTolerance) {
  for (const bool phase : {false, true}) {
    double last = 0;
    long lastSteps = 0;
    for (const double tolerance : {1e-4, 1e-4 / 64, 1e-4 / 4096}) {
      auto o = controlled(tolerance, 2, 0.1, 0.1);
      o.own.set("Phase Correction", phase);
      o.own.set("Tolerance", 1e-9);
      TransientReport report;
      const double error = vibrationError(o, report);
      const double h = report.counters.minStep;
      const double late = 0.3 * 20 * 0.088 * (10 * h) *
                          (10 * h);  // amplitude w t e (w h)^2, the error of the scheme after 2 s
      EXPECT_LT(error, (phase ? 0.4 : 2) * late) << "tolerance " << tolerance;
      if (last > 0) {
        EXPECT_GT(std::log2(last / error), phase ? 0 : 3.6)
            << "tolerance " << tolerance << " error " << error;
        EXPECT_NEAR(static_cast<double>(report.counters.steps) / static_cast<double>(lastSteps), 4,
                    0.6);
      }
      EXPECT_EQ(report.counters.halved, 0);
      EXPECT_GT(report.counters.rejected, 0);
      EXPECT_LT(report.counters.rejected, 10);
      last = error;
      lastSteps = report.counters.steps;
    }
  }
}

/// In a steady vibration the step length becomes constant, and the factor is kept.
TEST(ControlledSteps, keepTheirLengthInSteadyVibration) {
  TransientReport report;
  vibrationError(controlled(1e-5, 20, 0.1, 0.1), report);
  EXPECT_GT(report.counters.steps, 500);
  EXPECT_LT(report.counters.factorisations, report.counters.steps / 20);
  EXPECT_LT(report.counters.rejected, report.counters.steps / 20);
}

/// The estimated error of a step is its true error, except for the first two steps: A_0 is taken at
/// t = 0.
TEST(ControlledSteps, acceptsWhatTheFirstStepReallyMisses) {
  // q = t^3/6 under a force m t from rest: q''' = 1, and a scheme of second order has an error of
  // (d/2 + b - 1/6) h^3 per step.
  auto model = denseModel(scalar(3.0), Matrix(), Matrix());
  model.loads.push_back(
      {"ramp", Vector::Constant(1, 3.0), model.lawIndex({"t", [](double t) { return t; }})});
  const double r = 0.8, am = (2 * r - 1) / (r + 1), af = r / (r + 1),
               b = 0.25 * (1 + af - am) * (1 + af - am);
  const double h = 0.125, missed = ((am - af) / 2 + b - 1.0 / 6) * h * h * h;
  for (const double factor : {1.15, 0.85}) {
    Steps samples;
    auto o = controlled(factor * missed, 8, h, 1);
    o.own.set("Phase Correction", false);
    const auto report = integrate(model, o, samples);
    EXPECT_EQ(report.counters.rejected > 0, factor < 1) << factor;
    EXPECT_EQ(report.counters.steps == 64, factor > 1) << factor;
  }
}

/// A ball falls 5 mm onto a floor and bounces: long steps in the air, short ones on the floor, and
/// an accurate motion.
TEST(ControlledSteps, areShortOnlyAroundAnImpact) {
  const auto model = droppedBalls(1, 1e6, 0, 7e11);
  auto fine = options("RK4", 0.3, 1e-6, 0.004);
  fine.ledger = false;
  Steps reference, samples, fixed;
  integrate(model, fine, reference);
  const auto report = integrate(model, controlled(1e-7, 0.3, 4e-3, 4e-3), samples);
  ASSERT_EQ(samples.time.size(), reference.time.size());
  double worst = 0;
  for (std::size_t i = 0; i < samples.place.size(); ++i)
    worst = std::max(worst, std::abs(samples.place[i] - reference.place[i]));
  EXPECT_LT(worst, 1e-4);  // 2 % of the fall after four impacts
  EXPECT_EQ(report.counters.maxStep, 4e-3);
  EXPECT_LT(report.counters.minStep, 3e-4);  // the contact takes pi sqrt(m/k) = 7 ms
  EXPECT_GT(report.counters.rejected, 0);
  // Equal steps of the shortest length would be several times as many.
  EXPECT_LT(4 * static_cast<double>(report.counters.steps) * report.counters.minStep, 0.3);
  // and the same number of fixed steps is less accurate
  auto equal =
      options("Generalized-alpha", 0.3, 0.3 / static_cast<double>(report.counters.steps), 4e-3);
  equal.own.set("Resolve Impacts", false);
  integrate(model, equal, fixed);
  double worstFixed = 0;
  for (std::size_t i = 0; i < fixed.place.size(); ++i)
    worstFixed = std::max(worstFixed, std::abs(fixed.place[i] - reference.place[i]));
  EXPECT_GT(worstFixed, worst);
}

/// A wall too stiff for the longest step is an impact; the tolerance determines the accuracy of its
/// time.
TEST(ControlledSteps, resolveAStiffWallAsFarAsAsked) {
  const auto model = droppedBalls(1, 1e10, 0, 7e11);
  for (const double tolerance : {1e-5, 1e-8}) {
    Steps samples;
    auto o = controlled(tolerance, 0.1, 1e-3, 1e-3);
    o.own.set("Smallest Step", 1e-8);
    o.ledger = false;  // the loss of a coarse tolerance would end the run
    const auto report = integrate(model, o, samples);
    // Energy of the ball over its mass: an elastic wall returns it.
    const double start = 9.81 * samples.place.front(),
                 end = 9.81 * samples.place.back() + 0.5 * std::pow(samples.speed.back(), 2);
    const double lost = std::abs(end - start) / start;
    EXPECT_LT(report.counters.minStep, tolerance < 1e-6 ? 1e-5 : 1e-4);
    EXPECT_LT(lost, 2e-3);
  }
}

/// A wall of 1e9 N/m needs steps of 1e-6 s during contact, a fiftieth of the time: they grow again
/// after each impact.
TEST(ControlledSteps, growAgainAfterAnImpact) {
  const auto model = droppedBalls(1, 1e9, 0, 7e11);
  for (const double tolerance : {1e-3, 1e-5}) {
    Steps samples;
    auto o = controlled(tolerance, 0.5, 1e-3, 1e-3);
    o.ledger = false;
    const auto report = integrate(model, o, samples);
    EXPECT_LT(report.counters.steps, 15000) << tolerance;
    EXPECT_EQ(report.counters.maxStep, 1e-3);
  }
}

TEST(ControlledSteps, samplesStandOnTheGrid) {
  Steps samples;
  const auto report =
      integrate(oscillator(2, 0, 200, 0.3, 0), controlled(1e-5, 1, 0.02, 0.005), samples);
  ASSERT_EQ(samples.time.size(), 201u);
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    EXPECT_NEAR(samples.time[i], 0.005 * static_cast<double>(i), 1e-12);
    EXPECT_NEAR(samples.place[i], 0.3 * std::cos(10 * samples.time[i]), 2e-4);
  }
  EXPECT_LE(report.counters.maxStep, 0.02);
}

/// The energy residual of the steps is the damping of the scheme, and decreases with the tolerance.
TEST(ControlledSteps, theLedgerCloses) {
  double last = 1;
  for (const double tolerance : {1e-6, 1e-8}) {
    Steps samples;
    auto o = controlled(tolerance, 0.3, 2e-3, 0.01);
    o.own.set("Resolve Impacts", false);  // which would shorten steps by itself
    const auto report = integrate(droppedBalls(6, 1e6, 2e3, 7e11, 2e4), o, samples);
    EXPECT_LT(std::abs(report.energy.residual()), last / 2) << tolerance;
    last = std::abs(report.energy.residual());
  }
  EXPECT_LT(last, 2e-3);
}

TEST(ControlledSteps, equalRunsAreEqualToTheLastDigit) {
  Steps first, second;
  const auto model = droppedBalls(6, 1e6, 2e3, 7e11, 2e4);
  const auto o = controlled(1e-6, 0.2, 2e-3, 0.005);
  integrate(model, o, first);
  integrate(model, o, second);
  EXPECT_EQ(first.place, second.place);
  EXPECT_EQ(first.speed, second.speed);
}

TEST(ControlledSteps, aFailedNewtonStillHalves) {
  Steps samples;
  auto o = controlled(1e-3, 0.2, 2e-3, 0.005);
  o.own.set("Max Iterations", 2);
  o.own.set("Tolerance", 1e-10);
  o.own.set("Max Halvings", 16);
  const auto report = integrate(droppedBalls(6, 1e6, 2e3, 7e11, 2e4), o, samples);
  EXPECT_GT(report.counters.halved, 0);
  EXPECT_EQ(report.counters.unconvergedSteps, 0);
}

TEST(ControlledSteps, aStepBelowTheSmallestEndsTheRunWithAdvice) {
  Steps samples;
  auto o = controlled(1e-9, 0.1, 1e-3, 1e-3);
  o.own.set("Smallest Step", 2e-4);
  const auto text = errorText([&] { integrate(droppedBalls(1, 1e8, 0, 7e11), o, samples); });
  EXPECT_NE(text.find("needs a step below 0.00025 s at t ="), std::string::npos) << text;
  EXPECT_NE(text.find("Raise Transient/Generalized-alpha/Step Tolerance"), std::string::npos)
      << text;
  EXPECT_NE(text.find("node 1"), std::string::npos) << text;
}

TEST(ControlledSteps, refuseASmallestStepThatMeansNothing) {
  Steps samples;
  auto o = controlled(1e-6, 0.1, 1e-3, 1e-3);
  o.own.set("Smallest Step", 2e-3);
  EXPECT_NE(errorText([&] {
              integrate(oscillator(1, 0, 1, 1, 0), o, samples);
            }).find("is longer than the longest step"),
            std::string::npos);
  o = options("Generalized-alpha", 0.1, 1e-3, 1e-3);
  o.own.set("Smallest Step", 2e-4);
  EXPECT_NE(errorText([&] {
              integrate(oscillator(1, 0, 1, 1, 0), o, samples);
            }).find("Step Tolerance chooses, which is not given"),
            std::string::npos);
}

}  // namespace StepControlTest
}  // namespace tooljoint::transient::testing
