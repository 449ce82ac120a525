// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Windows of steps repeated in halves: their results, and that they do not affect the run.
#include "transient/verdict/StepError.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <string>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient::testing {
namespace StepErrorTest {

constexpr double w = 10, duration = 2000 / w;

/// S of a free vibration with wh radians per step.
double ofVibration(double wh, double radius, bool corrected, double sampling = 100) {
  Keep samples;
  auto o = options("Generalized-alpha", duration, wh / w, sampling * wh / w);
  o.own.set("Phase Correction", corrected);
  o.own.set("Spectral Radius", radius);
  o.own.set("Tolerance", 1e-12);
  acceptCoarseSteps(o);
  return integrate(oscillator(1.0, 0.0, w * w, 0.3, 0.0), o, samples).stepError;
}

/// Without damping (r = 1) the scheme is the trapezoidal rule, which turns (q, v/w) by a = 2
/// atan(wh/2) and keeps its length; two halves turn it by b = 4 atan(wh/4). A motion that turns by
/// b per step and has q_0 and q_1 of one that turns by a, q_k = cos(f + k a), ends n steps later
/// at (q_1 sin nb - q_0 sin (n-1)b) / sin b. T is 3 s; the run begins at rest, at its amplitude:
/// <|q - q(0)|^2> = 3/2, <|v|^2> = 2 sin^2(a/2) / h^2. Without phase correction windows have two
/// radians at the root of their ratio, 8 to 32 steps.
double expectedOfVibration(double wh) {
  const double a = 2 * std::atan(wh / 2), b = 4 * std::atan(wh / 4), h = wh / w;
  const double omega = std::sqrt(2 * std::pow(std::sin(a / 2) / h, 2) / 1.5);
  const int n = static_cast<int>(std::clamp(2 / (omega * h), 8.0, 32.0));
  double error = 0, moved = 0;
  for (double f = 0; f < 2 * constants::pi; f += 1e-3) {
    const auto q = [&](int k) { return std::cos(f + k * a); };
    error +=
        std::pow(q(n) - (q(1) * std::sin(n * b) - q(0) * std::sin((n - 1) * b)) / std::sin(b), 2);
    double most = 0;
    for (int k = 1; k <= n; ++k) most = std::max(most, std::pow(q(k) - q(0), 2));
    moved += most;
  }
  return 3 * omega * std::sqrt(error / moved);
}

TEST(StepError, measuresThePhaseThatAWindowLoses) {
  for (double wh : {0.05, 0.2, 0.4}) {
    const double expected = expectedOfVibration(wh);
    EXPECT_NEAR(ofVibration(wh, 1.0, false), expected, 0.1 * expected) << wh;
    EXPECT_NEAR(ofVibration(wh, 1.0, false, 0.75), expected, 0.1 * expected)
        << wh << ", samples within a step";
  }
}

/// Reported loss of amplitude by the scheme [%]; 0 without a report.
double saidOfDamping(const TransientOptions& o, Keep& samples) {
  log::clearWarnings();
  integrate(oscillator(2.0, 0.0, 2 * w * w, 0.3, 0.0), o, samples);
  for (const auto& line : log::warnings())
    if (const auto at = line.find(" s take "); at != std::string::npos)
      return std::stod(line.substr(at + 8));
  return 0;
}

/// The reported damping in 3 s of a free vibration is the loss of its amplitude (root of the
/// energy), within the accuracy of one sample in eleven steps. The phase correction changes the
/// mass of the scheme by some per cent.
TEST(StepError, saysWhatTheSchemeTakesOfTheAmplitude) {
  for (const double radius : {0.0, 0.2, 0.5})
    for (const bool corrected : {false, true}) {
      const double h = 0.3 / w, end = 400 * h;
      auto o = options("Generalized-alpha", end, h, h);
      o.own.set("Spectral Radius", radius);
      o.own.set("Phase Correction", corrected);
      o.own.set("Tolerance", 1e-12);
      o.stepErrorWarning = 1e-3;
      acceptCoarseSteps(o);
      Keep samples;
      const double said = saidOfDamping(o, samples);
      const auto energy = [&](std::size_t i) {
        return std::pow(samples.v[i][0], 2) + std::pow(w * samples.q[i][0], 2);
      };
      const double left = std::pow(energy(samples.q.size() - 1) / energy(0), 0.5 * 3 / end);
      EXPECT_NEAR(said, 100 * (1 - left), (corrected ? 30 : 20) * (1 - left))
          << radius << corrected;
    }
  auto o = options("Generalized-alpha", 10, 0.03, 0.03);
  o.own.set("Spectral Radius", 1.0);
  o.stepErrorWarning = 1e-3;
  acceptCoarseSteps(o);
  Keep samples;
  EXPECT_EQ(saidOfDamping(o, samples), 0.0);
}

/// With phase correction the phase is accurate to fourth order, and S is its error: S falls to a
/// sixteenth with half the step (to a ninth in windows short compared with a period), and is far
/// below S without the correction. Windows that began with the velocity of the run would give 60 %
/// of it.
TEST(StepError, isThatOfTheCorrectedPhase) {
  for (double radius : {0.8, 1.0}) {
    const double coarse = ofVibration(0.2, radius, true), fine = ofVibration(0.1, radius, true);
    EXPECT_GT(coarse, 7 * fine) << radius;
    EXPECT_LT(coarse, 20 * fine) << radius;
    EXPECT_LT(coarse, 0.05 * ofVibration(0.2, radius, false)) << radius;
  }
}

/// Consecutive windows and widely spaced ones give the same motion and the same counts, to the last
/// digit. In a rotor whose gyroscopic terms split its frequencies the phase is accurate to second
/// order only. With short steps, windows of 8 steps gave a third to a sixth of the error.
TEST(StepError, isThatOfARotor) {
  Matrix K(2, 2), G(2, 2);
  K << 1e4, 0, 0, 1.3e4;
  for (const double g : {50.0, 100.0, 200.0})
    for (const double h : {5e-4, 2.5e-4}) {
      G << 0, g, -g, 0;
      auto model = denseModel(Matrix::Identity(2, 2), G, K);
      model.initialDisplacement = Vector{{1e-3, 0.0}};
      model.initialVelocity = Vector{{0.0, 0.1}};
      Matrix A = Matrix::Zero(4, 4);
      A.topRightCorner(2, 2).setIdentity();
      A.bottomLeftCorner(2, 2) = -K;
      A.bottomRightCorner(2, 2) = -G;
      const Eigen::ComplexEigenSolver<Matrix> modes(A);
      const Eigen::VectorXcd start = modes.eigenvectors().partialPivLu().solve(
          (Vector(4) << model.initialDisplacement, model.initialVelocity)
              .finished()
              .cast<std::complex<double>>());
      auto o = options("Generalized-alpha", 3.0, h, 0.01);
      acceptCoarseSteps(o);
      Keep samples;
      const double said = integrate(model, o, samples).stepError;
      double apart = 0, size = 0;
      for (std::size_t i = 0; i < samples.time.size(); ++i) {
        const Eigen::VectorXcd turned =
            (modes.eigenvalues() * samples.time[i]).array().exp() * start.array();
        const Vector exact = (modes.eigenvectors() * turned).real().head(2);
        apart += (samples.q[i] - exact).squaredNorm();
        size += (exact - model.initialDisplacement).squaredNorm();
      }
      const double error = std::sqrt(apart / size);
      EXPECT_GT(said, 0.5 * error) << g << ", " << h;
      EXPECT_LT(said, 3 * error) << g << ", " << h;
    }
}

TEST(StepError, leavesTheRunAlone) {
  const auto drop = [](double end, Keep& samples) {
    auto o = options("Generalized-alpha", end, 1e-3, 0.005);
    acceptCoarseSteps(o);
    return integrate(droppedBalls(6, 1e6, 2e3, 7e11, 2e4), o, samples);
  };
  Keep brief, whole;
  const auto first = drop(0.1, brief);
  const auto second = drop(2.0, whole);
  EXPECT_GT(first.stepError, 0.0);
  EXPECT_NE(first.stepError, second.stepError);
  ASSERT_EQ(brief.q.size(), 21u);
  for (std::size_t i = 0; i < brief.q.size(); ++i) {
    EXPECT_EQ(brief.q[i], whole.q[i]) << i;
    EXPECT_EQ(brief.v[i], whole.v[i]) << i;
    EXPECT_EQ(brief.a[i], whole.a[i]) << i;
  }
  EXPECT_GE(first.counters.steps, 100);
}

/// Balls at rest on a wall too stiff for the step have a velocity that depends on the step length;
/// the half steps do not differ because of it.
TEST(StepError, contactThatLastsIsNoError) {
  auto model = droppedBalls(10, 1e8, 0, 7e11, 2e5);
  model.loads[0].vector *= 20;
  model.initialDisplacement.setZero();
  Keep samples;
  auto o = options("Generalized-alpha", 2.0, 2e-3, 0.01);
  o.own.set("Spectral Radius", 0.2);
  o.own.set("Resolve Impacts", false);
  acceptCoarseSteps(o);
  const auto report = integrate(model, o, samples);
  EXPECT_GT(samples.v.back().norm(), 0.01);
  EXPECT_LT(report.stepError, 0.02);
}

}  // namespace StepErrorTest
}  // namespace tooljoint::transient::testing
