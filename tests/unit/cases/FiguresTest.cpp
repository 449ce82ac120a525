// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Figures of merit against closed forms and published counts.
#include <cmath>
#include <gtest/gtest.h>
#include <map>
#include <vector>

#include "cases/figures/OrbitFigures.hpp"
#include "cases/figures/Rainflow.hpp"
#include "cases/figures/SignalFigures.hpp"
#include "common/Constants.hpp"
#include "substructures/drillstring/figures/BendingFigures.hpp"
#include "substructures/drillstring/figures/BitFigures.hpp"

namespace tooljoint::cases {
namespace FiguresTest {

using constants::pi;

constexpr int samples = 10000;

/// Calls take(phase) for one whole period, each phase once.
template <class Take>
void overOnePeriod(const Take& take) {
  for (int i = 0; i < samples; ++i) take(2.0 * pi * i / samples);
}

/// Cycles by range.
std::map<double, double> rangesOf(const std::vector<double>& history) {
  std::map<double, double> counts;
  const auto sink = [&](const LoadCycle& cycle) { counts[cycle.range] += cycle.count; };
  Rainflow rainflow;
  for (double value : history) rainflow.add(value, sink);
  rainflow.finish(sink);
  return counts;
}

/// A new object with the state restored from a checkpoint.
template <class Figures>
Figures reloaded(const Figures& figures, Figures fresh) {
  std::vector<double> memory;
  figures.save(memory);
  const double* at = memory.data();
  fresh.restore(at);
  EXPECT_EQ(at, memory.data() + memory.size());
  return fresh;
}

TEST(SignalFigures, OfASineAboutAMean) {
  // a + b sin: mean a, rms^2 = a^2 + b^2/2, index b/a
  SignalFigures signal;
  overOnePeriod([&](double phase) { signal.add(12.0 + 9.0 * std::sin(phase)); });
  EXPECT_NEAR(signal.mean(), 12.0, 1e-9);
  EXPECT_NEAR(signal.rms(), std::sqrt(144.0 + 40.5), 1e-9);
  EXPECT_NEAR(signal.min(), 3.0, 1e-6);
  EXPECT_NEAR(signal.max(), 21.0, 1e-6);
  EXPECT_NEAR(signal.fluctuationIndex(), 0.75, 1e-6);
  EXPECT_EQ(reloaded(signal, SignalFigures()).rms(), signal.rms());
}

TEST(SignalFigures, OfBackwardRotationAreThoseOfForwardRotation) {
  SignalFigures forward, backward;
  for (double value : {1.0, 3.0, 2.0}) forward.add(value), backward.add(-value);
  EXPECT_DOUBLE_EQ(backward.fluctuationIndex(), forward.fluctuationIndex());
}

TEST(MagnitudeFigures, OfAnOscillatorAreItsAmplitudes) {
  // x = X sin(omega t): acceleration omega^2 X at most, omega^2 X/sqrt(2) rms
  constexpr double amplitude = 2e-3, omega = 30.0;
  MagnitudeFigures figures(2);
  overOnePeriod([&](double phase) {
    const double a = omega * omega * amplitude * std::abs(std::sin(phase));
    figures.add(Vector{{a, 2.0 * a}});
  });
  EXPECT_NEAR(figures.peak()[0], 1.8, 1e-6);
  EXPECT_NEAR(figures.rms()[0], 1.8 / std::sqrt(2.0), 1e-9);
  EXPECT_NEAR(figures.overallRms(), 1.8 / std::sqrt(2.0) * std::sqrt(2.5), 1e-9);
  EXPECT_EQ(worst(figures.rms()).row, 1);
  EXPECT_EQ(reloaded(figures, MagnitudeFigures(2)).rms(), figures.rms());
}

TEST(Rainflow, CountsTheExampleOfTheStandard) {
  // ASTM E1049-85, figure 6: peaks and valleys A to I
  const std::map<double, double> expected{
      {3.0, 0.5}, {4.0, 1.5}, {6.0, 0.5}, {8.0, 1.0}, {9.0, 0.5}};
  EXPECT_EQ(rangesOf({-2, 1, -3, 5, -1, 3, -4, 4, -2}), expected);
}

TEST(Rainflow, SkipsSamplesBetweenReversals) {
  const std::map<double, double> expected{
      {3.0, 0.5}, {4.0, 1.5}, {6.0, 0.5}, {8.0, 1.0}, {9.0, 0.5}};
  EXPECT_EQ(rangesOf({-2, -1, -1, 1, 0, -3, 2, 5, 4, -1, 3, 3, -4, 4, 1, -2}), expected);
}

TEST(Rainflow, CountsNothingInAConstantHistory) { EXPECT_TRUE(rangesOf({7, 7, 7, 7}).empty()); }

TEST(Rainflow, CountsTheCyclesOfASine) {
  std::vector<double> history;
  constexpr int cycles = 20;
  for (int i = 0; i <= 40 * cycles; ++i) history.push_back(std::sin(2.0 * pi * i / 40));
  double count = 0.0, sameRange = 0.0;
  for (const auto& [range, number] : rangesOf(history)) {
    count += number;
    if (std::abs(range - 2.0) < 1e-9) sameRange += number;
  }
  // the first and the last quarter are halves of half the range
  EXPECT_DOUBLE_EQ(count, cycles + 0.5);
  EXPECT_DOUBLE_EQ(sameRange, cycles - 0.5);
}

TEST(Rainflow, GoesOnFromACheckpoint) {
  const std::vector<double> history{-2, 1, -3, 5, -1, 3, -4, 4, -2};
  for (std::size_t stop = 0; stop <= history.size(); ++stop) {
    std::map<double, double> counts;
    const auto sink = [&](const LoadCycle& cycle) { counts[cycle.range] += cycle.count; };
    Rainflow first;
    for (std::size_t i = 0; i < stop; ++i) first.add(history[i], sink);
    auto second = reloaded(first, Rainflow());
    for (std::size_t i = stop; i < history.size(); ++i) second.add(history[i], sink);
    second.finish(sink);
    EXPECT_EQ(counts, rangesOf(history)) << "stopped after " << stop;
  }
}

TEST(OrbitFigures, OfCircularOrbitsHaveTheirRateAndSense) {
  // node 1 forward at 0.5 Omega, node 2 backward at 3 Omega in contact, node 3 at rest off the axis
  constexpr double speed = 8.0;
  const double rates[] = {4.0, -24.0};
  OrbitFigures orbit(3);
  overOnePeriod([&](double phase) {
    Vector u(3), v(3), uDot(3), vDot(3);
    for (int i = 0; i < 2; ++i) {
      const double angle = rates[i] / 4.0 * phase, radius = 0.01 * (i + 1);
      u[i] = radius * std::cos(angle), v[i] = radius * std::sin(angle);
      uDot[i] = -rates[i] * v[i], vDot[i] = rates[i] * u[i];
    }
    u[2] = 0.02, v[2] = -0.01, uDot[2] = vDot[2] = 0.0;
    orbit.add({u, v, uDot, vDot, {0, 1, 1}, speed});
  });
  EXPECT_NEAR(orbit.rate()[0], 4.0, 1e-9);
  EXPECT_NEAR(orbit.rate()[1], -24.0, 1e-9);
  EXPECT_EQ(orbit.rate()[2], 0.0);
  EXPECT_EQ(orbit.forwardShare(), (Vector{{1.0, 0.0, 0.0}}));
  EXPECT_EQ(orbit.backwardShare(), (Vector{{0.0, 1.0, 0.0}}));
  EXPECT_EQ(orbit.forwardContact(), (Vector{{0.0, 0.0, 0.0}}));
  EXPECT_EQ(orbit.backwardContact(), (Vector{{0.0, 1.0, 0.0}}));
  EXPECT_EQ(reloaded(orbit, OrbitFigures(3)).rate(), orbit.rate());
}

TEST(OrbitFigures, SenseIsThatOfTheRotation) {
  // the same orbit is backward whirl of a string that turns the other way
  OrbitFigures orbit(1);
  const Vector u{{0.01}}, v{{0.0}}, uDot{{0.0}}, vDot{{0.04}};
  orbit.add({u, v, uDot, vDot, {0}, -8.0});
  EXPECT_DOUBLE_EQ(orbit.rate()[0], 4.0);
  EXPECT_EQ(orbit.backwardShare()[0], 1.0);
}

TEST(OrbitFigures, OfNodesThatWhirlAlikeTheWidestOrbitIsNamed) {
  OrbitFigures orbit(4);
  const Vector u{{0.0, 0.01, 0.02, 0.03}}, none = Vector::Zero(4), vDot = 4.0 * u;
  orbit.add({u, none, none, Vector(vDot - 4.0 * Vector{{0, 0, 0, 0.03}}), {0, 0, 1, 1}, -8.0});
  EXPECT_EQ(orbit.most(orbit.backwardShare()).row, 2);
  EXPECT_EQ(orbit.most(orbit.backwardShare()).value, 1.0);
  EXPECT_EQ(orbit.most(orbit.backwardContact()).row, 2);
}

TEST(OrbitFigures, SlowRockingIsNoWhirl) {
  OrbitFigures orbit(1);
  const Vector u{{0.01}}, v{{0.0}}, uDot{{0.0}}, vDot{{0.99e-2 * 0.8}};
  orbit.add({u, v, uDot, vDot, {1}, 8.0});
  EXPECT_EQ(orbit.forwardShare()[0], 0.0);
}

}  // namespace FiguresTest
}  // namespace tooljoint::cases

namespace tooljoint::drillstring {
namespace FiguresTest {

using constants::pi;

TEST(BitFigures, StickSlipIndexAndStuckShare) {
  // omega = W (1 + sin): index 1; below W/2 for a third of the period
  BitFigures bit(5.0, 0.05);
  for (int i = 0; i < 30000; ++i) {
    BitSample sample;
    sample.imposed = 10.0;
    sample.speed = 10.0 * (1.0 + std::sin(2.0 * pi * (i + 0.5) / 30000));
    bit.add(sample, false);
  }
  EXPECT_NEAR(bit.stickSlipIndex().value(), 1.0, 1e-7);
  EXPECT_NEAR(bit.stuckShare().value(), 1.0 / 3.0, 1e-4);
  EXPECT_FALSE(bit.specificEnergy());
  EXPECT_FALSE(bit.rateOfPenetration());
}

TEST(BitFigures, ABitThatNothingTurnsDoesNotStick) {
  BitFigures bit(5.0, 0.05);
  BitSample sample;
  for (const double speed : {1e-3, -2e-3}) {
    sample.speed = speed;
    bit.add(sample, false);
  }
  EXPECT_FALSE(bit.stickSlipIndex());
  EXPECT_FALSE(bit.stuckShare());
}

TEST(BitFigures, SeesAVibrationThatGrows) {
  const auto growth = [](double rate, double amplitude) {
    BitFigures bit(0.5, 0.05);
    BitSample sample;
    sample.imposed = 10.0;
    for (int i = 0; i <= 4000; ++i) {
      const double t = 1e-3 * i;
      sample.speed = sample.imposed + amplitude * std::exp(rate * t) * std::sin(40.0 * pi * t);
      bit.add(sample, t > 2.0);
    }
    return bit.growth();
  };
  EXPECT_NEAR(growth(1.0, 1e-6).value(), std::exp(2.0), 0.05 * std::exp(2.0));
  EXPECT_NEAR(growth(0.0, 1e-3).value(), 1.0, 1e-3);
  EXPECT_FALSE(growth(1.0, 1e-13));  // rounding
}

TEST(BitFigures, SpecificEnergyOfPureCutting) {
  // W = a zeta eps d, T = a^2 eps d/2, v = omega d/(2 pi): T omega/(pi a^2 v) = eps, and W/(pi a^2)
  // beside it
  constexpr double a = 0.108, eps = 60e6, zeta = 0.6, d = 2e-3, omega = 12.0;
  const double area = pi * a * a;
  BitFigures bit(0.5, area);
  BitSample sample;
  sample.speed = omega;
  sample.weight = a * zeta * eps * d;
  sample.torque = 0.5 * a * a * eps * d;
  sample.advance = omega * d / (2.0 * pi);
  for (int i = 0; i < 10; ++i) bit.add(sample, false);
  EXPECT_NEAR(*bit.specificEnergy(), eps + *sample.weight / area, 1e-3);
  EXPECT_NEAR(*bit.rateOfPenetration(), omega * d / (2.0 * pi), 1e-12);
}

TEST(BitFigures, AdvanceWhileTheBitTurnsBackward) {
  BitFigures bit(0.5, 0.05);
  BitSample sample;
  for (const double speed : {3.0, -1.0, 2.0, 4.0}) {
    sample.speed = speed;
    sample.advance = 0.01;
    bit.add(sample, false);
  }
  EXPECT_NEAR(bit.backwardAdvance().value(), 0.25, 1e-12);
}

TEST(BitFigures, NoSpecificEnergyOfABitThatDoesNotAdvance) {
  BitFigures bit(0.5, 0.05);
  BitSample sample;
  sample.weight = 1e5, sample.advance = 0.0;
  bit.add(sample, false);
  EXPECT_FALSE(bit.specificEnergy());
}

/// An element of 2 m that the path bends by `curvature` about y.
BendingElement bent(double curvature) {
  BendingElement element;
  element.pathCurvature = {curvature, 0.0};
  Eigen::Matrix<double, 2, 3> slope;  // theta x z
  slope << 0.0, 1.0, 0.0, -1.0, 0.0, 0.0;
  element.slope = {slope, slope};
  element.length = 2.0;
  element.rigidity = 1e6;
  element.stressPerMoment = 100.0;
  element.leastRange = 1e-3;
  return element;
}

TEST(BendingFigures, APipeThatTurnsInABendHasACycleARevolution) {
  // range 2 E I kappa in every plane of the pipe; damage by the line: n (S/S0)^m/N0
  constexpr double curvature = 5e-3;
  constexpr int turns = 50, perTurn = 80;
  BendingFigures figures({bent(curvature)}, io::SnLine{4.0, 2e6, 1e5});
  const Vector rest = Vector::Zero(12);
  for (int i = 0; i <= turns * perTurn; ++i) figures.add(rest, 2.0 * pi * i / perTurn);
  const auto found = figures.counts().front();
  EXPECT_NEAR(found.largestRange, 2.0 * 1e6 * curvature, 1e-6);
  EXPECT_NEAR(found.cycles, turns, 0.5);
  // S = 100 * 1e4 = 1 MPa, half of S0
  EXPECT_NEAR(found.damage, turns * std::pow(0.5, 4.0) / 1e5, 0.02 * turns / 16.0 / 1e5);
}

TEST(BendingFigures, MomentIsTheTurnOfTheSlopesOverTheLength) {
  // a straight pipe that does not turn, bent by theta_y = +-delta at its lower end
  BendingFigures figures({bent(0.0)}, std::nullopt);
  Vector d = Vector::Zero(12);
  for (double sense : {1.0, -1.0, 1.0}) {
    d[6 + 4] = sense * 1e-3;
    figures.add(d, 0.0);
  }
  const auto found = figures.counts().front();
  EXPECT_NEAR(found.largestRange, 1e6 * 2e-3 / 2.0, 1e-9);
  EXPECT_DOUBLE_EQ(found.cycles, 1.0);
  EXPECT_EQ(found.damage, 0.0);
}

TEST(BendingFigures, GoOnFromACheckpoint) {
  BendingFigures whole({bent(1e-3)}, io::SnLine{3.0, 1e8, 1e6}), first = whole, second = whole;
  const Vector rest = Vector::Zero(12);
  for (int i = 0; i < 500; ++i) {
    whole.add(rest, 0.3 * i);
    if (i < 123) first.add(rest, 0.3 * i);
  }
  std::vector<double> memory;
  first.save(memory);
  const double* at = memory.data();
  second.restore(at);
  for (int i = 123; i < 500; ++i) second.add(rest, 0.3 * i);
  EXPECT_EQ(second.counts().front().damage, whole.counts().front().damage);
  EXPECT_EQ(second.counts().front().cycles, whole.counts().front().cycles);
}

}  // namespace FiguresTest
}  // namespace tooljoint::drillstring
