// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One step of each scheme against its formulas: coefficients of generalized-alpha, stages of
/// Runge-Kutta, and the error estimates of the two adaptive integrators.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient::testing {
namespace StepFormulaTest {

constexpr double mass = 2.0, damping = 0.8, stiffness = 200.0, start = 0.1, speed = -0.3;

model::SecondOrderModel body() { return oscillator(mass, damping, stiffness, start, speed); }

double acceleration(double q, double v) { return -(damping * v + stiffness * q) / mass; }

struct Point {
  double q, v;
};

/// The classical fourth-order method (Kutta 1901).
Point rungeKutta(const Point& y, double h) {
  const auto rate = [](const Point& at) { return Point{at.v, acceleration(at.q, at.v)}; };
  const auto moved = [&](const Point& k, double by) {
    return Point{y.q + by * k.q, y.v + by * k.v};
  };
  const Point k1 = rate(y), k2 = rate(moved(k1, h / 2)), k3 = rate(moved(k2, h / 2)),
              k4 = rate(moved(k3, h));
  return {y.q + h / 6 * (k1.q + 2 * k2.q + 2 * k3.q + k4.q),
          y.v + h / 6 * (k1.v + 2 * k2.v + 2 * k3.v + k4.v)};
}

TEST(StepFormula, RungeKuttaHasItsFourStages) {
  const double h = 0.05;
  Keep samples;
  integrate(body(), options("RK4", 4 * h, h, h), samples);
  ASSERT_EQ(samples.q.size(), 5u);
  Point y{start, speed};
  for (std::size_t i = 1; i < 5; ++i) {
    y = rungeKutta(y, h);
    EXPECT_NEAR(samples.q[i][0], y.q, 1e-14);
    EXPECT_NEAR(samples.v[i][0], y.v, 1e-13);
    EXPECT_NEAR(samples.a[i][0], acceleration(y.q, y.v), 1e-12);
  }
}

/// Accepted and rejected first steps of one step of length h at a tolerance.
TransientReport oneStep(const std::string& integrator, double h, const char* parameter,
                        double tolerance, Keep& samples) {
  auto o = options(integrator, h, h, h);
  o.own.set(parameter, tolerance);
  if (integrator == "Generalized-alpha")
    o.own.set("Phase Correction", false).set("Tolerance", 1e-12);
  return integrate(body(), o, samples);
}

/// error = (|q1 - q2| + |v1 - v2|)/15 of one step against two half steps; the half steps are kept
/// (Nguyen et al. 2020, appendix B).
TEST(StepFormula, AdaptiveRungeKuttaDividesTheDifferenceByFifteen) {
  const double h = 0.06;
  const Point whole = rungeKutta({start, speed}, h),
              halves = rungeKutta(rungeKutta({start, speed}, h / 2), h / 2);
  const double error = (std::abs(whole.q - halves.q) + std::abs(whole.v - halves.v)) / 15.0;
  Keep accepted, rejected;
  EXPECT_EQ(oneStep("RK4 adaptive", h, "Tolerance", 1.001 * error, accepted).counters.rejected, 0);
  EXPECT_GT(oneStep("RK4 adaptive", h, "Tolerance", 0.999 * error, rejected).counters.rejected, 0);
  EXPECT_NEAR(accepted.q.back()[0], halves.q, 1e-15);
  EXPECT_NEAR(accepted.v.back()[0], halves.v, 1e-14);
}

/// After a step with an error below a hundredth of the tolerance the next step is longer by the
/// growth factor.
TEST(StepFormula, AdaptiveRungeKuttaGrowsBelowAHundredthOfTheTolerance) {
  const double h = 0.06;
  const Point whole = rungeKutta({start, speed}, h),
              halves = rungeKutta(rungeKutta({start, speed}, h / 2), h / 2);
  const double error = (std::abs(whole.q - halves.q) + std::abs(whole.v - halves.v)) / 15.0;
  const auto longest = [&](double tolerance) {
    auto o = options("RK4 adaptive", 2.5 * h, h, 2.5 * h);
    o.own.set("Tolerance", tolerance).set("Growth", 1.25);
    Keep samples;
    return integrate(body(), o, samples).counters.maxStep;
  };
  EXPECT_NEAR(longest(100.1 * error), 1.25 * h, 1e-9 * h);
  EXPECT_NEAR(longest(99.9 * error), h, 1e-9 * h);
}

struct AlphaState {
  double q, v, a, A;
};

/// Chung and Hulbert (1993) with the forces balanced at the end of the step (Arnold and Bruels
/// 2007), by their formulas.
AlphaState alphaStep(const AlphaState& s, double h, double radius) {
  const double am = (2 * radius - 1) / (radius + 1), af = radius / (radius + 1), g = 0.5 - am + af,
               b = 0.25 * (1 - am + af) * (1 - am + af);
  // A1 = c0 + c1 a1, q1 = p + h^2 b A1, v1 = w + h g A1, m a1 + c v1 + k q1 = 0
  const double c0 = (af * s.a - am * s.A) / (1 - am), c1 = (1 - af) / (1 - am);
  const double p = s.q + h * s.v + h * h * (0.5 - b) * s.A, w = s.v + h * (1 - g) * s.A;
  const double a = -(damping * (w + h * g * c0) + stiffness * (p + h * h * b * c0)) /
                   (mass + c1 * (damping * h * g + stiffness * h * h * b));
  const double A = c0 + c1 * a;
  return {p + h * h * b * A, w + h * g * A, a, A};
}

AlphaState atRest() {
  return {start, speed, acceleration(start, speed), acceleration(start, speed)};
}

TEST(StepFormula, GeneralizedAlphaHasTheCoefficientsOfItsSpectralRadius) {
  const double h = 0.05;
  for (const double radius : {0.0, 0.3, 0.8, 1.0}) {
    auto o = options("Generalized-alpha", 5 * h, h, h);
    o.own.set("Spectral Radius", radius).set("Phase Correction", false).set("Tolerance", 1e-13);
    acceptCoarseSteps(o);
    Keep samples;
    integrate(body(), o, samples);
    ASSERT_EQ(samples.q.size(), 6u);
    AlphaState s = atRest();
    for (std::size_t i = 1; i < 6; ++i) {
      s = alphaStep(s, h, radius);
      EXPECT_NEAR(samples.q[i][0], s.q, 1e-11) << radius;
      EXPECT_NEAR(samples.v[i][0], s.v, 1e-10) << radius;
      EXPECT_NEAR(samples.a[i][0], s.a, 1e-9) << radius;
    }
  }
}

/// A vibration with a period far below the step decreases by the spectral radius in each step.
TEST(StepFormula, GeneralizedAlphaHasItsSpectralRadiusAtInfinity) {
  for (const double radius : {0.2, 0.5, 0.8}) {
    auto o = options("Generalized-alpha", 0.041, 1e-3, 1e-3);
    o.own.set("Spectral Radius", radius).set("Phase Correction", false).set("Tolerance", 1e-13);
    acceptCoarseSteps(o);
    Keep samples;
    integrate(oscillator(1.0, 0.0, 1e14, 1e-3, 0.0), o, samples);
    // a double eigenvalue -radius: |q_n| is of order n radius^n
    const double ratio = samples.q[40].norm() / samples.q[39].norm();
    EXPECT_NEAR(ratio, radius, 0.1 * radius);
  }
}

/// e = ((am - af)/2 + b - 1/6) h^2 (A_1 - A_0), the error of the scheme in the third term of the
/// series of the displacement.
TEST(StepFormula, GeneralizedAlphaJudgesAStepByTheTermItHasWrong) {
  const double h = 0.02, radius = 0.8;  // the default
  const double am = (2 * radius - 1) / (radius + 1), af = radius / (radius + 1),
               b = 0.25 * (1 - am + af) * (1 - am + af);
  const AlphaState first = atRest(), next = alphaStep(first, h, radius);
  const double error = std::abs(((am - af) / 2 + b - 1.0 / 6) * h * h * (next.A - first.A));
  Keep samples;
  EXPECT_EQ(
      oneStep("Generalized-alpha", h, "Step Tolerance", 1.001 * error, samples).counters.rejected,
      0);
  EXPECT_GT(
      oneStep("Generalized-alpha", h, "Step Tolerance", 0.999 * error, samples).counters.rejected,
      0);
}

/// Undamped vibrations of 10 and 100 Hz over 3 s: the sum of the step errors is at least the error
/// of the motion, and a warning is given at 5 %.
TEST(StepFormula, RungeKuttaSaysWhenItsErrorsAddUp) {
  const struct {
    double hertz, speed;
    bool coarse;
  } cases[] = {{10, 1e-4, true}, {10, 1.0, false}, {100, 1e-2, true}, {100, 30.0, false}};
  for (const auto& [hertz, v0, coarse] : cases) {
    log::clearWarnings();
    const double omega = hertz * constants::twoPi;
    Keep samples;
    integrate(oscillator(1.0, 0.0, omega * omega, 0.0, v0), options("RK4 adaptive", 3.0, 0, 0.003),
              samples);
    const auto& warnings = log::warnings();
    const bool warned = std::any_of(warnings.begin(), warnings.end(), [](const auto& text) {
      return text.find("the errors of the steps up to t = 3 s add up to") != std::string::npos;
    });
    double error = 0;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      error = std::max(error, std::abs(samples.v[i][0] / v0 - std::cos(omega * samples.time[i])));
    EXPECT_EQ(warned, coarse) << hertz << " Hz, " << v0 << " m/s: " << error;
    if (!warned) {
      EXPECT_LT(error, 0.05) << hertz << " Hz, " << v0 << " m/s";
    }
  }
  log::clearWarnings();
}

}  // namespace StepFormulaTest
}  // namespace tooljoint::transient::testing
