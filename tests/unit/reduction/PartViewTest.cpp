// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A part view provides the quantities of reduction methods and computes each once.
#include "reduction/part/PartView.hpp"

#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "coupling/Synthesis.hpp"
#include "tests/support/SampleParts.hpp"

namespace PartViewTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

/// Interior blocks coupled to the boundary, of all parts.
int blocksToFactor(const std::vector<model::Substructure>& parts) {
  int blocks = 0;
  for (const auto& part : parts)
    for (const auto& touched : partition(part).touched) blocks += touched.empty() ? 0 : 1;
  return blocks;
}

/// Factorisations of a synthesis with two modes of each part, without checks.
long factorisations(const std::string& basis, const std::vector<model::Substructure>& parts) {
  ReductionOptions options;
  options.basis = basis;
  options.checks = false;
  options.modes.kind = ModeRule::Kind::PerPart;
  options.modes.counts = {2};
  resetEvaluationCounters();
  coupling::synthesise(parts, *makeBasis(basis, Teuchos::ParameterList()), options);
  return counted("factorisations");
}

TEST(PartView, ComputesEachQuantityOnceForAllCopies) {
  const auto part = samples::loopFrame(6, false)[0];
  resetEvaluationCounters();
  const PartView view = part, copy = view;
  EXPECT_EQ(&view.stiffness(), &copy.stiffness());
  EXPECT_EQ(&view.partition(), &copy.partition());
  EXPECT_EQ(&view.constraintModes(), &copy.constraintModes());
  const Matrix loads = Matrix::Ones(sizeOf(view.partition().interior), 3);
  const Matrix x = view.solveInterior(loads);
  EXPECT_EQ(counted("factorisations"), blocksToFactor({part}));
  EXPECT_LT((view.interiorStiffness() * x - loads).norm(), 1e-9 * loads.norm());
}

TEST(PartView, FactorsASymmetricStiffnessOnceForBothOfItsParts) {
  for (const bool spinning : {false, true}) {
    const auto part = samples::loopFrame(6, spinning)[0];
    const PartView view = part;
    EXPECT_EQ(view.symmetric(), !spinning);
    resetEvaluationCounters();
    const Matrix loads = Matrix::Ones(sizeOf(view.partition().interior), 2);
    view.solveInterior(loads);
    const Matrix x = view.solveSymmetricInterior(loads);
    EXPECT_EQ(counted("factorisations"), (spinning ? 2 : 1) * blocksToFactor({part}));
    EXPECT_LT((view.symmetricInteriorStiffness() * x - loads).norm(), 1e-9 * loads.norm());
  }
}

// Constraint modes before the parts are coupled and residual vectors after it need K_II^-1.
TEST(PartView, StagesOfAMethodShareTheFactorOfTheInterior) {
  const auto parts = samples::loopFrame(6, false);
  const int blocks = blocksToFactor(parts);
  EXPECT_EQ(factorisations("Craig-Bampton", parts), blocks);
  EXPECT_EQ(factorisations("Enhanced Craig-Bampton", parts), blocks);
}

TEST(PartView, OtherBoundariesShareTheStiffness) {
  auto part = samples::bar("bar", 1, 6, 1.0, 1.0);
  samples::classify(part, {1, 7}, {4});
  const PartView view = part, more = view.withBoundary({0, 6}, {2, 3});
  EXPECT_EQ(more.partition().interior, (std::vector<int>{1, 4, 5}));
  EXPECT_EQ(&more.stiffness(), &view.stiffness());
  EXPECT_EQ(&view.withBoundary({0, 6}, {3}).partition(), &view.partition());
  EXPECT_EQ(view.unsupported().partition().interior.size(), 7u);
  EXPECT_EQ(view.unsupported().blocks(), 1);
}

// A free bar under one force: [K  M N; N' M  0] (x, mu) = (f, 0) with the rigid-body motion N.
TEST(PartView, LoadsOnFloatingBlocksAreBalancedByInertia) {
  auto part = samples::bar("free", 1, 5, 2.0, 1.0);
  samples::classify(part, {}, {});
  const PartView view = part;
  const Matrix K = view.stiffness(), M = view.mass();
  Vector f = Vector::Zero(6);
  f[5] = 3;
  const Vector x = view.solveInterior(f), weight = M * Vector::Ones(6);
  const Vector balanced = f - weight * (f.sum() / weight.sum());
  EXPECT_LT((K * x - balanced).norm(), 1e-9 * f.norm());
  EXPECT_LT(std::abs(weight.dot(x)), 1e-9 * weight.norm() * x.norm());
}

TEST(PartView, RefusesAnInconsistentPart) {
  auto part = samples::bar("bar", 1, 3, 1.0, 1.0);
  part.interface = {3, 0};
  const PartView view = part;
  EXPECT_THROW(view.stiffness(), ModelError);
  EXPECT_THROW(view.partition(), ModelError);
}

}  // namespace PartViewTest
