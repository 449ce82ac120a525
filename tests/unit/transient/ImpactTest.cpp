// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rebounds: a mass that falls on a wall far too stiff for the step rebounds according to the law,
/// for every step, spectral radius and time within a step; resting contact needs no short steps.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>
#include <tuple>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "model/laws/Connectors.hpp"
#include "transient/contact/ImpactResolution.hpp"

namespace tooljoint::transient::testing {
namespace ImpactTest {

constexpr double mass = 3, gravity = 9.81, drop = 0.02;

/// Masses, one or many, that fall from `drop` and some more on a floor.
model::SecondOrderModel fallingMass(double k, double c, double more, int count = 1) {
  auto model =
      denseModel(mass * Matrix::Identity(count, count), Matrix(), Matrix::Zero(count, count));
  model.loads.push_back({"weight", Vector::Constant(count, -mass * gravity), 0});
  model.initialDisplacement.setConstant(drop + more);
  addFloor(model, k, c, 7e11);
  return model;
}

/// Height of the first apex over that of the drop, from the energy in free flight at 0.08 s.
double apex(const model::SecondOrderModel& model, const TransientOptions& o) {
  Keep samples;
  integrate(model, o, samples);
  const double q = samples.q.back()[0], v = samples.v.back()[0];
  EXPECT_GT(q, 0.0);
  EXPECT_GT(v * v, 0.0);
  return (q + v * v / (2 * gravity)) / model.initialDisplacement[0];
}

class Rebound : public ::testing::TestWithParam<std::tuple<double, double>> {};

TEST_P(Rebound, IsThatOfAnElasticWall) {
  const auto [h, radius] = GetParam();
  for (double k : {1e7, 1e9, 1e11})
    for (int phase = 0; phase < 5; ++phase) {
      auto o = options("Generalized-alpha", 0.08, h, 0.08);
      o.own.set("Spectral Radius", radius);
      // the fall takes 64 ms: half a step of 5 ms is 2.4 mm more
      const double more = phase * 0.2 * h * std::sqrt(2 * gravity * drop);
      EXPECT_NEAR(apex(fallingMass(k, 0, more), o), 1.0, 0.02) << k << " " << phase;
    }
}

/// Each mass has a fortieth of the energy, and all of them misplace energy together.
TEST_P(Rebound, OfManyMassesAtOnceIsThatOfOne) {
  const auto [h, radius] = GetParam();
  for (double k : {1e7, 1e9, 1e11}) {
    auto o = options("Generalized-alpha", 0.08, h, 0.08);
    o.own.set("Spectral Radius", radius);
    EXPECT_NEAR(apex(fallingMass(k, 0, 0, 40), o), 1.0, 0.02) << k;
  }
}

/// Most of the energy belongs to a body of 16,000 times the mass that vibrates with 0.2 m/s without
/// contact; the allowed loss of the light mass is the same.
TEST_P(Rebound, IsThatOfTheWallBesideAHeavyBodyThatMoves) {
  const auto [h, radius] = GetParam();
  const double heavy = 16000 * mass, w = 2 * constants::pi * 9.0;
  for (double k : {1e7, 1e9, 1e11}) {
    auto model = denseModel(Eigen::Vector2d(mass, heavy).asDiagonal(), Matrix(),
                            Eigen::Vector2d(0.0, heavy * w * w).asDiagonal());
    model.loads.push_back({"weight", Eigen::Vector2d(-mass * gravity, 0.0), 0});
    model.initialDisplacement = Eigen::Vector2d(drop, 0.004);
    addFloor(model, k, 0, 7e11);
    model.points[0].offset[1] = 1.0;
    auto o = options("Generalized-alpha", 0.08, h, 0.08);
    o.own.set("Spectral Radius", radius);
    EXPECT_NEAR(apex(model, o), 1.0, 0.02) << k;
  }
}

/// A body of the same mass swings with 2.5 m/s without contact: the slower fall, 0.14 m/s, is
/// resolved as it would be alone.
TEST_P(Rebound, IsThatOfTheWallBesideABodyThatIsFaster) {
  const auto [h, radius] = GetParam();
  const double fast = 2 * constants::pi * 8.0, low = 0.001;
  for (double k : {1e7, 1e9, 1e11}) {
    auto model = denseModel(mass * Matrix::Identity(2, 2), Matrix(),
                            Eigen::Vector2d(0.0, mass * fast * fast).asDiagonal());
    model.loads.push_back({"weight", Eigen::Vector2d(-mass * gravity, 0.0), 0});
    model.initialDisplacement = Eigen::Vector2d(low, 0.05);
    addFloor(model, k, 0, 7e11);
    model.points[0].offset[1] = 1.0;
    auto o = options("Generalized-alpha", 0.02, std::min(h, 1e-3), 0.02);
    o.own.set("Spectral Radius", radius);
    EXPECT_NEAR(apex(model, o), 1.0, 0.03) << k;
  }
}

/// The local error is that of a smooth motion; impacts shorten the steps further.
TEST_P(Rebound, IsThatOfTheWallInStepsChosenByTheirError) {
  const auto [h, radius] = GetParam();
  for (double k : {1e7, 1e9}) {
    auto o = options("Generalized-alpha", 0.08, h, 0.08);
    o.own.set("Spectral Radius", radius);
    o.own.set("Step Tolerance", 1e-5);
    EXPECT_NEAR(apex(fallingMass(k, 0, 0), o), 1.0, 0.02) << k;
  }
}

/// k and c for a restitution of e = 0.5, for a spring and a dashpot that only push: approximately
/// zeta = -ln(e) / sqrt(pi^2 + ln(e)^2). The reference is a run with steps of 0.1 us.
TEST_P(Rebound, IsThatOfALossyWall) {
  const auto [h, radius] = GetParam();
  for (double zeta : {0.05, 0.2, 0.35}) {
    const double k = 1e9, c = 2 * zeta * std::sqrt(k * mass);
    const double truth = apex(fallingMass(k, c, 0), options("RK4", 0.08, 5e-7, 0.08));
    auto o = options("Generalized-alpha", 0.08, h, 0.08);
    o.own.set("Spectral Radius", radius);
    EXPECT_NEAR(apex(fallingMass(k, c, 0), o), truth, 0.02) << zeta;
  }
}

/// P(v) = v / chi - ln(1 + chi v) / chi^2 is the same before and after, from m v dv/dg = -k g (1 +
/// chi v): chi of the restitution e by bisection of x = chi v.
double dissipation(double e, double speed) {
  const auto part = [](double x) { return x - std::log1p(x); };
  double low = 1e-9, high = 0.999 / e;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.5 * (low + high);
    (part(x) > part(-e * x) ? low : high) = x;
  }
  return low / speed;
}

/// Damping that grows with the depth needs no shorter steps than the spring, wherever in the wall
/// the step of the impact ends.
TEST_P(Rebound, IsThatOfTheLawOfHuntAndCrossley) {
  const auto [h, radius] = GetParam();
  const double e = 0.4;
  for (double k : {5e8, 1e11})
    for (double more : {0.0, 0.25}) {
      auto model = fallingMass(k, 0, more * h * std::sqrt(2 * gravity * drop));
      const double speed = std::sqrt(2 * gravity * model.initialDisplacement[0]);
      model::StopParameters stop;
      stop.stiffness = k;
      stop.damping = dissipation(e, speed);
      model.points[0].law = model::stops({stop});
      auto o = options("Generalized-alpha", 0.08, h, 0.08);
      o.own.set("Spectral Radius", radius);
      EXPECT_NEAR(apex(model, o), e * e, 0.02) << k << " " << more;
    }
}

/// Walls whose force of the step corresponds to a depth of 1e-11 m, less than the tolerance of
/// positions: the step may end outside the wall although the force acted.
TEST(Impacts, AreSeenWhereTheStepEndsBesideTheWall) {
  for (double k : {3e12, 5e13, 3e14})
    for (int i = 0; i < 20; ++i) {
      auto model = fallingMass(k, 0, 0);
      model::StopParameters stop;
      stop.stiffness = k;
      model.points[0].law = model::stops({stop});
      auto o = options("Generalized-alpha", 0.08, (3.0 + 0.01 * i) * 1e-3, 0.08);
      o.own.set("Spectral Radius", 0.65);
      EXPECT_NEAR(apex(model, o), 1.0, 0.02) << k << " " << i;
    }
}

INSTANTIATE_TEST_SUITE_P(Steps, Rebound,
                         ::testing::Combine(::testing::Values(1e-4, 1e-3, 5e-3),
                                            ::testing::Values(0.0, 0.2, 0.5, 0.8, 1.0)));

/// One step and two halves of it can agree on a rebound that both miss.
TEST(Impacts, KeepTheirReboundInAdaptiveStepsOfRungeKutta) {
  for (double k : {1e7, 1e8, 1e9 / 3, 1e9, 1e11})
    for (int phase = 0; phase < 10; ++phase)
      EXPECT_NEAR(apex(fallingMass(k, 0, phase * 5e-5), options("RK4 adaptive", 0.08, 0, 0.08)),
                  1.0, 0.02)
          << k << " " << phase;
}

/// The mean energy loss of unresolved rebounds, over all times of the impact within a step, against
/// reboundLoss(), which decides on halvings.
TEST(Impacts, UnresolvedReboundsLoseWhatTheFitSays) {
  for (double radius : {0.0, 0.2, 0.5, 0.8})
    for (double wh : {0.15, 0.3, 0.5, 0.8, 1.0, 1.2}) {
      constexpr double h = 1e-4;
      constexpr int phases = 40;
      auto o = options("Generalized-alpha", 0.08, h, 0.08);
      o.own.set("Spectral Radius", radius);
      o.own.set("Resolve Impacts", false);
      acceptCoarseSteps(o);
      o.ledger = false;
      double lost = 0;
      for (int i = 0; i < phases; ++i)
        lost += 1 - apex(fallingMass(mass * std::pow(wh / h, 2), 0,
                                     (i + 0.5) / phases * h * std::sqrt(2 * gravity * drop)),
                         o);
      lost /= phases;
      const double fit = reboundLoss(wh, radius);
      EXPECT_NEAR(lost, fit, std::max(0.2 * fit, 0.03)) << radius << " " << wh;
    }
}

/// Once a mass rests on a stiff wall, a slow change of its load needs no short steps.
TEST(Impacts, AtRestStepsAreLongAgain) {
  auto model = fallingMass(1e10, 1e5, 0);
  const int law = model.lawIndex({"breath", [](double t) { return std::sin(20 * t); }});
  model.loads.push_back({"breath", Vector::Constant(1, 0.5 * mass * gravity), law});
  Keep samples;
  const auto first = integrate(model, options("Generalized-alpha", 2.0, 1e-3, 0.1), samples);
  const auto longer = integrate(model, options("Generalized-alpha", 4.0, 1e-3, 0.1), samples);
  EXPECT_LE(longer.counters.steps - first.counters.steps, 2100);
}

/// The step continues from the state at which its points were evaluated, wherever the impact was
/// examined.
TEST(Impacts, ALookLeavesThePointWhereItWas) {
  auto ball = denseModel(Matrix::Identity(1, 1), Matrix(), Matrix::Zero(1, 1));
  model::PointSet set;
  set.name = "wall";
  set.law = std::make_shared<Floor>(1, 1e9, 1e3, 7e11);
  set.rows.resize(1, 1);
  set.rows.insert(0, 0) = 1;
  set.offset = Vector::Zero(1);
  set.entities = {1};
  ball.points.push_back(set);
  CompiledModel model(ball);
  MassFactor factor(model);
  factor.invert(model);
  ImpactResolution impacts;
  impacts.bind(model, factor, 0.8);
  State from, to;
  for (State* each : {&from, &to}) {
    each->resize(1, 0);
    each->q.setConstant(1e-4), each->v.setConstant(-1), each->a.setZero();
  }
  to.t = 1e-3, to.q.setConstant(-1e-5);
  auto& batch = model.points().front();
  batch.look(to.t, 0.0, to.q.data());
  batch.evaluateWithTangent(to.t, to.q.data(), to.v.data());
  const double d = batch.d()[0], v = batch.v()[0], f = batch.force()[0];
  ASSERT_GT(f, 0);
  EXPECT_GT(impacts.halvings(from, to, 1e-3), 0);
  EXPECT_EQ(batch.d()[0], d);
  EXPECT_EQ(batch.v()[0], v);
  EXPECT_EQ(batch.force()[0], f);
}

/// St. Venant's bar: n springs in a row, of mass m and stiffness k each, fly at unit speed against
/// a wall a hundred times as stiff as a spring. A wave takes sqrt(m/k) per spring.
constexpr int springs = 50;
constexpr double perSpring = 1e-4;  ///< [s]
constexpr double contactTime = 2 * springs * perSpring;
constexpr double start = 0.01 * contactTime;  ///< of the contact [s]

model::SecondOrderModel flyingBar() {
  constexpr double m = 1, k = m / (perSpring * perSpring);
  constexpr int n = springs + 1;
  Matrix M = m * Matrix::Identity(n, n), K = Matrix::Zero(n, n);
  M(0, 0) = M(n - 1, n - 1) = 0.5 * m;
  for (int i = 1; i < n; ++i) {
    K(i, i) += k, K(i - 1, i - 1) += k;
    K(i, i - 1) -= k, K(i - 1, i) -= k;
  }
  auto bar = denseModel(M, Matrix(), K);
  bar.initialVelocity.setConstant(-1.0);
  model::PointSet set;
  set.name = "wall";
  set.law = std::make_shared<Floor>(1, 100 * k, 0.0, 7e11);
  set.rows.resize(1, n);
  set.rows.insert(0, 0) = 1;
  set.offset = Vector::Constant(1, start);
  set.entities = {1};
  bar.points.push_back(set);
  return bar;
}

/// Velocity of the centre of mass at the samples.
std::vector<double> centre(const model::SecondOrderModel& bar, const TransientOptions& o) {
  Keep samples;
  integrate(bar, o, samples);
  const Vector weights = Matrix(bar.mass).diagonal();
  std::vector<double> speed;
  for (const auto& v : samples.v) speed.push_back(weights.dot(v) / weights.sum());
  return speed;
}

/// Contact lasts 2 L / c, in which the momentum changes linearly from -1 to 1. In a bar of springs
/// the wave front spreads over some springs; the reference is RK4 in fine steps. With such a stiff
/// wall rounding decides in which step a short bounce ends: the largest error is 0.017 in one build
/// and 0.021 in another.
TEST(Impacts, ABarRebounds) {
  const auto bar = flyingBar();
  const double interval = 0.1 * contactTime, end = 1.4 * contactTime;
  const auto truth = centre(bar, options("RK4", end, 1e-2 * perSpring, interval));
  const auto line = [&](double t) {
    return std::clamp(2 * (t - start) / contactTime - 1, -1., 1.);
  };
  for (std::size_t i = 0; i < truth.size(); ++i)
    EXPECT_NEAR(truth[i], line(static_cast<double>(i) * interval), 0.05) << i;
  for (double radius : {0.2, 0.8, 1.0})
    for (double h : {0.5 * perSpring, perSpring}) {
      auto o = options("Generalized-alpha", end, h, interval);
      o.own.set("Spectral Radius", radius);
      acceptCoarseSteps(o);  // the wave front is a jump
      const auto found = centre(bar, o);
      for (std::size_t i = 0; i < truth.size(); ++i)
        EXPECT_NEAR(found[i], truth[i], 0.025) << radius << " " << h << " " << i;
    }
}

/// A hard spring on a dof without mass is no impact: the dof stays in equilibrium.
TEST(Impacts, ADofWithoutMassStaysInBalance) {
  Matrix M = Matrix::Zero(2, 2), K(2, 2);
  M(0, 0) = 2;
  K << 900, -800, -800, 800;
  const double linear = 100, cubic = 5e4;
  auto model = denseModel(M, scalar(0.0), K);
  model.damping.clear();
  Vector load = Vector::Zero(2);
  load[0] = 40;
  model.loads.push_back(
      {"push", load, model.lawIndex({"sine", [](double t) { return std::sin(10 * t); }})});
  model::PointSet set;
  set.name = "spring";
  set.law = model::springs({{linear, cubic, 0.0}});
  set.rows.resize(1, 2);
  set.rows.insert(0, 1) = 1.0;
  set.offset = Vector::Zero(1);
  set.entities = {2};
  model.points.push_back(set);
  for (double radius : {0.3, 0.8, 1.0}) {
    auto o = options("Generalized-alpha", 2, 1e-3, 0.01);
    o.own.set("Spectral Radius", radius);
    Keep samples;
    integrate(model, o, samples);
    for (const auto& q : samples.q)
      EXPECT_NEAR(800 * (q[0] - q[1]), linear * q[1] + cubic * q[1] * q[1] * q[1], 1e-3) << radius;
  }
}

/// A mass on a spring starts pressed 1 mm into a wall, which ejects it within the first steps: the
/// strain energy of the wall, k d^2 / 2, becomes that of the spring at the apex.
TEST(Impacts, ContactThatIsClosedAtTheStartOpens) {
  const double pressed = 1e-3, spring = 400;
  for (double k : {1e5, 1e6, 3e6, 1e7, 1e9})
    for (double radius : {0.2, 0.8, 1.0}) {
      auto model = oscillator(1.0, 0.0, spring, 0.0, 0.0);
      model::PointSet set;
      set.name = "stop";
      model::StopParameters stop;
      stop.gap = -pressed;
      stop.stiffness = k;
      set.law = model::stops({stop});
      set.rows.resize(1, 1);
      set.rows.insert(0, 0) = 1.0;
      set.offset = Vector::Zero(1);
      set.entities = {1};
      model.points.push_back(set);
      auto o = options("Generalized-alpha", 0.1, 1e-3, 1e-3);
      o.own.set("Spectral Radius", radius);
      Keep samples;
      integrate(model, o, samples);
      double apex = 0;
      for (const auto& q : samples.q) apex = std::max(apex, q[0]);
      EXPECT_NEAR(apex / std::sqrt(k * pressed * pressed / spring), 1.0, 0.02)
          << k << " " << radius;
    }
}

}  // namespace ImpactTest
}  // namespace tooljoint::transient::testing
