// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The Krylov basis of single parts: number of vectors, deflation, pieces without excitation,
/// resonances.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace KrylovTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

Basis build(const model::Substructure& part, int modes,
            const std::function<void(Teuchos::ParameterList&)>& set = {}) {
  Teuchos::ParameterList list("Reduction");
  if (set) set(list.sublist("Krylov"));
  ModeRequest request;
  if (modes >= 0) request.kind = ModeRequest::Kind::Count;
  request.count = modes;
  return makeBasis("Krylov", list)->build(part, request);
}

model::Substructure bar(int elements = 8) {
  auto part = samples::bar("bar", 1, elements, 3.0, 2.0);
  samples::classify(part, {1, elements + 1});
  return part;
}

TEST(Krylov, TakesAsManyAsAskedFor) {
  for (const int modes : {0, 1, 2, 3, 6, 7}) EXPECT_EQ(build(bar(), modes).modes(), modes);
  EXPECT_EQ(build(bar(), -1).modes(), 7);
  EXPECT_TRUE(build(bar(), -1).complete);
}

TEST(Krylov, MoreThanThereAreIsSaid) {
  const auto basis = build(bar(), 99);
  EXPECT_EQ(basis.modes(), 7);
  ASSERT_EQ(basis.remarks.size(), 1u);
  EXPECT_EQ(basis.remarks[0], "requested 99 Krylov vectors, kept all 7");
}

TEST(Krylov, AnIncompleteFirstBlockIsSaid) {
  const auto basis = build(samples::loopFrame(6, false)[2], 4);
  ASSERT_EQ(basis.remarks.size(), 1u);
  EXPECT_NE(basis.remarks[0].find("no moment is matched completely"), std::string::npos)
      << basis.remarks[0];
}

TEST(Krylov, FirstVectorsOfABarSpanWhatTheInertiaOfStraightMotionBends) {
  // psi = 1 - x, x; consistent mass: M_II psi + M_IC is m (1 - x), m x at the nodes, and K y =
  // that: the cubics of x that vanish at the ends.
  const auto basis = build(bar(), 2);
  const Matrix V = Matrix(basis.vectors).bottomRows(9).rightCols(2).middleRows(1, 7);
  Matrix cubics(7, 2);
  for (int i = 1; i <= 7; ++i) {
    const double x = i / 8.0;
    cubics(i - 1, 0) = x * (1 - x);
    cubics(i - 1, 1) = x * (1 - x) * (1 - 2 * x);
  }
  const Matrix fitted =
      V * linalg::solveSymmetric(V.transpose() * V, Matrix(V.transpose() * cubics));
  EXPECT_LT((fitted - cubics).norm(), 1e-12);
}

TEST(Krylov, VectorsThatRepeatAreDeflated) {
  // Both ends of two equal bars tied to one boundary dof each: the second retained dof in the
  // middle cuts them; blocks shrink to the independent directions.
  auto part = bar(8);
  part.retained = {4};
  const auto basis = build(part, -1);  // two links of three dofs
  EXPECT_EQ(basis.modes(), 6);
  EXPECT_LT(basis.orthogonality, 1e-12);
}

TEST(Krylov, DampingInProportionDrivesNothingNew) {
  auto part = bar();
  part.model.damping.push_back(
      {"Rayleigh", Sparse(0.3 * part.model.mass + 0.02 * part.model.stiffness[0].matrix), 0});
  const auto damped = build(part, 2, [](auto& list) { list.set("Damped", true); });
  const Matrix V = build(part, 2).vectors, W = damped.vectors;
  EXPECT_LT((V - W).norm(), 1e-10) << "at s = 0 the first block is the same";
}

TEST(Krylov, PiecesNothingDrivesKeepTheirModes) {
  auto part = samples::bar("two bars", 1, 7, 3.0, 2.0);
  auto& m = part.model;
  for (auto* A : {&m.mass, &m.stiffness.own()[0].matrix}) {  // element 4 taken out
    const double diagonal = A == &m.mass ? 2.0 / 3 : 3.0;
    A->coeffRef(3, 4) = A->coeffRef(4, 3) = 0.0;
    A->coeffRef(3, 3) -= diagonal;
    A->coeffRef(4, 4) -= diagonal;
  }
  samples::classify(part, {1});
  const auto basis = build(part, 2);
  EXPECT_EQ(basis.modes(), 4) << "two of each piece";
  EXPECT_NEAR(basis.eigenvalues[0], 0.0, 1e-12);
  EXPECT_EQ(basis.modeKind[0], "fixed-interface");
  EXPECT_EQ(reduce(part, basis, ReductionOptions(), 0).report.zeroEnergyReduced, 2);
}

TEST(Krylov, AResonanceIsNamed) {
  const auto part = bar();
  const double lambda = makeBasis("Craig-Bampton", Teuchos::ParameterList())
                            ->build(part, ModeRequest())
                            .eigenvalues[2];
  const double hertz = std::sqrt(lambda) / constants::twoPi;
  try {
    build(part, 1, [&](auto& list) { list.set("Expansion Frequency", hertz); });
    FAIL() << "a singular dynamic stiffness was accepted";
  } catch (const ModelError& error) {
    EXPECT_NE(std::string(error.what())
                  .find("natural frequency of the part with its boundary dofs fixed"),
              std::string::npos)
        << error.what();
  }
}

TEST(Krylov, ACutOffAsksForAsManyAsThereAreModesBelow) {
  ModeRequest request;
  request.kind = ModeRequest::Kind::Below;
  const auto part = bar(20);
  Teuchos::ParameterList none("Reduction");
  const auto modes = makeBasis("Craig-Bampton", none)->build(part, ModeRequest()).eigenvalues;
  request.omegaMax = 0.5 * (std::sqrt(modes[4]) + std::sqrt(modes[5]));
  EXPECT_EQ(makeBasis("Krylov", none)->build(part, request).modes(), 5);
}

TEST(Krylov, EqualDirectionsStayTogether) {
  const auto part = bar();  // symmetric about its middle: a block has an even and an odd direction
                            // of different size
  EXPECT_EQ(build(part, 3).modes(), 3);
}

}  // namespace KrylovTest
