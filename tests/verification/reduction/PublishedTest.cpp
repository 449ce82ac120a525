// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Craig-Bampton against closed forms and printed values, and the rigid-body modes of a free beam.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "reduction/Reduce.hpp"
#include "substructures/beam/BeamMatrices.hpp"
#include "tests/support/SampleParts.hpp"

namespace PublishedTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

using constants::pi;

ReductionOptions modes(int count) {
  ReductionOptions options;
  options.modes.kind = ModeRule::Kind::PerPart;
  options.modes.counts = {count};
  return options;
}

std::vector<ReducedSubstructure> reduced(const std::vector<model::Substructure>& parts, int count) {
  return reduceAll(parts, *makeBasis("Craig-Bampton", Teuchos::ParameterList()), modes(count));
}

Vector omegas(const model::SecondOrderModel& m) {
  return linalg::symmetricModes(Matrix(m.stiffnessAt(0)), Matrix(m.mass)).values.cwiseSqrt();
}

// A clamped-free rod of unit length, EA = rho A = 1, boundary dof at its free end. In the continuum
// the constraint mode is x and the fixed-interface modes are sqrt(2) sin(k pi x), so with one mode
// m = [1/3, s; s, 1], s = sqrt(2)/pi, k = diag(1, pi^2).
TEST(Rod, MatchesTheClosedFormOfTheContinuum) {
  auto rod = samples::bar("rod", 0, 400, 400.0, 1.0 / 400, {0});
  samples::classify(rod, {}, {400});
  const Vector guyan = omegas(reduced({rod}, 0)[0].model);
  EXPECT_NEAR(guyan[0], std::sqrt(3.0), 1e-5);
  // (1/3 - 2/pi^2) x^2 - (1 + pi^2/3) x + pi^2 = 0, x = omega^2
  const double a = 1.0 / 3 - 2 / (pi * pi), b = 1 + pi * pi / 3, c = pi * pi;
  const double root = std::sqrt(b * b - 4 * a * c);
  const Vector one = omegas(reduced({rod}, 1)[0].model);
  EXPECT_NEAR(one[0], std::sqrt((b - root) / (2 * a)), 1e-5) << "1.577810, 0.45 % above pi/2";
  EXPECT_NEAR(one[1], std::sqrt((b + root) / (2 * a)), 1e-4);
  EXPECT_NEAR(one[0], 1.577810, 2e-5);
}

TEST(Rod, ErrorFallsWithTheModesAndFromAbove) {
  auto rod = samples::bar("rod", 0, 400, 400.0, 1.0 / 400, {0});
  samples::classify(rod, {}, {400});
  double before = 1;
  for (int count : {0, 1, 2, 4, 8, 16}) {
    const double error = omegas(reduced({rod}, count)[0].model)[0] / (pi / 2) - 1;
    EXPECT_GT(error, 0.0);
    EXPECT_LT(error, before / (count == 0 ? 1 : 4)) << count << " modes";
    before = error;
  }
}

// J. L. Humar, Dynamics of Structures, example 19.1: a bar clamped on the left, two components of
// four consistent elements each, two fixed-interface modes per component. Printed for component 1
// (there normalised with the element length 1/8 in the mass): first mode 0.5264, 0.7444, 0.5264,
// constraint mode 0.25, 0.5, 0.75, 1.
TEST(Humar, BarOfTwoComponents) {
  const double l = 1.0 / 8;
  std::vector<model::Substructure> parts{samples::bar("component 1", 0, 4, 1 / l, l, {0}),
                                         samples::bar("component 2", 4, 4, 1 / l, l)};
  samples::classify(parts[0], {4});
  samples::classify(parts[1], {4});
  const auto small = reduced(parts, 2);
  const Matrix Phi = small[0].basis->vectors;
  const double printed[3] = {0.5264, 0.7444, 0.5264};
  for (int i = 0; i < 3; ++i) {
    EXPECT_NEAR(Phi(i, 0), 0.25 * (i + 1), 1e-14);
    EXPECT_NEAR(Phi(i, 1) * std::sqrt(l), printed[i], 5e-5);
  }
  // The coupled frequencies, computed independently with numpy/scipy from the definition of the
  // method.
  const double expected[5] = {1.57342778, 4.78413406, 8.19337258, 11.97215214, 17.68506349};
  const Vector omega = omegas(coupling::couple(small));
  ASSERT_EQ(omega.size(), 5);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(omega[i], expected[i], 1e-7);
}

/// A free straight beam in space, nodes 1 .. elements+1.
model::Substructure freeBeam(int elements) {
  const auto section = beam::Section::hollow(0.0635, 0.054, {7900, 2.03e11, 0.3});
  model::Substructure part;
  part.name = "pipe";
  auto& m = part.model;
  m.componentNames = {"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  for (int node = 1; node <= elements + 1; ++node)
    for (int c = 0; c < 6; ++c) m.dofs.push_back(model::DofLabel::physical(node, c));
  Triplets stiffness, mass;
  for (int e = 0; e < elements; ++e) {
    std::vector<int> dofs;
    for (int i = 0; i < 12; ++i) dofs.push_back(6 * e + i);
    samples::add(stiffness, beam::stiffness(section, 1.5), dofs);
    samples::add(mass, beam::mass(section, 1.5), dofs);
  }
  const int n = 6 * (elements + 1);
  m.mass = samples::square(n, mass);
  m.stiffness.push_back({"elastic", samples::square(n, stiffness), 0});
  samples::complete(part);
  return part;
}

TEST(FreeBeam, KeepsItsSixRigidBodyModes) {
  for (const auto& ends : {std::vector<int>{1}, std::vector<int>{1, 9}, std::vector<int>{}}) {
    auto pipe = freeBeam(8);
    samples::classify(pipe, {}, ends);
    for (int count : {0, 6, 99}) {
      if (ends.empty() && count < 6) continue;  // without boundary dofs, only modes are left
      const auto small = reduced({pipe}, count)[0];
      EXPECT_EQ(small.report.zeroEnergyFull, 6);
      EXPECT_EQ(small.report.zeroEnergyReduced, 6)
          << ends.size() << " kept nodes, " << count << " modes";
      EXPECT_TRUE(small.report.remarks.empty() || count == 99);
    }
  }
}

TEST(FreeBeam, LateralModesComeInPairsThatAreNotCut) {
  auto pipe = freeBeam(8);
  samples::classify(pipe, {}, {1, 9});
  EXPECT_EQ(reduced({pipe}, 1)[0].modes, 2);
  EXPECT_EQ(reduced({pipe}, 2)[0].modes, 2);
  EXPECT_EQ(reduced({pipe}, 3)[0].modes, 4);
  const Vector values = reduced({pipe}, 3)[0].basis->eigenvalues;
  EXPECT_NEAR(values[0], values[1], 1e-9 * values[0]);
  EXPECT_EQ(reduced({pipe}, 3)[0].basis->partition.blocks.size(), 4u)
      << "two planes, the axis and torsion are links of their own";
}

TEST(FreeBeam, ExplicitStepFollowsTheRetainedDofs) {
  auto pipe = freeBeam(8);
  samples::classify(pipe, {}, {1, 9});
  const auto condensed = reduced({pipe}, 0)[0];
  const auto all = reduced({pipe}, 99)[0];
  EXPECT_GT(condensed.report.explicitStep, 3 * all.report.explicitStep);
  const Vector omega = omegas(all.model).cwiseMax(0);
  EXPECT_NEAR(all.report.largestOmega, omega[omega.size() - 1], 1e-9 * all.report.largestOmega);
}

}  // namespace PublishedTest
