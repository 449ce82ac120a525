// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static states on the axis of the bore beyond their buckling load: reported stability against the
/// Euler column, and the state on the wall that replaces them.
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "estimate/ModeComparison.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "substructures/beam/Section.hpp"
#include "substructures/drillstring/scene/StringStability.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace UnstableStateTest {

using namespace tooljoint;
using constants::pi;

constexpr double length = 12.0;  // [m]

beam::Section pipe() {
  return beam::Section::hollow(0.0635, 0.054, beam::Material{7850.0, 2.06e11, 0.3});
}

/// Buckling load of the pinned column with shear (Engesser): P = P_E / (1 + P_E / (beta G S)) [N].
double bucklingLoad() {
  const auto s = pipe();
  const double euler = pi * pi * s.youngModulus() * s.inertiaX() / (length * length);
  return euler / (1.0 + euler / (0.9 * s.shearModulus() * s.area()));
}

/// Growth of the half wave: s^2 (rho S + rho I q^2) = (P - P_c) q^2, q = pi / L [1/s].
double growthRate(double load) {
  const auto s = pipe();
  const double q = pi / length, mass = 7850.0 * (s.area() + s.inertiaX() * q * q);
  return std::sqrt((load - bucklingLoad()) * q * q / mass);
}

drillstring::Scene column(double loads, std::vector<std::string> overrides = {}) {
  overrides.push_back("Loads/Weight On Bit=" + std::to_string(loads * bucklingLoad()));
  return drillstring::readScene(
      testing_::sourceFolder() + "/tests/stability/equilibrium/column.xml", overrides);
}

TEST(UnstableState, IsNotReportedBelowTheBucklingLoad) {
  const auto stage = drillstring::findEquilibrium(column(0.99));
  EXPECT_TRUE(stage.stability.stable()) << drillstring::describeStability(stage);
  EXPECT_EQ(stage.stability.negativePivots, 0);
}

TEST(UnstableState, GrowsAsTheEulerColumnBeyondIt) {
  for (const double loads : {1.01, 1.5, 3.0}) {
    const auto scene = column(loads);
    const auto stage = drillstring::findEquilibrium(scene);
    const auto& stability = stage.stability;
    EXPECT_EQ(stability.negativePivots, 2) << loads;  // one in each plane
    EXPECT_TRUE(stability.diverges()) << loads;
    const double expected = growthRate(loads * bucklingLoad());
    EXPECT_NEAR(stability.growthRate, expected, 0.01 * expected) << loads;
    EXPECT_EQ(stability.outline.halfWaves, 1) << loads;
    EXPECT_EQ(stability.outline.node, 13) << loads;  // mid length
  }
}

/// sqrt(c^2/4 - lambda) - c/2 with damping c M.
TEST(UnstableState, GrowsMoreSlowlyWithDamping) {
  constexpr double damping = 2.0;  // [1/s]
  const auto stage = drillstring::findEquilibrium(column(1.5, {"Damping/Mass Coefficient=2"}));
  const double undamped = growthRate(1.5 * bucklingLoad());
  const double expected = std::sqrt(0.25 * damping * damping + undamped * undamped) - 0.5 * damping;
  EXPECT_NEAR(stage.stability.growthRate, expected, 0.01 * expected);
}

/// Torque makes the tangent unsymmetric. Beyond Greenhill's torque 2 pi EI / L, alone and with half
/// of the Euler load, the growth rate is that of the rightmost of all eigenvalues.
TEST(UnstableState, GrowsAsTheRightmostEigenvalueUnderTorque) {
  const auto s = pipe();
  const double greenhill = 2.0 * pi * s.youngModulus() * s.inertiaX() / length;
  for (const double loads : {0.0, 0.5})
    for (const double torque : {1.02, 1.5}) {
      const auto scene =
          column(loads, {"Loads/Torque On Bit=" + std::to_string(torque * greenhill)});
      const auto stage = drillstring::findEquilibrium(scene);
      const auto whole = estimate::linearise(drillstring::fullModel(scene, stage), 0.0);
      const auto all =
          linalg::dampedModes(Matrix(whole.mass), Matrix(whole.damping), Matrix(whole.stiffness));
      const double rightmost = all.values.real().maxCoeff();
      EXPECT_FALSE(stage.stability.stable()) << loads << ' ' << torque;
      EXPECT_NEAR(stage.stability.growthRate, rightmost, 0.01 * rightmost)
          << loads << ' ' << torque;
    }
}

/// Friction of a string on the wall makes vibration of many half waves grow, far above the dozen
/// lowest modes; compared with all damped modes. The reported mode grows at least 0.8 times as fast
/// as the fastest.
TEST(UnstableState, GrowsInModesFarBehindTheLowest) {
  const std::vector<std::string> flat{
      "Well/Bore Radius=0.0635714",      "Rotary Speed/Constant/Speed=150 rpm",
      "Contact/Friction/Static=0.6",     "Contact/Friction/Dynamic=0.48",
      "Contact/Stiffness=2.35165e6",     "Contact/Damping=1e4",
      "Well/Vertical/Inclination=30 deg"},
      fast{"Well/Bore Radius=0.0635004",  "Rotary Speed/Constant/Speed=300 rpm",
           "Contact/Friction/Static=0.3", "Contact/Friction/Dynamic=0.24",
           "Contact/Stiffness=1.12176e7", "Contact/Damping=1e3",
           "Loads/Weight On Bit=50000"};
  for (const auto& overrides : {flat, fast}) {
    const auto scene = drillstring::readScene(
        testing_::sourceFolder() + "/tests/stability/hard_cases/lying.xml", overrides);
    const auto stage = drillstring::findEquilibrium(scene);
    const auto whole = estimate::linearise(drillstring::fullModel(scene, stage), 0.0);
    const double fastest =
        linalg::dampedModes(Matrix(whole.mass), Matrix(whole.damping), Matrix(whole.stiffness))
            .values.real()
            .maxCoeff();
    EXPECT_GT(fastest, 10);
    EXPECT_GT(stage.stability.growthRate, 0.8 * fastest);
    EXPECT_LT(stage.stability.growthRate, 1.001 * fastest);
  }
}

TEST(UnstableState, IsNotReportedBelowGreenhillsTorque) {
  const auto s = pipe();
  const double greenhill = 2.0 * pi * s.youngModulus() * s.inertiaX() / length;
  const auto stage = drillstring::findEquilibrium(
      column(0.0, {"Loads/Torque On Bit=" + std::to_string(0.98 * greenhill)}));
  const auto all = [&] {
    const auto whole = estimate::linearise(assemble(stage.equations), 0.0);
    return linalg::dampedModes(Matrix(whole.mass), Matrix(whole.damping), Matrix(whole.stiffness));
  }();
  EXPECT_LT(all.values.real().maxCoeff(), stability::slowestGrowth);
  EXPECT_TRUE(stage.stability.stable()) << drillstring::describeStability(stage);
}

/// Skew stiffness that couples a falling dof to one too stiff for the projection makes s^2 = -2 of
/// s^2 = 1: Newton's method, which begins on the real axis, does not converge. The modes of the
/// whole equations that are nearest do not grow.
TEST(UnstableState, IsNotReportedForAProjectedModeThatTheWholeEquationsDoNotHave) {
  constexpr int n = 14;
  constexpr double stiff = 1e4;
  const double skew = std::sqrt(3.0 * stiff);
  Matrix K = Vector::LinSpaced(n, 0, n - 1).asDiagonal();
  K(0, 0) = -1.0;
  K(n - 1, n - 1) = stiff;
  K(0, n - 1) = skew;
  K(n - 1, 0) = -skew;
  model::SecondOrderModel model;
  model.componentNames = {"u"};
  for (int i = 0; i < n; ++i) model.dofs.push_back(model::DofLabel::physical(1 + i, 0));
  model.mass = Sparse(Matrix(Matrix::Identity(n, n)).sparseView());
  model.stiffness.push_back({"stiffness", K.sparseView(), 0});
  model.initialDisplacement = model.initialVelocity = Vector::Zero(n);
  const auto stability = stability::assess(model, 0.0);
  EXPECT_EQ(stability.negativePivots, 1);
  EXPECT_GT(stability.examined, 0);
  EXPECT_TRUE(stability.stable()) << stability.growthRate;
}

/// A shaft in torsion: motions of the size of rounding beside it must not be reported as growing.
TEST(UnstableState, NamesTheRotationOfATorsionalMode) {
  Matrix K = Vector((Vector(4) << 4.0, 2.0, 5.0, -1.0).finished()).asDiagonal();
  K(2, 3) = K(3, 2) = 1e-9;
  model::SecondOrderModel model;
  model.componentNames = {"w", "theta_z"};
  for (int i = 0; i < 4; ++i) model.dofs.push_back(model::DofLabel::physical(1 + i / 2, i % 2));
  model.mass = Sparse(Matrix(Matrix::Identity(4, 4)).sparseView());
  model.stiffness.push_back({"stiffness", K.sparseView(), 0});
  model.initialDisplacement = model.initialVelocity = Vector::Zero(4);
  const auto stability = stability::assess(model, 0.0);
  EXPECT_NEAR(stability.growthRate, 1.0, 1e-6);
  EXPECT_EQ(stability.outline.component, "theta_z");
  EXPECT_EQ(stability.outline.node, 2);
}

/// A free bar of equal springs and unit masses, damped by a I - c phi phi', phi'phi = 1: mode j
/// alone grows, at (c - a) / 2, with s^2 - (c - a) s + k (2 sin(j pi / 2n))^2 = 0. A shift nearer
/// to the rigid motion finds no modes. With the larger a no single dof has negative damping.
TEST(UnstableState, GrowsInAHighModeOfAFloatingBar) {
  constexpr int n = 300, mode = 75;
  constexpr double k = 1e6, drive = 40.0;
  model::SecondOrderModel model;
  model.componentNames = {"w"};
  Triplets springs;
  Vector shape(n);
  for (int i = 0; i < n; ++i) {
    model.dofs.push_back(model::DofLabel::physical(1 + i, 0));
    shape[i] = std::sqrt(2.0 / n) * std::cos(mode * pi * (i + 0.5) / n);
    for (const int row : {i - 1, i})
      for (const int column : {i - 1, i})
        if (i > 0) springs.emplace_back(row, column, row == column ? k : -k);
  }
  Sparse K(n, n);
  K.setFromTriplets(springs.begin(), springs.end());
  const Matrix one = Matrix::Identity(n, n);
  model.mass = one.sparseView();
  model.stiffness.push_back({"stiffness", K, 0});
  model.initialDisplacement = model.initialVelocity = Vector::Zero(n);
  for (const double damping : {0.1, 0.3}) {
    const Matrix C = damping * one - drive * shape * shape.transpose();
    EXPECT_EQ(C.diagonal().minCoeff() > 0.0, damping == 0.3);
    model.damping = {{"damping", C.sparseView(), 0}};
    const auto stability = stability::assess(model, 0.0);
    EXPECT_EQ(stability.negativePivots, 0);
    const double growth = 0.5 * (drive - damping), half = std::sin(0.5 * mode * pi / n);
    EXPECT_NEAR(stability.growthRate, growth, 1e-6 * growth);
    const double frequency = std::sqrt(4.0 * k * half * half - growth * growth) / (2.0 * pi);
    EXPECT_NEAR(stability.frequency, frequency, 1e-6 * frequency);
  }
}

TEST(UnstableState, IsRefusedWhenTheDeckSaysSo) {
  const auto scene = column(1.01, {"Static/Unstable State=Refuse"});
  try {
    drillstring::solveStatic(scene);
    FAIL() << "it passes";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("1 half wave, largest in"), std::string::npos)
        << error.what();
  }
  EXPECT_NO_THROW(drillstring::solveStatic(column(0.99, {"Static/Unstable State=Refuse"})));
}

TEST(UnstableState, IsLeftForAStableOneOnTheWall) {
  for (const double loads : {1.01, 1.5, 4.0, 9.0}) {
    const auto scene = column(loads, {"Static/Unstable State=Perturb"});
    const auto stage = drillstring::solveStatic(scene);
    EXPECT_TRUE(stage.stability.stable()) << drillstring::describeStability(stage);
    EXPECT_EQ(stage.stability.negativePivots, 0) << loads;
    EXPECT_GE(stage.perturbations, 1) << loads;
    EXPECT_GE(stage.state.contactNodes, 1) << loads;
    EXPECT_LE(stage.state.report.residual, scene.statics.tolerance) << loads;
    EXPECT_GT(stage.state.totalNormalForce, 0.0) << loads;
  }
}

/// A torque far below Greenhill's gives the growth of the column a frequency, which is no
/// vibration.
TEST(UnstableState, IsADivergenceUnderASmallTorque) {
  for (const char* torque : {"10", "2000"}) {
    const std::string set = std::string("Loads/Torque On Bit=") + torque;
    const auto left = drillstring::findEquilibrium(column(1.5, {set}));
    EXPECT_FALSE(left.stability.stable());
    EXPECT_TRUE(left.stability.diverges()) << drillstring::describeStability(left);
    const auto found =
        drillstring::solveStatic(column(1.5, {set, "Static/Unstable State=Perturb"}));
    EXPECT_GE(found.perturbations, 1) << torque;
    EXPECT_GE(found.state.contactNodes, 1) << torque;
  }
}

TEST(UnstableState, WithoutAWallCannotBeLeft) {
  auto scene = column(1.5, {"Static/Unstable State=Perturb"});
  scene.contact.reset();
  scene.contactPoints = {};
  EXPECT_THROW(drillstring::findEquilibrium(scene), ConvergenceError);
}

}  // namespace UnstableStateTest
