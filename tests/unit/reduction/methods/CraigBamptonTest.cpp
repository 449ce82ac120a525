// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The Craig-Bampton basis of single parts, with the special cases: no modes, all modes, no
/// interior, no interface, mechanisms.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/BasisFamilies.hpp"

namespace CraigBamptonTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::modes;

std::unique_ptr<ReductionMethod> craigBampton() {
  return makeBasis("Craig-Bampton", Teuchos::ParameterList());
}

ModeRequest allModes() { return {}; }

ReducedSubstructure reduced(const model::Substructure& part, const ModeRequest& request) {
  return reduce(part, craigBampton()->build(part, request), ReductionOptions(), 0);
}

model::Substructure barWithInterface(int elements = 8) {
  auto part = samples::bar("bar", 1, elements, 3.0, 2.0);
  samples::classify(part, {1, elements + 1});
  return part;
}

TEST(CraigBampton, IsRegistered) {
  EXPECT_NO_THROW(MethodRegistry::instance().find("Craig-Bampton"));
  EXPECT_THROW(MethodRegistry::instance().find("Craig-Bamton"), DeckError);
}

TEST(CraigBampton, ASignalIsNoFailureOfThePart) {
  const auto part = barWithInterface(400);  // its modes are computed by iteration
  requestInterrupt();
  EXPECT_THROW(craigBampton()->build(part, modes(3)), InterruptedError);
  requestInterrupt(false);
  EXPECT_EQ(craigBampton()->build(part, modes(3)).vectors.cols(), 5);
}

TEST(CraigBampton, KeptRowsAreTheIdentity) {
  const auto part = barWithInterface();
  const Basis basis = craigBampton()->build(part, modes(3));
  const Matrix Phi = basis.vectors;
  ASSERT_EQ(Phi.cols(), 5);
  for (int j = 0; j < 2; ++j)
    for (int c = 0; c < 5; ++c)
      EXPECT_EQ(Phi(basis.partition.boundary[static_cast<std::size_t>(j)], c), j == c ? 1.0 : 0.0);
}

TEST(CraigBampton, ConstraintModesOfABarAreStraight) {
  const auto part = barWithInterface();
  const Matrix Phi = craigBampton()->build(part, modes(0)).vectors;
  for (int i = 0; i <= 8; ++i) {
    EXPECT_NEAR(Phi(i, 0), 1 - i / 8.0, 1e-14);
    EXPECT_NEAR(Phi(i, 1), i / 8.0, 1e-14);
  }
}

TEST(CraigBampton, ConstraintModesUseTheFullUnsymmetricStiffness) {
  auto parts = samples::loopFrame(6, true);
  const auto& part = parts[2];
  const Basis basis = craigBampton()->build(part, modes(2));
  const Matrix K = constantStiffness(part.model);
  EXPECT_GT((K - K.transpose()).norm(), 1.0);
  const Matrix forces = K * Matrix(basis.vectors).leftCols(6);  // K Phi_C: no force on the interior
  for (int i : basis.partition.interior)
    EXPECT_LT(forces.row(i).cwiseAbs().maxCoeff(), 1e-12 * K.cwiseAbs().maxCoeff());
}

TEST(CraigBampton, NoModesIsGuyan) {
  const auto part = barWithInterface();
  const auto guyan = reduced(part, modes(0));
  EXPECT_EQ(guyan.modes, 0);
  const Matrix k = guyan.model.stiffness.front().matrix;
  EXPECT_LT((k - 3.0 / 8 * (Matrix(2, 2) << 1, -1, -1, 1).finished()).norm(), 1e-14);
  const Matrix m = guyan.model.mass;  // Guyan 1965: the consistent mass of one long element
  EXPECT_LT((m - 16.0 / 6 * (Matrix(2, 2) << 2, 1, 1, 2).finished()).norm(), 1e-13);
}

TEST(CraigBampton, ModalBlocksHaveTheirTheoreticalForm) {
  const auto part = barWithInterface();
  const auto cb = reduced(part, modes(3));
  const Matrix m = cb.model.mass, k = cb.model.stiffness.front().matrix;
  EXPECT_TRUE(cb.report.structureEnforced);
  EXPECT_LT(cb.report.massDefect, 1e-13);
  EXPECT_LT(cb.report.stiffnessDefect, 1e-13);
  EXPECT_EQ((m.bottomRightCorner(3, 3) - Matrix::Identity(3, 3)).norm(), 0.0);
  EXPECT_EQ(k.topRightCorner(2, 3).norm(), 0.0);
  EXPECT_EQ(k.bottomLeftCorner(3, 2).norm(), 0.0);
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j)
      if (i != j)
        EXPECT_EQ(k(2 + i, 2 + j), 0.0);
      else
        EXPECT_NEAR(k(2 + i, 2 + i), cb.basis->eigenvalues[i], 1e-13 * cb.basis->eigenvalues[i]);
}

TEST(CraigBampton, KeepsTheSkewPartsOfAnUnsymmetricPart) {
  const auto parts = samples::loopFrame(6, true);
  const auto cb = reduced(parts[2], modes(6));
  const Matrix k = cb.model.stiffness.front().matrix;
  const Matrix kDD = k.bottomRightCorner(6, 6);
  EXPECT_TRUE(cb.report.structureEnforced) << cb.report.stiffnessDefect;
  EXPECT_GT((kDD - kDD.transpose()).norm(), 1e-3);
  const Matrix symmetric = kDD + kDD.transpose();
  EXPECT_EQ((symmetric - Matrix(symmetric.diagonal().asDiagonal())).norm(), 0.0);
  EXPECT_EQ(k.bottomLeftCorner(6, 6).norm(), 0.0) << "k_DC = 0: constraint modes of the full K";
  EXPECT_GT(k.topRightCorner(6, 6).norm(), 1e-3) << "k_CD is what the skew part leaves";
}

TEST(CraigBampton, TermsKeepTheirLaws) {
  const auto parts = samples::loopFrame(6, true);
  const auto cb = reduced(parts[2], modes(4));
  ASSERT_EQ(cb.model.stiffness.size(), 2u);
  EXPECT_EQ(cb.model.stiffness[0].name, "elastic + torque");
  EXPECT_EQ(cb.model.laws[static_cast<std::size_t>(cb.model.stiffness[1].law)].name, "dOmega/dt");
  ASSERT_EQ(cb.model.damping.size(), 2u);
  EXPECT_EQ(cb.model.damping[0].name, "gyroscopic");
  EXPECT_EQ(cb.model.laws[static_cast<std::size_t>(cb.model.damping[0].law)].name, "Omega");
  const Matrix Phi = cb.basis->vectors;
  const Matrix expected = Phi.transpose() * Matrix(parts[2].model.damping[0].matrix) * Phi;
  EXPECT_LT((Matrix(cb.model.damping[0].matrix) - expected).norm(), 1e-13 * expected.norm());
}

TEST(CraigBampton, RayleighDampingStaysSparse) {
  auto part = barWithInterface();
  part.model.damping.push_back(
      {"Rayleigh", Sparse(0.3 * part.model.mass + 0.02 * part.model.stiffness[0].matrix), 0});
  const auto cb = reduced(part, modes(4));
  const Matrix expected = 0.3 * Matrix(cb.model.mass) + 0.02 * Matrix(cb.model.stiffness[0].matrix);
  EXPECT_LT((Matrix(cb.model.damping[0].matrix) - expected).norm(), 1e-13);
  EXPECT_EQ(cb.model.damping[0].matrix.nonZeros(), cb.model.mass.nonZeros());
}

TEST(CraigBampton, ShapesAreZeroWhereNothingReaches) {
  auto part = samples::bar("bar", 1, 9, 3.0, 2.0);
  samples::classify(part, {1, 10}, {4, 7});
  const Basis basis = craigBampton()->build(part, allModes());
  EXPECT_EQ(basis.vectors.cols(), 10);
  // kept columns: 1 + 1 + 2 ends couple to 2 or 4 interior dofs each; each of the 6 modes is
  // nonzero in its own block of 2 dofs
  EXPECT_EQ(basis.vectors.nonZeros(), 4 + (2 + 2 + 4 + 4) + 6 * 2);
}

TEST(CraigBampton, PartWithoutInterior) {
  auto part = samples::bar("pair", 1, 1, 3.0, 2.0);
  samples::classify(part, {1, 2});
  for (const auto& request : {modes(0), modes(5), allModes()}) {
    const auto cb = reduced(part, request);
    EXPECT_EQ(cb.size(), 2);
    EXPECT_LT((Matrix(cb.model.mass) - Matrix(part.model.mass)).norm(), 1e-15);
    EXPECT_TRUE(cb.report.checked);
  }
}

TEST(CraigBampton, PartWithoutInterfaceKeepsItsRigidBodyMode) {
  auto part = samples::bar("loose", 1, 8, 3.0, 2.0);
  const auto cb = reduced(part, modes(3));
  EXPECT_EQ(cb.interface + cb.retained, 0);
  EXPECT_NEAR(cb.basis->eigenvalues[0], 0.0, 1e-12);
  EXPECT_EQ(cb.report.zeroEnergyFull, 1);
  EXPECT_EQ(cb.report.zeroEnergyReduced, 1);
}

TEST(CraigBampton, LinkThatTouchesNothingFloats) {
  // Two bars in one part; only the first has a boundary dof.
  auto part = samples::bar("two bars", 1, 7, 3.0, 2.0);
  auto& m = part.model;
  for (auto* A : {&m.mass, &m.stiffness.own()[0].matrix}) {  // element 4 (nodes 4 and 5) taken out
    const double diagonal = A == &m.mass ? 2.0 / 3 : 3.0;
    A->coeffRef(3, 4) = A->coeffRef(4, 3) = 0.0;
    A->coeffRef(3, 3) -= diagonal;
    A->coeffRef(4, 4) -= diagonal;
  }
  samples::classify(part, {1});
  const auto cb = reduced(part, allModes());
  EXPECT_EQ(cb.basis->partition.blocks.size(), 2u);
  EXPECT_NEAR(cb.basis->eigenvalues[0], 0.0, 1e-12);
  EXPECT_EQ(cb.report.zeroEnergyFull, 2);
  EXPECT_EQ(cb.report.zeroEnergyReduced, 2);
}

TEST(CraigBampton, NegativeEigenvaluesAreKeptAndReported) {
  auto part = barWithInterface();
  Sparse softening = part.model.mass;
  softening *= -0.5;  // omega^2 shifts by -0.5: the lowest mode, 0.23, buckles
  part.model.stiffness.push_back({"softening", softening, 0});
  const auto stable = reduced(barWithInterface(), modes(3));
  const auto buckled = reduced(part, modes(3));
  EXPECT_GT(stable.basis->eigenvalues[0], 0.0);
  EXPECT_LT(buckled.basis->eigenvalues[0], 0.0);
  for (int k = 0; k < 3; ++k)
    EXPECT_NEAR(buckled.basis->eigenvalues[k], stable.basis->eigenvalues[k] - 0.5, 1e-12);
  EXPECT_EQ(buckled.report.negativeModes, 1);
  EXPECT_NE(buckled.report.table().find("omega^2 = "), std::string::npos);
  EXPECT_TRUE(Matrix(buckled.model.stiffness.front().matrix).allFinite());
}

TEST(CraigBampton, MechanismIsNamed) {
  // A beam held at one end in u and v only: it can rotate about that end.
  samples::Frame frame;
  frame.corners = {{1, {0, 0}}, {2, {1, 0}}};
  auto part = samples::framePart("arm", frame, {{1, 2, {11, 12}}});
  part.interface = {samples::find(part.model, model::DofLabel::physical(1, 0)),
                    samples::find(part.model, model::DofLabel::physical(1, 1))};
  try {
    craigBampton()->build(part, modes(2));
    FAIL() << "a mechanism was accepted";
  } catch (const ModelError& error) {
    const std::string sentence = error.what();
    EXPECT_NE(sentence.find("Part \"arm\": its interior is a mechanism with its 2 interface and "
                            "retained dofs fixed"),
              std::string::npos)
        << sentence;
    EXPECT_NE(sentence.find(" of node "), std::string::npos) << sentence;
  }
}

TEST(CraigBampton, CutOffKeepsAllBelow) {
  const auto part = barWithInterface(20);
  const Basis all = craigBampton()->build(part, allModes());
  ModeRequest below;
  below.kind = ModeRequest::Kind::Below;
  below.omegaMax = 0.5 * (std::sqrt(all.eigenvalues[6]) + std::sqrt(all.eigenvalues[7]));
  const Basis some = craigBampton()->build(part, below);
  EXPECT_EQ(some.modes(), 7);
  below.omegaMax = 0.1 * std::sqrt(all.eigenvalues[0]);
  EXPECT_EQ(craigBampton()->build(part, below).modes(), 0);
}

TEST(CraigBampton, MoreModesThanThereAreIsSaid) {
  const auto cb = reduced(barWithInterface(), modes(99));
  EXPECT_EQ(cb.modes, 7);
  ASSERT_EQ(cb.report.remarks.size(), 1u);
  EXPECT_EQ(cb.report.remarks[0], "requested 99 modes, kept all 7");
}

TEST(CraigBampton, PairOfAShaftIsNotCut) {
  // Two equal bars side by side in one part represent the u and v planes of a shaft.
  auto part = samples::bar("shaft", 1, 8, 3.0, 2.0);
  auto& m = part.model;
  const auto doubled = [](const Sparse& A) {
    Triplets entries;
    for (int i = 0; i < A.outerSize(); ++i)
      for (Sparse::InnerIterator it(A, i); it; ++it)
        for (int plane : {0, 1})
          entries.emplace_back(2 * i + plane, 2 * static_cast<int>(it.col()) + plane,
                               it.value() * (plane ? 1.002 : 1.0));
    return samples::square(2 * static_cast<int>(A.rows()), entries);
  };
  m.mass = samples::square(18, [&] {
    Triplets entries;
    for (int i = 0; i < m.mass.outerSize(); ++i)
      for (model::SharedSparse::InnerIterator it(m.mass, i); it; ++it)
        for (int plane : {0, 1})
          entries.emplace_back(2 * i + plane, 2 * static_cast<int>(it.col()) + plane, it.value());
    return entries;
  }());
  m.stiffness.own()[0].matrix = doubled(m.stiffness.own()[0].matrix);
  m.dofs.clear();
  for (int node = 1; node <= 9; ++node)
    for (int plane : {0, 1}) m.dofs.push_back(model::DofLabel::physical(node, plane));
  m.componentNames = {"u", "v"};
  samples::complete(part);
  samples::classify(part, {1, 9});
  EXPECT_EQ(reduced(part, modes(3)).modes, 4);
  EXPECT_EQ(reduced(part, modes(4)).modes, 4);
  ModeRequest strict = modes(3);
  strict.pairTolerance = 1e-5;
  EXPECT_EQ(reduced(part, strict).modes, 3);
  ModeRequest below;
  below.kind = ModeRequest::Kind::Below;
  const auto values = reduced(part, modes(4)).basis->eigenvalues;
  below.omegaMax = 0.5 * (std::sqrt(values[2]) + std::sqrt(values[3]));  // between u and v
  EXPECT_EQ(reduced(part, below).modes, 4);
}

TEST(CraigBampton, ReportSaysWhatWasChecked) {
  const auto parts = samples::loopFrame(8, false);
  const auto cb = reduced(parts[2], modes(5));
  const BasisReport& r = cb.report;
  EXPECT_EQ(r.interface, 6);
  EXPECT_EQ(r.interior, 21);
  EXPECT_EQ(r.modes, 5);
  EXPECT_EQ(r.rank, 11);
  EXPECT_LT(r.staticDefect, 1e-11);
  EXPECT_EQ(r.zeroEnergyFull, 3) << "two translations and a rotation of a plane body";
  EXPECT_EQ(r.zeroEnergyReduced, 3);
  EXPECT_LT(r.orthogonality, 1e-12);
  EXPECT_NEAR(r.explicitStep * r.largestOmega, 2.78, 1e-12);
  EXPECT_EQ(r.rows->size(), 6u + 9u)
      << "six constraint modes, five kept, four more looked at for the cut";
  EXPECT_FALSE(r.rows->back().kept);
  EXPECT_GT(r.firstDroppedHz(), r.cutOffHz());
  const std::string table = r.table();
  for (const char* word :
       {"constraint", "fixed-interface", "kept", "dropped", "above the cut", "RK4"})
    EXPECT_NE(table.find(word), std::string::npos) << word;
  EXPECT_NE(r.table(true).find("theta of node 4"), std::string::npos);
  EXPECT_NE(summaryTable({cb}).find("total"), std::string::npos);
}

TEST(CraigBampton, ChecksNoticeABasisThatIsNotStaticallyExact) {
  const auto part = barWithInterface();
  Basis basis = craigBampton()->build(part, modes(2));
  basis.vectors.coeffRef(4, 0) += 0.3;  // bend a constraint mode
  basis.orthonormal = false;
  const auto spoilt = reduce(part, basis, ReductionOptions(), 0);
  EXPECT_GT(spoilt.report.staticDefect, 1e-3);
  EXPECT_LT(spoilt.report.zeroEnergyReduced, spoilt.report.zeroEnergyFull);
  EXPECT_EQ(spoilt.report.remarks.size(), 2u);
}

TEST(CraigBampton, ChecksNoticeModesThatAreNotOrthonormal) {
  const auto part = barWithInterface();
  Basis basis = craigBampton()->build(part, modes(3));
  Matrix Phi = basis.vectors;
  Phi.col(3) += 1e-6 * Phi.col(2);
  basis.vectors = Phi.sparseView();
  const auto spoilt = reduce(part, basis, ReductionOptions(), 0);
  EXPECT_FALSE(spoilt.report.structureEnforced);
  EXPECT_NEAR(spoilt.report.massDefect, 1e-6, 1e-9);
  EXPECT_NE(Matrix(spoilt.model.mass)(2, 3), 0.0) << "left as projected";
  Phi.col(4) = Phi.col(2);
  basis.vectors = Phi.sparseView();
  EXPECT_THROW(reduce(part, basis, ReductionOptions(), 0), ModelError)
      << "a repeated vector makes the reduced mass singular";
}

}  // namespace CraigBamptonTest
