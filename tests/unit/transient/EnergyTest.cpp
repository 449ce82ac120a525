// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The energy ledger: losses are booked under their cause, and a run that generates energy is
/// refused.
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "Models.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "tests/support/ErrorText.hpp"

namespace tooljoint::transient::testing {
namespace EnergyTest {

TEST(Energy, freeVibrationIsConserved) {
  const auto model = oscillator(2, 0, 800, 0.1, 1.0);
  Keep samples;
  auto o = options("RK4", 1.0, 1e-4, 0.1);
  const auto report = integrate(model, o, samples);
  ASSERT_TRUE(report.hasEnergy);
  EXPECT_NEAR(report.energy.initial, 0.5 * 800 * 0.01 + 0.5 * 2, 1e-12);
  EXPECT_NEAR(report.energy.kinetic + report.energy.strain, 5.0, 1e-8);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-9);
  o.ledger = false;
  EXPECT_FALSE(integrate(model, o, samples).hasEnergy);
}

TEST(Energy, dampingTakesWhatIsMissing) {
  const auto model = oscillator(2, 4.0, 800, 0.1, 1.0);
  for (const std::string integrator : {"Generalized-alpha", "RK4", "RK4 adaptive"}) {
    Keep samples;
    const auto report = integrate(model, options(integrator, 3.0, 5e-4, 0.1), samples);
    ASSERT_EQ(report.energy.damping.size(), 1u);
    EXPECT_EQ(report.energy.dampingNames[0], "damping");
    EXPECT_NEAR(report.energy.damping[0], 5.0 - report.energy.kinetic - report.energy.strain, 0.01)
        << integrator;
    EXPECT_LT(std::abs(report.energy.residual()), 2e-3) << integrator;
  }
}

TEST(Energy, numericalDissipationShowsAsResidual) {
  // A frequency far above the step: rho 0 removes its energy, rho 1 keeps it.
  const auto model = oscillator(1, 0, 1e8, 1e-3, 0);
  const auto lost = [&](double radius) {
    Keep samples;
    auto o = options("Generalized-alpha", 0.1, 1e-3, 0.1);
    o.own.set("Spectral Radius", radius);
    o.own.set("Phase Correction", false);  // it changes the inertia of such frequencies
    acceptCoarseSteps(o);
    const auto energy = integrate(model, o, samples).energy;
    return energy.numerical() / energy.initial;
  };
  EXPECT_NEAR(lost(0.0), 1.0, 1e-6);
  EXPECT_GT(lost(0.8), 0.9);
  EXPECT_NEAR(lost(1.0), 0.0, 1e-6);
}

TEST(Energy, loadsAndGyroscopicsAreBooked) {
  // A rotor pushed by a constant force; the gyroscopic term does no work and is not booked.
  auto model = denseModel(Matrix::Identity(2, 2), Matrix(), 100 * Matrix::Identity(2, 2), 2);
  Matrix G(2, 2);
  G << 0, 3, -3, 0;
  model.damping.push_back({"gyroscopic", G.sparseView(), 0});
  model.loads.push_back({"push", Vector::Unit(2, 0) * 7.0, 0});
  Keep samples;
  const auto report = integrate(model, options("RK4", 1.0, 1e-3, 0.1), samples);
  EXPECT_TRUE(report.energy.damping.empty());
  EXPECT_NEAR(report.energy.loads, 7.0 * samples.q.back()[0], 1e-12);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-5);
}

/// A free body under a force 6 t moves as q = t^3/2: the work of the force is its kinetic
/// energy 2.25 t^4. The work uses the mean of the force over a step; the force at its start or end
/// would give an error of 3 %.
TEST(Energy, aGrowingLoadDoesTheWorkOfItsMean) {
  auto model = oscillator(2.0, 0.0, 0.0, 0.0, 0.0);
  model.loads.push_back(
      {"growing", Vector::Constant(1, 6.0), model.lawIndex({"t", [](double t) { return t; }})});
  Keep samples;
  const auto report = integrate(model, options("RK4", 1.0, 0.01, 0.1), samples);
  EXPECT_NEAR(samples.q.back()[0], 0.5, 1e-12);
  EXPECT_NEAR(report.energy.kinetic, 2.25, 1e-10);
  EXPECT_NEAR(report.energy.loads, 2.25, 0.005);
}

TEST(Energy, skewStiffnessIsCirculatory) {
  auto model =
      denseModel(Matrix::Identity(2, 2), Matrix::Identity(2, 2), 100 * Matrix::Identity(2, 2), 2);
  Matrix S(2, 2);
  S << 0, 5, -5, 0;
  model.stiffness.push_back({"torque", S.sparseView(), 0});
  model.initialDisplacement << 0.1, 0;
  Keep samples;
  const auto report = integrate(model, options("RK4", 2.0, 1e-3, 0.1), samples);
  EXPECT_GT(std::abs(report.energy.circulatory), 1e-3);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-4);
}

TEST(Energy, bouncingBallsBalance) {
  const auto model = droppedBalls(4, 1e6, 300, 1e6);
  Keep samples;
  const auto report = integrate(model, options("RK4", 0.2, 1e-5, 0.1), samples);
  EXPECT_GT(report.energy.contactDamping, 0.2);
  EXPECT_LT(std::abs(report.energy.residual()), 2e-3);
}

/// Dampers dissipate more than c v^2 at the mean speed of a step: (omega h)^2 / 12 more in a
/// vibration. With a mass on a damped stop, omega = 500 1/s, and two steps of 0.25 ms in a booking,
/// this is half a percent of the energy that the impact takes.
TEST(Energy, dampingOfAnImpactIsThatOfItsChangingSpeed) {
  const double m = 2, v = 0.4;
  auto model = denseModel(scalar(m), Matrix(), Matrix());
  model.initialDisplacement[0] = 0.01;
  model.initialVelocity[0] = -v;
  addFloor(model, 5e5, 150, 7e11);
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 0.06, 2.5e-4, 0.01), samples);
  const double after = samples.v.back()[0];
  EXPECT_NEAR(report.energy.contactDamping / (0.5 * m * (v * v - after * after)), 1.0, 2.5e-3);
}

/// A body of 10 kg that flies against a hard wall and slides along it slowly: friction stops the
/// sliding in the first steps of the impact and dissipates at most m u'^2/2. The law in the middle
/// of such a step, at half of the speed, would give mu F_n u'/2: up to twenty times as much.
TEST(Energy, frictionThatStopsAPointWithinAStepTakesWhatItHad) {
  const double mass = 10.0, sliding = 0.01, had = 0.5 * mass * sliding * sliding;
  contact::ContactPoint wall;
  wall.node = 1;
  wall.clearance = 0.03;
  wall.contactRadius = 0.08;
  wall.muStatic = wall.muDynamic = 0.5;
  wall.regularisationVelocity = 1e-6;
  auto model = denseModel(Vector3(mass, mass, 1e3).asDiagonal(), Matrix(), Matrix(), 3);
  model.initialDisplacement << 0.0, -0.0295, 0.0;  // half a millimetre from the wall
  model.initialVelocity << sliding, -1.0, 0.0;
  for (const double stiffness : {1e8, 1e9}) {
    wall.stiffness = stiffness;
    contact::ContactPoints points;
    points.add(wall);
    model::PointSet set;
    set.name = "wall";
    set.law = contact::makeLaw("Clamped")->inMotion(points, [](double /*t*/) { return 0.0; });
    set.rows = Matrix(Matrix::Identity(3, 3)).sparseView();
    set.offset = Vector::Zero(3);
    set.entities = {1};
    model.points = {set};
    Keep samples;
    auto o = options("Generalized-alpha", 0.03, 1e-3, 0.01);
    acceptCoarseSteps(o);
    const auto report = integrate(model, o, samples);
    EXPECT_LT(report.energy.friction, 1.1 * had) << stiffness;
    if (stiffness > 1e8) continue;  // harder walls release it before it is at rest
    EXPECT_LT(std::abs(samples.v.back()[0]), 0.1 * sliding);
    EXPECT_NEAR(report.energy.friction, had, 0.3 * had);
  }
}

/// A floor that returns more energy than it absorbs and reports none: it imitates a step that
/// generates energy.
class Trampoline final : public model::PointLaw {
 public:
  int size() const override { return 1; }
  int width() const override { return 1; }
  void evaluate(double, const std::vector<int>&, const double* d, const double* v,
                double* f) const override {
    f[0] = d[0] < 0 ? -1e4 * d[0] + 40 * v[0] : 0.0;
  }
  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    evaluate(t, active, d, v, f);
    dfdd[0] = d[0] < 0 ? -1e4 : 0.0;
    dfdv[0] = d[0] < 0 ? 40 : 0.0;
  }
  void clearanceLeft(const std::vector<int>&, const double* d, double* gap) const override {
    gap[0] = d[0];
  }
  Power power(double, const std::vector<int>&, const double* d, const double*) const override {
    Power power;
    power.stored = d[0] < 0 ? 0.5e4 * d[0] * d[0] : 0.0;
    return power;
  }
  std::vector<model::Channel> channels() const override { return {}; }
  void record(double, const double*, const double*, double*) const override {}
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>&) const override {
    return nullptr;
  }
};

TEST(Energy, aRunThatLivesOnEnergyMadeOfNothingIsRefused) {
  auto model = oscillator(1.0, 0.0, 100.0, 0.1, 0.0);
  model::PointSet set;
  set.name = "trampoline";
  set.law = std::make_shared<Trampoline>();
  set.rows.resize(1, 1);
  set.rows.setIdentity();
  set.offset = Vector::Zero(1);
  set.entities = {1};
  model.points.push_back(set);
  for (const auto& integrator : {"Generalized-alpha", "RK4"}) {
    Keep samples;
    const auto text =
        errorText([&] { integrate(model, options(integrator, 20.0, 1e-3, 0.01), samples); });
    EXPECT_NE(text.find("J without work being done"), std::string::npos) << text;
    EXPECT_EQ(text.find("Spectral Radius") != std::string::npos,
              std::string(integrator) == "Generalized-alpha")
        << text;
  }
}

/// Negative damping supplies energy to the motion: this is work, not an instability of the scheme.
TEST(Energy, aVibrationThatGrowsByItselfIsNotRefused) {
  const double c = -0.8, omega = std::sqrt(400 - 0.16);
  auto model = oscillator(1, c, 400, 1e-3, 0);
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 20, 2e-3, 0.1), samples);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-3);
  const double t = samples.time.back(), grown = 1e-3 * std::exp(0.4 * t);
  EXPECT_NEAR(samples.q.back()[0],
              grown * (std::cos(omega * t) - 0.4 / omega * std::sin(omega * t)), 0.01 * grown);
}

/// RK4 multiplies the energy of a vibration by 1 - (omega h)^6 / 72 in a step: steps near its
/// stability limit lose it.
TEST(Energy, aRunThatLosesItsEnergyIsRefusedWhileItGoes) {
  const auto model = oscillator(1.0, 0.0, 100.0, 0.1, 0.0);
  Keep samples;
  const auto text = errorText([&] { integrate(model, options("RK4", 1e4, 0.2, 2.0), samples); });
  EXPECT_NE(text.find("J was lost by the integration until t = "), std::string::npos) << text;
  EXPECT_NE(text.find("Reduce Transient/Step"), std::string::npos) << text;
  EXPECT_LT(samples.time.back(), 1100.0) << "a tenth of the motion";
}

TEST(Energy, aBalanceThatIsOpenIsWarnedOf) {
  const auto model = oscillator(1.0, 0.0, 100.0, 0.1, 0.0);
  for (const double step : {0.05, 0.125}) {
    log::clearWarnings();
    Keep samples;
    const auto o = options("RK4", 2.0, step, 1.0);
    const auto report = integrate(model, o, samples);
    const double open = std::abs(report.energy.residual());
    const auto& warnings = log::warnings();
    const bool warned = std::any_of(warnings.begin(), warnings.end(), [](const auto& one) {
      return one.find("% of the energy exchanged") != std::string::npos;
    });
    EXPECT_LT(open, o.energyResidualLimit) << step;
    EXPECT_EQ(open > o.energyResidualWarning, step > 0.06) << step << ' ' << open;
    EXPECT_EQ(warned, step > 0.06) << step << ' ' << open;
  }
}

/// A wall far too stiff for the step: impacts generate no energy, at any spectral radius, and
/// nothing passes through the wall.
TEST(Energy, impactsOnAWallTooStiffForTheStepMakeNone) {
  for (double radius : {0.2, 0.8, 1.0})
    for (double stiffness : {1e8, 1e10}) {
      auto model = droppedBalls(10, stiffness, 0, 7e11, 2e5);
      model.loads[0].vector *= 20;
      Keep samples;
      auto o = options("Generalized-alpha", 2.0, 2e-3, 0.01);
      o.own.set("Spectral Radius", radius);
      acceptCoarseSteps(o);  // positions after the first bounce are inaccurate
      const auto report = integrate(model, o, samples);
      EXPECT_EQ(report.counters.unconvergedSteps, 0);
      EXPECT_GT(report.energy.numerical(), -0.01 * report.energy.supplied)
          << radius << " " << stiffness;
      for (const auto& q : samples.q) ASSERT_GT(q.minCoeff(), -1e-3);
    }
}

TEST(Energy, aDrivenRotorInItsBoreBalances) {
  auto model = denseModel(Vector(Eigen::Vector3d(10, 10, 0.05)).asDiagonal(), Matrix(),
                          Vector(Eigen::Vector3d(2e3, 2e3, 500)).asDiagonal(), 3);
  model.componentNames = {"u", "v", "theta_z"};
  contact::ContactPoints points;
  points.add({1, 0.01, 0.1, 1e6, 300, 1e6, 1e6, 0.3, 0.2, 0.1});
  model::PointSet set;
  set.name = "contact";
  set.law = contact::makeLaw("Clamped")->inMotion(points, [](double) { return 10.0; });
  set.rows.resize(3, 3);
  set.rows.setIdentity();
  set.offset = Vector::Zero(3);
  set.entities = {1};
  model.points.push_back(set);
  model.loads.push_back({"weight", Vector::Unit(3, 0) * 98.1, 0});
  Keep samples;
  const auto report = integrate(model, options("RK4", 1.0, 2e-5, 0.1), samples);
  EXPECT_GT(report.energy.friction, 1.0);
  EXPECT_GT(report.energy.drive, 1.0);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-4);
}

}  // namespace EnergyTest
}  // namespace tooljoint::transient::testing
