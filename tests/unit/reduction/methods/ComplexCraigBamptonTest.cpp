// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Halves of complex fixed-interface modes of single parts.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/BasisFamilies.hpp"

namespace ComplexCraigBamptonTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

Basis build(const model::Substructure& part, const ModeRequest& request, double time = 0.5) {
  Teuchos::ParameterList list("Reduction");
  list.sublist("Complex Craig-Bampton").set("Time", time);
  return makeBasis("Complex Craig-Bampton", list)->build(part, request);
}

model::Substructure bar() {
  auto part = samples::bar("bar", 1, 8, 3.0, 2.0);
  samples::classify(part, {1, 9});
  return part;
}

TEST(ComplexCraigBampton, UndampedPartsHaveRealModes) {
  const auto basis = build(bar(), samples::modes(3));
  const auto real =
      makeBasis("Craig-Bampton", Teuchos::ParameterList())->build(bar(), samples::modes(3));
  EXPECT_LT((Matrix(basis.vectors) - Matrix(real.vectors)).norm(), 1e-12);
}

TEST(ComplexCraigBampton, ProportionalDampingHasRealModes) {
  auto part = bar();
  part.model.damping.push_back(
      {"Rayleigh", Sparse(0.3 * part.model.mass + 0.02 * part.model.stiffness[0].matrix), 0});
  const auto basis = build(part, samples::modes(3));
  ASSERT_EQ(basis.modes(), 3) << "no imaginary halves";
  const auto real =
      makeBasis("Craig-Bampton", Teuchos::ParameterList())->build(bar(), samples::modes(3));
  EXPECT_LT((basis.eigenvalues - real.eigenvalues).norm(), 1e-8 * real.eigenvalues.norm());
}

TEST(ComplexCraigBampton, ADashpotGivesBothHalves) {
  auto part = bar();
  part.model.damping.push_back({"dashpot", samples::square(9, {{2, 2, 0.8}}), 0});
  EXPECT_EQ(build(part, samples::modes(2)).modes(), 2);
  const auto three = build(part, samples::modes(3));
  EXPECT_EQ(three.modes(), 4) << "the halves of a mode are not parted";
  ASSERT_EQ(three.remarks.size(), 1u);
  EXPECT_NE(three.remarks[0].find("to keep conjugate parts and close pairs together"),
            std::string::npos);
}

TEST(ComplexCraigBampton, AllOfThemAreTheWholeInterior) {
  for (const bool overdamped : {false, true}) {
    auto part = bar();
    part.model.damping.push_back(
        {"dashpot",
         samples::square(9, {{2, 2, overdamped ? 60.0 : 0.8}, {5, 5, overdamped ? 30.0 : 0.1}}),
         0});
    const auto basis = build(part, ModeRequest());
    EXPECT_EQ(basis.modes(), 7);
    EXPECT_TRUE(basis.complete);
  }
}

TEST(ComplexCraigBampton, ACutOffLooksAtTheSizeOfS) {
  auto part = samples::loopFrame(10, true)[2];
  const auto all = build(part, ModeRequest());
  ModeRequest below;
  below.kind = ModeRequest::Kind::Below;
  below.omegaMax = 2000;
  const auto some = build(part, below);
  EXPECT_GT(some.modes(), 0);
  EXPECT_LT(some.modes(), all.modes());
}

TEST(ComplexCraigBampton, TheTimeOfTheLawsMatters) {
  const auto part = samples::loopFrame(8, true)[2];
  const Matrix slow = build(part, samples::modes(4), -2.0).vectors,
               fast = build(part, samples::modes(4), 50.0).vectors;  // Omega = 0 and 52
  EXPECT_TRUE(slow.cols() != fast.cols() || (slow - fast).norm() > 1e-3);
}

TEST(ComplexCraigBampton, FloatingPartsKeepTheirRigidBodyModes) {
  auto part = samples::bar("loose", 1, 8, 3.0, 2.0);
  part.model.damping.push_back(
      {"dashpot between",
       samples::square(9, {{2, 2, 0.8}, {2, 3, -0.8}, {3, 2, -0.8}, {3, 3, 0.8}}), 0});
  const auto small = reduce(part, build(part, samples::modes(3)), ReductionOptions(), 0);
  EXPECT_EQ(small.report.zeroEnergyReduced, 1);
}

TEST(ComplexCraigBampton, NoModesIsStaticCondensation) {
  EXPECT_EQ(build(samples::loopFrame(8, true)[2], samples::modes(0)).modes(), 0);
}

}  // namespace ComplexCraigBamptonTest
