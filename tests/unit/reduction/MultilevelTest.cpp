// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The basis "Multilevel" on blocks of hexahedra against modes of the whole, with all modes and
/// with few, of clamped, free, massless, indefinite and divided parts.
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "linalg/trilinos/SemidefiniteModes.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/multilevel/TreeModes.hpp"
#include "tests/support/BasisFamilies.hpp"
#include "tests/support/SolidBlock.hpp"

namespace MultilevelTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::modes;
using samples::solidBlock;

std::unique_ptr<ReductionMethod> multilevel(int parts, double cutOff = 2.5, int corrections = 0,
                                            double accuracy = 1e-6) {
  Teuchos::ParameterList list("Reduction");
  auto& own = list.sublist("Multilevel");
  own.set("Parts", parts);
  own.set("Cut-off Factor", cutOff);
  own.set("Corrections", corrections);
  own.set("Accuracy", accuracy);
  return MethodRegistry::instance().make("Multilevel", own);
}

/// omega^2 of the lowest modes of the interior of a part.
Vector exact(const model::Substructure& part, int count) {
  const PartView view(part);
  return linalg::lowestFiniteModes(view.symmetricInteriorStiffness(), view.interiorMass(), count)
      .values;
}

double largestError(const Vector& found, const Vector& right) {
  const auto n = std::min(found.size(), right.size());
  return (found.head(n).cwiseQuotient(right.head(n)).array() - 1).abs().maxCoeff() / 2;
}

/// The same modes by the tree, with their estimates.
TreeModes ofTree(const model::Substructure& part, int parts, int count,
                 const TreeModesOptions& options) {
  const Sparse K = constantStiffness(part.model), M = part.model.mass;
  std::vector<int> nodes;
  for (int i = 0; i < part.model.size(); ++i) nodes.push_back(i / 3);
  const auto tree = std::make_shared<const SubstructureTree>(cutIntoTree(K, M, nodes, parts));
  return treeModes(K, M, *eliminate(tree, K, M), modes(count), options);
}

TEST(Multilevel, TreeSeparatesItsPieces) {
  const auto part = solidBlock(12, 3, 3);
  const Sparse K = constantStiffness(part.model);
  std::vector<int> nodes;
  for (int i = 0; i < part.model.size(); ++i) nodes.push_back(i / 3);
  for (const int parts : {1, 2, 5, 8, 16}) {
    const auto tree = cutIntoTree(K, part.model.mass, nodes, parts);
    EXPECT_EQ(tree.leaves(), parts);
    forEachEntry(K, [&](int i, int j, double) {
      const auto& a = tree.pieces[at(tree.pieceOf[at(i)])].path;
      const auto& b = tree.pieces[at(tree.pieceOf[at(j)])].path;
      EXPECT_TRUE(contains(a, b.back()) || contains(b, a.back())) << i << " " << j;
    });
    for (int i = 0; i + 2 < tree.dofs(); i += 3)
      EXPECT_EQ(tree.pieceOf[at(i)], tree.pieceOf[at(i + 2)]) << "a node is cut";
  }
}

// With Schur complements the factors would be several times larger.
TEST(Multilevel, LeavesKeepTheFactorsOfTheirInteriorAlone) {
  const auto part = solidBlock(12, 3, 3);
  const Sparse K = constantStiffness(part.model), &M = part.model.mass;
  std::vector<int> nodes;
  for (int i = 0; i < part.model.size(); ++i) nodes.push_back(i / 3);
  const auto tree = std::make_shared<const SubstructureTree>(cutIntoTree(K, M, nodes, 4));
  const auto factor = eliminate(tree, K, M);
  int leaves = 0;
  for (int i = 0; i < sizeOf(tree->pieces); ++i) {
    const auto& piece = tree->pieces[at(i)];
    if (!piece.leaf) continue;
    ++leaves;
    Matrix none;
    linalg::PartialFactor alone;
    ASSERT_TRUE(alone.factor(block(K, piece.dofs, piece.dofs), sizeOf(piece.dofs), none));
    EXPECT_EQ(factor->piece(i).sparse.entries(), alone.entries());
  }
  EXPECT_EQ(leaves, 4);
}

TEST(Multilevel, AllModesAreThoseOfTheWhole) {
  const auto part = solidBlock(8, 2, 2);
  const Vector whole = exact(part, part.model.size());
  for (const int parts : {1, 4, 8, 16}) {
    const Basis basis = multilevel(parts)->build(part, {});
    EXPECT_TRUE(basis.complete);
    ASSERT_EQ(basis.modes(), part.model.size());
    EXPECT_LT(largestError(basis.eigenvalues, whole), 1e-9) << parts;
  }
}

TEST(Multilevel, ErrorsFallWithTheCutOffAndStayBelowTheEstimates) {
  const auto part = solidBlock(16, 4, 3);
  constexpr int count = 12;
  const Vector whole = exact(part, count);
  for (const int parts : {4, 16}) {
    double before = 1;
    for (const double factor : {1.5, 2.5, 5.0}) {
      const TreeModes found = ofTree(part, parts, count, {factor, 1e-12, 0});
      double worst = 0;
      for (int j = 0; j < count; ++j) {
        const double error = std::sqrt(found.values[j] / whole[j]) - 1;
        EXPECT_GT(error, -1e-10);
        const double bound = error < 0.01 ? 0.99 : 0.5;  // large errors change the order of modes
        EXPECT_GT(found.errors[j] + 1e-11, bound * error) << parts << " " << factor << " " << j;
        EXPECT_LT(found.errors[j], 3 * error + 1e-10) << parts << " " << factor << " " << j;
        worst = std::max(worst, error);
      }
      EXPECT_LT(worst, before) << parts << " " << factor;
      before = worst;
    }
    EXPECT_LT(before, 3e-3);
  }
}

TEST(Multilevel, CorrectionsReachTheAccuracy) {
  const auto part = solidBlock(16, 4, 3);
  constexpr int count = 12;
  const Vector whole = exact(part, count);
  int most = 0;
  for (const double accuracy : {1e-3, 1e-5, 1e-7}) {
    const TreeModes found = ofTree(part, 8, count, {2.0, accuracy, 10});
    EXPECT_LE(found.errors.head(count).maxCoeff(), accuracy);
    EXPECT_LE(largestError(found.values, whole), accuracy);
    EXPECT_GE(found.corrections, most);
    most = found.corrections;
  }
  EXPECT_GT(most, 1);
  const TreeModes few = ofTree(part, 8, count, {2.0, 1e-7, 1});
  EXPECT_EQ(few.corrections, 1);
  for (int j = 0; j < count; ++j)
    EXPECT_GT(few.errors[j] + 1e-11, 0.99 * (std::sqrt(few.values[j] / whole[j]) - 1)) << j;
}

TEST(Multilevel, InaccurateModesAreSaid) {
  const Basis basis = multilevel(8, 1.0, 0)->build(solidBlock(12, 3, 2), modes(12));
  ASSERT_FALSE(basis.remarks.empty());
  EXPECT_NE(basis.remarks.back().find("Accuracy"), std::string::npos) << basis.remarks.back();
}

TEST(Multilevel, ModesBelowAFrequency) {
  const auto part = solidBlock(12, 3, 2);
  const Vector whole = exact(part, 20);
  ModeRequest request;
  request.kind = ModeRequest::Kind::Below;
  request.omegaMax = std::sqrt(0.5 * (whole[11] + whole[12]));
  const Basis basis = multilevel(6, 2.5, 5)->build(part, request);
  EXPECT_EQ(basis.modes(), roundUp(whole, 12, request.pairTolerance));
  EXPECT_LT(largestError(basis.eigenvalues, whole), 1e-6);
}

TEST(Multilevel, FreePartsKeepTheirRigidBodyModes) {
  const auto part = solidBlock(12, 3, 2, true);
  const Vector whole = exact(part, 16);
  const Basis basis = multilevel(5, 2.5, 5)->build(part, modes(16));
  for (int j = 0; j < 6; ++j) EXPECT_LT(std::abs(basis.eigenvalues[j]), 1e-6 * whole[6]);
  EXPECT_LT(largestError(basis.eigenvalues.segment(6, 10), whole.segment(6, 10)), 1e-6);
}

TEST(Multilevel, MasslessDofsAndIndefiniteStiffness) {
  auto part = solidBlock(10, 3, 2);
  Vector keep = Vector::Ones(part.model.size());
  for (int i = 1; i < keep.size(); i += 3) keep[i] = 0;
  part.model.mass = Sparse(keep.asDiagonal() * Sparse(part.model.mass) * keep.asDiagonal());
  part.model.mass = withoutZeros(part.model.mass);
  EXPECT_LT(
      largestError(multilevel(5, 2.5, 6)->build(part, modes(10)).eigenvalues, exact(part, 10)),
      1e-6);

  auto buckled = solidBlock(10, 3, 2);
  const Vector whole = exact(buckled, 10);
  const double shift = 0.5 * (whole[1] + whole[2]);
  buckled.model.stiffness.own()[0].matrix =
      Sparse(constantStiffness(buckled.model) - shift * Sparse(buckled.model.mass));
  const Vector found = multilevel(5, 2.5, 6)->build(buckled, modes(10)).eigenvalues;
  EXPECT_LT(found[1], 0);
  EXPECT_GT(found[2], 0);
  EXPECT_LT((found.head(10) - (whole.array() - shift).matrix()).cwiseAbs().maxCoeff(),
            1e-5 * whole[9]);
}

TEST(Multilevel, TwoBodiesInOnePart) {
  const auto one = solidBlock(6, 2, 2), other = solidBlock(5, 2, 2, true);
  auto part = one;
  const int n = one.model.size(), m = other.model.size();
  for (auto label : other.model.dofs)
    part.model.dofs.push_back({label.kind, label.entity + 10000, label.component});
  const auto joined = [&](const Sparse& a, const Sparse& b) {
    Triplets entries;
    forEachEntry(a, [&](int i, int j, double value) { entries.emplace_back(i, j, value); });
    forEachEntry(b, [&](int i, int j, double value) { entries.emplace_back(n + i, n + j, value); });
    return sparse(n + m, n + m, entries);
  };
  part.model.stiffness.own()[0].matrix =
      joined(constantStiffness(one.model), constantStiffness(other.model));
  part.model.mass = joined(one.model.mass, other.model.mass);
  samples::complete(part);
  const Vector whole = exact(part, 14);
  const Basis basis = multilevel(4, 2.5, 6)->build(part, modes(14));
  EXPECT_LT(std::abs(basis.eigenvalues[5]), 1e-6 * whole[6]);
  EXPECT_LT(largestError(basis.eigenvalues.segment(6, 8), whole.segment(6, 8)), 1e-6);
}

TEST(Multilevel, ReducedPartIsThatOfCraigAndBampton) {
  auto part = solidBlock(12, 3, 2);
  samples::classify(part, {13, 26}, {39});  // nodes of the free end
  ASSERT_EQ(part.interface.size(), 6u);
  ReductionOptions options;
  const auto cut = reduce(part, multilevel(6, 3.0, 10, 1e-12)->build(part, modes(8)), options, 0);
  const auto uncut =
      reduce(part, makeBasis("Craig-Bampton", Teuchos::ParameterList())->build(part, modes(8)),
             options, 0);
  EXPECT_TRUE(cut.report.structureEnforced);
  EXPECT_LT(cut.report.staticDefect, 1e-8);
  const auto difference = [](const Sparse& a, const Sparse& b) {
    return (Matrix(a) - Matrix(b)).norm() / Matrix(b).norm();
  };
  EXPECT_LT(difference(cut.model.stiffnessAt(0), uncut.model.stiffnessAt(0)), 1e-8);
  EXPECT_LT(difference(cut.model.mass, uncut.model.mass), 1e-6);
}

TEST(Multilevel, InteriorsOnAHingeHaveRigidBodyModes) {
  auto part = solidBlock(6, 2, 2, true);
  samples::classify(part, {1});  // three dofs do not hold a body
  const Basis basis = multilevel(3, 2.5, 6)->build(part, modes(6));
  ASSERT_GE(basis.modes(), 6);
  for (int j = 0; j < 3; ++j)
    EXPECT_LT(std::abs(basis.eigenvalues[j]), 1e-6 * basis.eigenvalues[3]);
  const auto reduced = reduce(part, basis, ReductionOptions(), 0);
  EXPECT_EQ(reduced.report.zeroEnergyReduced, 6);
}

}  // namespace MultilevelTest
