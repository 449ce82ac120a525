// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The cutting law: forces against the formulas of its source, tangents against differences, the
/// surface left by a blade.
#include "model/laws/RegenerativeCutting.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "tests/unit/model/OnePoint.hpp"

namespace RegenerativeCuttingTest {

using namespace tooljoint;
using namespace tooljoint::model;
using namespace tooljoint::model::testing;

CuttingParameters bit() {
  CuttingParameters p;
  p.blades = 3;
  p.radius = 0.1;
  p.specificEnergy = 50e6;
  p.inclination = 0.6;
  p.wearFlat = 0.002;
  p.contactStress = 40e6;
  p.friction = 0.5;
  return p;
}

/// W = n a zeta eps delta + n a l sigma, T = n a^2 eps delta/2 + n mu gamma a^2 l sigma/2 with
/// delta = 2 pi V/(n Omega): Richard, Germay and Detournay 2007.
TEST(RegenerativeCutting, DrillsSteadily) {
  const auto p = bit();
  const FormulaLaw<RegenerativeCutting> law(RegenerativeCutting(p), 1);
  const std::vector<double> d{0.7, 100.0}, v{2e-3, 12.0};
  std::vector<double> x(static_cast<std::size_t>(law.states()));
  law.initialState(0, d.data(), v.data(), x.data());
  const double delta = constants::twoPi * v[0] / (3 * v[1]);
  const double W = 3 * 0.1 * (0.6 * 50e6 * delta + 0.002 * 40e6),
               T = 0.5 * 3 * 0.01 * (50e6 * delta + 0.5 * 0.002 * 40e6);
  auto f = forces(law, 0, d, v, x);
  EXPECT_NEAR(f[0], -W, 1e-6 * W);
  EXPECT_NEAR(f[1], -T, 1e-6 * T);
  // and a turn later, step by step
  const double h = 1e-3;
  std::vector<double> at = d;
  for (int i = 0; i < 600; ++i) {
    for (std::size_t c = 0; c < 2; ++c) at[c] += h * v[c];
    law.accept(i * h, at.data(), v.data(), x.data());
  }
  f = forces(law, 0, at, v, x);
  EXPECT_NEAR(f[0], -W, 1e-6 * W);
  EXPECT_NEAR(f[1], -T, 1e-6 * T);
  expectTangents(law, at, v, x, 1e-7, 1e-5);
}

/// A step of U under steady rotation: the blade cuts deeper until the blades behind it meet the
/// deeper surface, a pitch later.
TEST(RegenerativeCutting, MeetsTheSurfaceOfTheBladeBefore) {
  auto p = bit();
  p.wearFlat = 0;
  const RegenerativeCutting cutting(p);
  const FormulaLaw<RegenerativeCutting> law(cutting, 1);
  const std::vector<double> v{0.0, 10.0};
  std::vector<double> d{0.0, 0.0}, x(static_cast<std::size_t>(law.states()));
  law.initialState(0, d.data(), v.data(), x.data());
  const double h = 1e-3;
  const double stiffness = 3 * 0.1 * 0.6 * 50e6;
  d[0] = 1e-3;
  for (int i = 1; i < 500; ++i) {
    d[1] = i * h * v[1];
    const double W = -forces(law, 0, d, v, x)[0];
    const double phi = d[1];
    if (phi < 0.98 * cutting.pitch()) {
      EXPECT_NEAR(W, stiffness * 1e-3, 1e-9 * stiffness) << phi;
    } else if (phi > 1.02 * cutting.pitch()) {
      EXPECT_NEAR(W, 0.0, 1e-9 * stiffness) << phi;
    }
    law.accept(i * h, d.data(), v.data(), x.data());
  }
}

/// A bit off bottom does not cut and does not change the surface; a bit that turns backward does
/// not cut, a sticking bit does.
TEST(RegenerativeCutting, CutsNothingOffBottomOrBackward) {
  auto p = bit();
  p.wearFlat = 0;
  const FormulaLaw<RegenerativeCutting> law(RegenerativeCutting(p), 1);
  const std::vector<double> v{0.0, 10.0};
  std::vector<double> d{0.0, 0.0}, x(static_cast<std::size_t>(law.states()));
  law.initialState(0, d.data(), v.data(), x.data());
  const double h = 1e-3;
  d[0] = -2e-3;
  for (int i = 1; i < 900; ++i) {
    d[1] = i * h * v[1];
    EXPECT_EQ(forces(law, 0, d, v, x)[0], 0.0);
    law.accept(i * h, d.data(), v.data(), x.data());
  }
  d[0] = 1e-3;  // the bottom is still where it was
  const double stiffness = 3 * 0.1 * 0.6 * 50e6;
  EXPECT_NEAR(forces(law, 0, d, v, x)[0], -stiffness * 1e-3, 1e-9 * stiffness);
  EXPECT_EQ(forces(law, 0, d, {0.0, -1.0}, x)[0], 0.0);
  EXPECT_EQ(forces(law, 0, d, {0.0, -1.0}, x)[1], 0.0);
  EXPECT_NEAR(forces(law, 0, d, {0.0, 0.0}, x)[0], -stiffness * 1e-3, 1e-9 * stiffness);
}

/// A bit that advances steadily while its rotary speed oscillates between both signs removes the
/// rock above its path once: the depth summed over forward angles equals the rock removed on a grid
/// over the angle.
TEST(RegenerativeCutting, CutsNoRockTwiceOnItsWayForwardAgain) {
  auto p = bit();
  p.wearFlat = 0;
  p.samples = 1024;
  const RegenerativeCutting cutting(p);
  const FormulaLaw<RegenerativeCutting> law(cutting, 1);
  const double mean = 3, swing = 6, omega = 2 * constants::twoPi, V = 3e-3, h = 1e-4;
  const int cells = 8192;
  std::vector<double> bottom(cells, 0.0);
  const double cell = cutting.pitch() / cells;
  std::vector<double> d{0.0, 0.0}, x(static_cast<std::size_t>(law.states()));
  law.initialState(0, d.data(), std::vector<double>{0.0, 0.0}.data(), x.data());
  double cut = 0, lost = 0;
  for (int i = 1; i <= 60000; ++i) {
    const double t = i * h, before = d[1];
    const std::vector<double> v{V, mean + swing * std::sin(omega * t)};
    d = {V * t, mean * t + swing / omega * (1 - std::cos(omega * t))};
    const double depth = -forces(law, t, d, v, x)[0] / (3 * 0.1 * 0.6 * 50e6);
    law.accept(t, d.data(), v.data(), x.data());
    if (d[1] <= before) continue;
    cut += depth * (d[1] - before);
    for (auto k = std::lround(std::floor(before / cell)) + 1; k * cell <= d[1]; ++k) {
      double& b = bottom[static_cast<std::size_t>(k % cells)];
      if (d[0] > b) lost += (d[0] - b) * cell, b = d[0];
    }
  }
  EXPECT_NEAR(cut, lost, 0.01 * lost);
}

TEST(RegenerativeCutting, RefusesStepsLongerThanAPitch) {
  const FormulaLaw<RegenerativeCutting> law(RegenerativeCutting(bit()), 1);
  const std::vector<double> v{0.0, 10.0};
  std::vector<double> d{0.0, 0.0}, x(static_cast<std::size_t>(law.states()));
  law.initialState(0, d.data(), v.data(), x.data());
  d[1] = 2.2;
  EXPECT_THROW(forces(law, 0, d, v, x), ConvergenceError);
}

/// Between samples with inconsistent rates the limited cubic stays between their values.
TEST(DelayLine, MonotoneShapeDoesNotOvershoot) {
  for (const auto shape : {DelayLine::Shape::Cubic, DelayLine::Shape::Monotone}) {
    const DelayLine line(1, 1.0, 12, shape);
    std::vector<double> memory(static_cast<std::size_t>(line.states()));
    const double zero = 0, full = 1, steep = 40;
    line.start(0, &zero, memory.data());
    line.append(0.5, &zero, &zero, memory.data());
    line.append(1.0, &full, &steep, memory.data());
    double lowest = 0;
    for (int i = 0; i <= 100; ++i) {
      double y = 0;
      line.at(0.01 * i, memory.data(), &y);
      lowest = std::min(lowest, y);
    }
    if (shape == DelayLine::Shape::Monotone) {
      EXPECT_GE(lowest, 0.0);
    } else {
      EXPECT_LT(lowest, -1.0);
    }
  }
}

TEST(DelayLine, StartsInSteadyMotion) {
  const DelayLine line(1, 2.0, 12);
  std::vector<double> memory(static_cast<std::size_t>(line.states()));
  const double y = 5, rate = -3;
  line.start(1.0, &y, &rate, memory.data());
  for (const double t : {-0.9, 0.0, 0.99}) {
    double then = 0, slope = 0;
    line.at(t, memory.data(), &then, &slope);
    EXPECT_NEAR(then, 5 - 3 * (t - 1.0), 1e-12);
    EXPECT_NEAR(slope, -3, 1e-12);
  }
}

}  // namespace RegenerativeCuttingTest
