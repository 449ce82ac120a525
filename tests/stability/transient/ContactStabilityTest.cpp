// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Generalized-alpha in cases difficult for Newton's method: sharp contact, sharp friction, stiff
/// walls, no clearance, all together. An unconverged step is never kept silently, and every result
/// is right.
#include <gtest/gtest.h>

#include "../../unit/transient/Models.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace tooljoint::transient::testing {
namespace ContactStabilityTest {

struct Bores {
  int nodes = 20;
  double clearance = 0.01;
  double stiffness = 1e7;
  double damping = 1e4;
  double lambda = 7e11;
  double muStatic = 0.2;
  double muDynamic = 0.1;
  double vr = 0.1;
  double lift = 1.0;  ///< how much of the clearance the nodes are placed off the axis
  std::string law = "Nguyen";
  std::function<double(double)> speed = [](double) { return 12.57; };
};

/// A chain of rotors (u, v, theta_z) under gravity, each in a bore with friction. The first four
/// natural frequencies are 3 to 20 Hz laterally, the stiffness between neighbours resembles that of
/// pipe elements.
model::SecondOrderModel rotors(const Bores& data) {
  const int n = 3 * data.nodes;
  Matrix M = Matrix::Zero(n, n), K = M, C = M;
  for (int i = 0; i < data.nodes; ++i)
    for (int a = 0; a < 3; ++a) {
      const double mass = a < 2 ? 20.0 : 0.1, link = a < 2 ? 1e6 : 2e4;
      const int here = 3 * i + a;
      M(here, here) = mass;
      C(here, here) = 0.03 * mass;
      K(here, here) += link;
      if (i == 0) continue;
      K(here - 3, here - 3) += link;
      K(here, here - 3) -= link, K(here - 3, here) -= link;
    }
  auto model = denseModel(M, C, K, 3);
  model.componentNames = {"u", "v", "theta_z"};
  Vector weight = Vector::Zero(n);
  for (int i = 0; i < data.nodes; ++i) {
    weight[3 * i] = 20 * 9.81;
    model.initialDisplacement[3 * i] = 0.7 * data.lift * data.clearance * std::cos(1.1 * i);
    model.initialDisplacement[3 * i + 1] = 0.7 * data.lift * data.clearance * std::sin(1.7 * i);
  }
  model.loads.push_back({"weight", weight, 0});
  contact::ContactPoints points;
  for (int i = 0; i < data.nodes; ++i)
    points.add({i + 1, data.clearance, 0.1, data.stiffness, data.damping, data.lambda, data.lambda,
                data.muStatic, data.muDynamic, data.vr});
  model::PointSet set;
  set.name = "contact";
  set.law = contact::makeLaw(data.law)->inMotion(points, data.speed);
  set.rows.resize(n, n);
  set.rows.setIdentity();
  set.offset = Vector::Zero(n);
  for (int i = 0; i < data.nodes; ++i) set.entities.push_back(i + 1);
  model.points.push_back(set);
  return model;
}

/// Runs 0.5 s at 1 ms; a step that is left unconverged throws.
TransientReport run(const Bores& data, Keep& samples, double step = 1e-3, double end = 0.5) {
  return integrate(rotors(data), options("Generalized-alpha", end, step, 0.005), samples);
}

/// No node deeper in the wall than this.
void expectInside(const Keep& samples, double radius) {
  for (const auto& q : samples.q)
    for (int i = 0; i < q.size(); i += 3) ASSERT_LT(std::hypot(q[i], q[i + 1]), radius);
}

TEST(ContactStability, everyRegularisation) {
  for (double lambda : {1e6, 1e8, 1e10, 7e11}) {
    Bores data;
    data.lambda = lambda;
    Keep samples;
    const auto report = run(data, samples);
    EXPECT_LE(report.counters.halved, 25) << lambda;
    expectInside(samples, 0.02);
  }
}

TEST(ContactStability, sharpRegularisationsGiveOneMotion) {
  std::vector<Keep> samples(2);
  Bores data;
  data.vr = 0.5;
  data.lambda = 1e8;
  run(data, samples[0], 2e-4, 0.1);
  data.lambda = 7e11;
  run(data, samples[1], 2e-4, 0.1);
  for (std::size_t s = 0; s < samples[0].q.size(); ++s)
    EXPECT_LT((samples[0].q[s] - samples[1].q[s]).cwiseAbs().maxCoeff(),
              5e-4);  // 5 % of the clearance, after ten impacts
}

TEST(ContactStability, sharpFrictionAtOneRpm) {
  for (double vr : {1e-2, 1e-3, 1e-4}) {
    Bores data;
    data.vr = vr;
    data.speed = [](double) { return 2 * constants::pi / 60; };
    Keep samples;
    const auto report = run(data, samples);
    EXPECT_EQ(report.counters.unconvergedSteps, 0);
    expectInside(samples, 0.02);
  }
}

TEST(ContactStability, spinReversal) {
  Bores data;
  data.vr = 1e-3;
  data.speed = [](double t) { return 3.0 * std::cos(2 * constants::pi * t / 0.2); };
  Keep samples;
  EXPECT_EQ(run(data, samples).counters.unconvergedSteps, 0);
  expectInside(samples, 0.02);
}

/// Starts that differ by some per cent: the order of impacts differs, and the assertions must hold
/// for all.
constexpr double lifts[] = {1.0, 0.97, 1.03, 0.9};

/// Contact frequencies of 1 to 11 rad per step, resolved by shorter steps: no energy is generated
/// with strong numerical damping. Between impacts steps of 1 ms are too long for the vibration
/// after rebounds.
TEST(ContactStability, stiffWalls) {
  for (double stiffness : {1e8, 1e9, 1e10}) {
    Bores data;
    data.stiffness = stiffness;
    Keep samples;
    auto o = options("Generalized-alpha", 0.5, 5e-4, 0.005);
    o.own.set("Spectral Radius", 0.2);
    const auto report = integrate(rotors(data), o, samples);
    EXPECT_EQ(report.counters.unconvergedSteps, 0) << stiffness;
    EXPECT_GT(report.energy.residual(), -0.05) << stiffness;
    expectInside(samples, 0.011);
  }
}

/// With the default damping 3 to 4 % of the energy exchanged are lost in impacts, whatever the wall
/// and the start. Steps of 1 ms are refused with a stiff wall: step error 150 %.
TEST(ContactStability, wallsTooStiffForTheStepAreBalanced) {
  for (double stiffness : {1e8, 1e9, 1e10})
    for (double lift : lifts) {
      Bores data;
      data.stiffness = stiffness;
      data.lift = lift;
      Keep samples;
      const auto report = run(data, samples, 5e-4);
      EXPECT_GT(report.energy.residual(), -0.02) << stiffness << " " << lift;
      EXPECT_LT(report.energy.residual(), 0.1) << stiffness << " " << lift;
      EXPECT_EQ(report.counters.unconvergedSteps, 0) << stiffness << " " << lift;
      expectInside(samples, 0.011);
    }
}

/// A mass on a spring that meets a wall whose contact takes 2 rad per step, too few for a force and
/// too many for an impact: each rebound adds energy, and the run is refused with advice. Shorter
/// steps give a result.
TEST(ContactStability, energyThatIsMadeIsRefused) {
  for (double start : {0.005, 0.0051, 0.006}) {
    auto model = oscillator(5.0, 0.0, 5e3, start, 0.3);
    addFloor(model, 1e5, 0, 7e11);
    Keep samples;
    try {
      auto o = options("Generalized-alpha", 14.0, 14e-3, 0.14);
      o.own.set("Resolve Impacts", false);
      integrate(model, o, samples);
      ADD_FAILURE() << "a growth of energy was accepted: " << start;
    } catch (const ConvergenceError& error) {
      EXPECT_NE(std::string(error.what()).find("without work being done"), std::string::npos)
          << error.what();
      EXPECT_NE(std::string(error.what()).find("Reduce Transient/Step"), std::string::npos)
          << error.what();
    }
    EXPECT_NEAR(
        integrate(model, options("Generalized-alpha", 14.0, 1e-3, 0.14), samples).energy.residual(),
        0.0, 0.02)
        << start;
  }
}

TEST(ContactStability, noClearance) {
  for (double vr : {0.1, 1e-2}) {
    Bores data;
    data.clearance = 0.0;
    data.vr = vr;
    Keep samples;
    EXPECT_EQ(run(data, samples).counters.unconvergedSteps, 0) << vr;
    expectInside(samples, 0.005);
  }
}

TEST(ContactStability, allContactsGainedAndLostAtOnce) {
  Bores data;
  data.lift = 0.0;  // all on the axis: all reach the wall within the same few steps
  auto model = rotors(data);
  const int law =
      model.lawIndex({"toss", [](double t) { return t > 0.15 && t < 0.2 ? 1.0 : 0.0; }});
  model.loads.push_back(
      {"toss", -40.0 * model.loads[0].vector, law});  // throws all of them off at once
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 0.5, 1e-3, 0.005), samples);
  EXPECT_EQ(report.counters.unconvergedSteps, 0);
  double lowest = 0, highest = 0;
  for (const auto& q : samples.q)
    lowest = std::max(lowest, q[30]), highest = std::min(highest, q[30]);
  EXPECT_GT(lowest, 0.01);    // it was on the floor
  EXPECT_LT(highest, -0.01);  // and at the top
}

/// The steps converge, but their accuracy is not checked: a law with as much loss as the damping of
/// another is too fast for them.
TEST(ContactStability, everyLaw) {
  for (const auto& law : contact::LawRegistry::instance().names()) {
    Bores data;
    data.law = law;
    Keep samples;
    auto o = options("Generalized-alpha", 0.5, 1e-3, 0.005);
    acceptCoarseSteps(o);
    EXPECT_EQ(integrate(rotors(data), o, samples).counters.unconvergedSteps, 0) << law;
    expectInside(samples, 0.02);
  }
}

/// Ten times the usual step, with a dozen impacts in each step: most of the motion in a step is
/// wrong, and every run is refused; a run that is told to continue solves all its steps.
TEST(ContactStability, stepTenTimesTooLarge) {
  constexpr double step = 1e-2;
  constexpr double end = 0.8;  // long enough to measure the step error in any case
  for (double vr : {0.1, 1e-4})
    for (double lift : lifts) {
      Bores data;
      data.nodes = 6;
      data.vr = vr;
      data.lift = lift;
      auto o = options("Generalized-alpha", end, step, step);
      Keep samples;
      try {
        integrate(rotors(data), o, samples);
        ADD_FAILURE() << "steps of 10 ms were taken for a result: " << vr << " " << lift;
      } catch (const ConvergenceError& error) {
        EXPECT_NE(std::string(error.what()).find("Reduce Transient/Step"), std::string::npos)
            << error.what();
      }
      if (lift != lifts[0]) continue;
      acceptCoarseSteps(o);
      Keep accepted;
      const auto report = integrate(rotors(data), o, accepted);
      EXPECT_EQ(report.counters.unconvergedSteps, 0);
      EXPECT_GT(report.stepError, 0.5) << vr << " " << lift;
      expectInside(accepted, 0.03);
    }
}

/// One rotor, friction so sharp that the plain Newton iteration cycles: the full step from one side
/// of the friction curve lands on the other, where the curve is flat again.
TEST(ContactStability, plainNewtonFailsWhereTheLineSearchDoesNot) {
  const double inertia = 0.1, torque = 50, vr = 1e-4, h = 1e-3, omega = 0.1;
  const auto friction = [&](double v) { return torque * std::tanh(v / vr); };
  const auto slope = [&](double v) { return torque / vr / std::pow(std::cosh(v / vr), 2); };
  double v = omega;
  bool converged = false;
  for (int i = 0; i < 100 && !converged; ++i) {
    const double residual = inertia * (v - omega) / h + friction(v);
    converged = std::abs(residual) < 1e-6;
    v -= residual / (inertia / h + slope(v));
  }
  EXPECT_FALSE(converged);

  Bores data;
  data.nodes = 1;
  data.vr = vr;
  data.muStatic = data.muDynamic = 0.4;
  data.speed = [](double t) { return 0.1 * std::cos(30 * t); };
  Keep samples;
  const auto report = run(data, samples);
  EXPECT_EQ(report.counters.unconvergedSteps, 0);
}

}  // namespace ContactStabilityTest
}  // namespace tooljoint::transient::testing
