// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rubin's basis of single parts: its space, floating parts, special cases, requests.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/vectors/FreeInterfaceModes.hpp"
#include "tests/support/BasisFamilies.hpp"

namespace RubinTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::modes;

std::unique_ptr<ReductionMethod> rubin() { return makeBasis("Rubin", Teuchos::ParameterList()); }

/// [Phi Psi] by the textbook: all modes, A = 1 - Phi_r Phi_r' M, G with the rigid-body motions
/// grounded, residual flexibility by differences.
Matrix textbookSpace(const model::Substructure& part, const std::vector<int>& kept, int count) {
  const Matrix K = constantStiffness(part.model), M = part.model.mass;
  const auto all = linalg::symmetricPairs(K, M);
  const Vector& lambda = all.values;
  int rigid = 0;
  while (lambda[rigid] < 1e-9 * lambda[lambda.size() - 1] && lambda[rigid] < 1e-4 * lambda[6])
    ++rigid;
  const Matrix R = all.vectors.leftCols(rigid), MR = M * R;
  const Matrix A = Matrix::Identity(K.rows(), K.rows()) - R * MR.transpose();
  Matrix G = A * linalg::inverseOf(K + lambda[rigid + 3] * MR * MR.transpose()) * A.transpose();
  for (int k = rigid; k < count; ++k)
    G -= all.vectors.col(k) * all.vectors.col(k).transpose() / lambda[k];
  Matrix space(K.rows(), count + static_cast<Eigen::Index>(kept.size()));
  space.leftCols(count) = all.vectors.leftCols(count);
  for (std::size_t j = 0; j < kept.size(); ++j) {
    const Vector column = G.col(kept[j]);
    space.col(count + static_cast<Eigen::Index>(j)) = column / std::sqrt(column.dot(M * column));
  }
  return space;
}

/// Largest component, in the mass norm, of a unit column of `a` outside the span of `b`.
double missing(const Matrix& a, const Matrix& b, const Matrix& M) {
  const Matrix L = M.llt().matrixU();
  const Matrix inner =
      (L * b).householderQr().householderQ() * Matrix::Identity(b.rows(), b.cols());
  const Matrix scaled = L * a;
  return ((scaled - inner * (inner.transpose() * scaled)).colwise().norm().array() /
          scaled.colwise().norm().array())
      .maxCoeff();
}

TEST(Rubin, SpansFreeModesAndResidualAttachmentModes) {
  const auto frame = samples::loopFrame(6, false, true);
  for (const std::size_t p :
       {0u, 2u, 3u}) {  // clamped, floating between two parts, floating at the end
    const auto& part = frame[p];
    for (const int count : {4, 7}) {
      const Basis basis = rubin()->build(part, modes(count));
      const Matrix M = part.model.mass,
                   expected = textbookSpace(part, basis.partition.boundary, count);
      ASSERT_EQ(basis.vectors.cols(), expected.cols());
      EXPECT_LT(missing(expected, Matrix(basis.vectors), M), 1e-7) << part.name;
      EXPECT_LT(missing(Matrix(basis.vectors), expected, M), 1e-7) << part.name;
    }
  }
}

TEST(Rubin, HasTheStructureOfCraigBampton) {
  for (const auto& part : samples::loopFrame(6, true, true)) {
    const auto small = reduce(part, rubin()->build(part, modes(5)), ReductionOptions(), 0);
    EXPECT_TRUE(small.report.structureEnforced)
        << part.name << " " << small.report.massDefect << " " << small.report.stiffnessDefect;
    EXPECT_LT(small.report.staticDefect, 1e-9);
    EXPECT_EQ(small.report.rank, small.size());
    EXPECT_TRUE(std::is_sorted(small.basis->eigenvalues.data(),
                               small.basis->eigenvalues.data() + small.basis->eigenvalues.size()));
  }
}

TEST(Rubin, FindsRigidBodyModes) {
  const auto frame = samples::loopFrame(6, false);
  const int expected[4] = {0, 0, 3, 3};
  for (std::size_t p = 0; p < 4; ++p) {
    const auto& part = frame[p];
    const auto free = freeInterfaceModes(part, modes(0));
    EXPECT_EQ(free.rigid(), expected[p]);
    EXPECT_EQ(free.kept, expected[p]);
    const auto basis = rubin()->build(part, modes(5));
    EXPECT_EQ(std::count_if(basis.rows.begin(), basis.rows.end(),
                            [](const auto& row) { return row.kind == "rigid-body" && row.kept; }),
              expected[p]);
  }
}

// The skew stiffness of a torque acts on rigid-body motion, which is then not free of forces.
TEST(Rubin, SkewStiffnessLeavesNoRigidBodyModeItActsOn) {
  const auto part = samples::loopFrame(6, true)[2];
  const Matrix K = constantStiffness(part.model);
  const auto free = freeInterfaceModes(part, modes(4));
  int rigid = 0;
  for (const auto& mode : free.vectors) {
    if (!mode.rigid) continue;
    EXPECT_LT((K * mode.shape).norm(), 1e-6 * (K.cwiseAbs() * mode.shape.cwiseAbs()).norm());
    ++rigid;
  }
  EXPECT_EQ(rigid, 2) << "of three without the torque";
  const auto small = reduce(part, rubin()->build(part, modes(4)), ReductionOptions(), 0);
  EXPECT_LT(small.report.staticDefect, 1e-9);
}

TEST(Rubin, SpecialParts) {
  auto pair = samples::bar("pair", 1, 1, 3.0, 2.0);  // no interior
  samples::classify(pair, {1, 2});
  const auto rigid = reduce(pair, rubin()->build(pair, modes(5)), ReductionOptions(), 0);
  EXPECT_EQ(rigid.size(), 2);
  EXPECT_LT((Matrix(rigid.model.mass) - Matrix(pair.model.mass)).norm(), 1e-14);
  auto lone = samples::bar("lone", 1, 8, 3.0, 2.0);  // no interface: its own modes
  samples::classify(lone, {});
  const auto free = reduce(lone, rubin()->build(lone, modes(4)), ReductionOptions(), 0);
  const Vector exact = samples::eigenvalues(lone.model);
  ASSERT_EQ(free.modes, 4);
  for (int k = 0; k < 4; ++k) EXPECT_NEAR(free.basis->eigenvalues[k], exact[k], 1e-10 * exact[8]);
  auto whole = lone;  // all dofs kept
  samples::classify(whole, {1}, {2, 3, 4, 5, 6, 7, 8, 9});
  EXPECT_EQ(reduce(whole, rubin()->build(whole, {}), ReductionOptions(), 0).size(), 9);
}

TEST(Rubin, TotalAndCutOffCountFreeModes) {
  const auto frame = samples::loopFrame(8, false);
  ReductionOptions options;
  options.basis = "Rubin";
  options.modes.kind = ModeRule::Kind::Total;
  options.modes.total = 16;
  int total = 0;
  for (const auto& part : reduceAll(frame, *rubin(), options)) {
    total += part.modes;
    EXPECT_LT(part.report.staticDefect, 1e-9) << "a basis with fewer modes is built anew";
  }
  EXPECT_GE(total, 16);
  EXPECT_LE(total, 18);
  options.modes.kind = ModeRule::Kind::CutOff;
  options.modes.cutOffHz = 0;
  EXPECT_EQ(reduceAll(frame, *rubin(), options)[2].modes, 3)
      << "rigid-body modes are kept below any cut";
  options.modes.kind = ModeRule::Kind::InterfaceMass;
  options.modes.fraction = 0.5;
  EXPECT_THROW(reduceAll(frame, *rubin(), options), DeckError);
}

TEST(Rubin, StaticStateIsKept) {
  auto part = samples::loopFrame(6, true, true)[2];
  Vector reference(part.model.size());
  for (Eigen::Index i = 0; i < reference.size(); ++i)
    reference[i] = 1e-2 * std::sin(0.7 * static_cast<double>(i));
  part.reference = part.model.initialDisplacement = reference;
  const auto small = reduce(part, rubin()->build(part, modes(4)), ReductionOptions(), 0);
  EXPECT_TRUE(small.model.initialDisplacement.isZero(0.0));
  EXPECT_EQ((small.offset - reference).norm(), 0.0);
}

}  // namespace RubinTest
