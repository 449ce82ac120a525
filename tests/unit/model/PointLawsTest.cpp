// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Registered laws with states and the delay line: tangents against differences, powers against the
/// work of the force, stored samples against their function.
#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "model/laws/DelayLine.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace PointLawsTest {

using namespace tooljoint;
using namespace tooljoint::model;

std::shared_ptr<const PointLaw> maxwell() {
  Teuchos::ParameterList own;
  own.set("Stiffness", 300.0).set("Damping", 20.0);
  return PointLawRegistry::instance().make("Maxwell", own, {2, 1});
}

std::shared_ptr<const PointLaw> elasticPlastic() {
  Teuchos::ParameterList own;
  own.set("Stiffness", 300.0).set("Yield Force", 2.0);
  return PointLawRegistry::instance().make("Elastic-Plastic", own, {2, 1});
}

const std::vector<int> both{0, 1};
const std::vector<double> d{0.004, -0.03}, v{0.2, 0.7}, x{0.001, 0.002};

TEST(StatefulLaws, TangentsAreTheDerivatives) {
  for (const auto& law : {maxwell(), elasticPlastic()}) {
    const auto& with = *stateful(*law);
    const auto n = static_cast<std::size_t>(2 * with.rated());
    std::vector<double> f(2), g(n), fd(2), fv(2), fx(n), gd(n), gv(n), gx(n);
    with.forcesWithTangents(0, both, d.data(), v.data(), x.data(), f.data(), g.data(),
                            {fd.data(), fv.data(), fx.data(), gd.data(), gv.data(), gx.data()});
    const auto difference = [&](std::vector<double> dd, std::vector<double> dv,
                                std::vector<double> dx, std::vector<double>& df,
                                std::vector<double>& dg) {
      constexpr double step = 1e-6;
      std::vector<double> plus(2), minus(2), gPlus(n), gMinus(n);
      for (const double way : {1.0, -1.0}) {
        auto at = d, speed = v, state = x;
        for (std::size_t p = 0; p < 2; ++p)
          at[p] += way * step * dd[p], speed[p] += way * step * dv[p],
              state[p] += way * step * dx[p];
        with.forces(0, both, at.data(), speed.data(), state.data(),
                    way > 0 ? plus.data() : minus.data(), way > 0 ? gPlus.data() : gMinus.data());
      }
      df = plus, dg = gPlus;
      for (std::size_t i = 0; i < 2; ++i) df[i] = (plus[i] - minus[i]) / (2 * step);
      for (std::size_t i = 0; i < n; ++i) dg[i] = (gPlus[i] - gMinus[i]) / (2 * step);
    };
    const auto expectNear = [](const std::vector<double>& a, const std::vector<double>& b) {
      ASSERT_EQ(a.size(), b.size());
      for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(a[i], b[i], 1e-6 + 1e-7 * 300);
    };
    std::vector<double> df, dg;
    difference({1, 1}, {0, 0}, {0, 0}, df, dg);
    expectNear(fd, df), expectNear(gd, dg);
    difference({0, 0}, {1, 1}, {0, 0}, df, dg);
    expectNear(fv, df), expectNear(gv, dg);
    if (with.rated() == 0) continue;
    difference({0, 0}, {0, 0}, {1, 1}, df, dg);
    expectNear(fx, df), expectNear(gx, dg);
  }
}

/// d(stored)/dt + losses = -f v for the rates of the law.
TEST(StatefulLaws, MaxwellBalancesItsPowers) {
  const auto law = maxwell();
  const auto& with = *stateful(*law);
  std::vector<double> f(2), g(2);
  with.forces(0, both, d.data(), v.data(), x.data(), f.data(), g.data());
  const auto now = with.powers(0, both, d.data(), v.data(), x.data(), g.data());
  constexpr double h = 1e-7;
  auto later = d, state = x;
  for (std::size_t p = 0; p < 2; ++p) later[p] += h * v[p], state[p] += h * g[p];
  const double change =
      (with.powers(0, both, later.data(), v.data(), state.data(), g.data()).stored - now.stored) /
      h;
  EXPECT_GT(now.damping, 0.1);
  EXPECT_NEAR(change + now.damping, -(f[0] * v[0] + f[1] * v[1]), 1e-4);
}

TEST(StatefulLaws, ElasticPlasticYieldsAtItsForceAndKeepsTheSlip) {
  const auto law = elasticPlastic();
  const auto& with = *stateful(*law);
  std::vector<double> f(2), state = x;
  with.forces(0, both, d.data(), v.data(), x.data(), f.data(), nullptr);
  EXPECT_DOUBLE_EQ(f[0], -300.0 * 0.003);
  EXPECT_DOUBLE_EQ(f[1], 2.0);
  with.accept(0, d.data(), v.data(), state.data());
  EXPECT_DOUBLE_EQ(state[0], 0.001);
  EXPECT_DOUBLE_EQ(state[1], -0.03 + 2.0 / 300.0);
}

/// Set-up code evaluates a law in its initial state.
TEST(StatefulLaws, StartRelaxed) {
  std::vector<double> f(2, 1.0);
  for (const auto& law : {maxwell(), elasticPlastic()}) {
    law->evaluate(0, both, d.data(), v.data(), f.data());
    EXPECT_EQ(f, (std::vector<double>{0.0, 0.0}));
    EXPECT_EQ(stateSize(*law), 2);
    EXPECT_EQ(law->subset({1})->size(), 1);
  }
}

TEST(DelayLine, GivesTheCubicBetweenSamples) {
  const DelayLine line(2, 0.2, 12);  // samples at least 0.02 s apart
  std::vector<double> memory(static_cast<std::size_t>(line.states()));
  const auto y = [](double t) { return std::array<double, 2>{std::sin(7 * t), std::cos(5 * t)}; };
  const auto rate = [](double t) {
    return std::array<double, 2>{7 * std::cos(7 * t), -5 * std::sin(5 * t)};
  };
  line.start(0.0, y(0).data(), memory.data());
  for (int i = 1; i <= 1000; ++i)
    line.append(1e-3 * i, y(1e-3 * i).data(), rate(1e-3 * i).data(), memory.data());
  std::array<double, 2> then{}, slope{};
  for (double t = 0.8; t <= 1.0; t += 0.0037) {
    line.at(t, memory.data(), then.data(), slope.data());
    // (0.02 s)^4 7^4 / 384 = 1e-6 for the values
    for (std::size_t i = 0; i < 2; ++i) {
      EXPECT_NEAR(then[i], y(t)[i], 1.1e-6);
      EXPECT_NEAR(slope[i], rate(t)[i], 5e-4);
    }
  }
  EXPECT_THROW(line.at(1.0001, memory.data(), then.data()), ConvergenceError);
  EXPECT_THROW(line.at(0.7, memory.data(), then.data()), ModelError);
  EXPECT_THROW(DelayLine(1, 0.0, 12), ModelError);
}

TEST(DelayLine, IsAtRestBeforeTheStart) {
  const DelayLine line(1, 0.2, 12);
  std::vector<double> memory(static_cast<std::size_t>(line.states()));
  const double start = 3.0, later = 4.0, speed = 10.0;
  line.start(1.0, &start, memory.data());
  line.append(1.1, &later, &speed, memory.data());
  double then = 0;
  line.at(0.5, memory.data(), &then);
  EXPECT_EQ(then, 3.0);
  line.at(1.1, memory.data(), &then);
  EXPECT_EQ(then, 4.0);
}

}  // namespace PointLawsTest
