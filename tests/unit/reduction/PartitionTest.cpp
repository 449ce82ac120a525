// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Sorting the dofs of a part, and the messages for dofs that cannot be sorted.
#include "reduction/part/Partition.hpp"

#include <algorithm>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "tests/support/SampleParts.hpp"

namespace PartitionTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

std::string refusal(const model::Substructure& part) {
  try {
    partition(part);
  } catch (const ModelError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Partition, SortsInterfaceRetainedInterior) {
  auto part = samples::bar("bar", 1, 6, 1.0, 1.0);
  samples::classify(part, {1, 7}, {4});
  const Partition p = partition(part);
  EXPECT_EQ(p.boundary, (std::vector<int>{0, 6, 3}));
  EXPECT_EQ(p.interior, (std::vector<int>{1, 2, 4, 5}));
}

TEST(Partition, FindsTheBlocksBetweenBoundaryDofs) {
  auto part = samples::bar("bar", 1, 6, 1.0, 1.0);
  samples::classify(part, {1, 7}, {4});
  const Partition p = partition(part);
  EXPECT_EQ(p.blocks, (std::vector<std::vector<int>>{{0, 1}, {2, 3}}));
  EXPECT_EQ(p.touched, (std::vector<std::vector<int>>{{0, 2}, {1, 2}}))
      << "indices into boundary = {node 1, node 7, node 4}";
}

TEST(Partition, MassAloneAlsoCouples) {
  auto part = samples::bar("bar", 1, 3, 1.0, 1.0);
  part.model.stiffness.own().front().matrix = Sparse(4, 4);  // no stiffness at all
  samples::classify(part, {1});
  EXPECT_EQ(partition(part).blocks.size(), 1u);
  EXPECT_TRUE(partition(part).touched.front().empty());
}

TEST(Partition, OnlyTheConstantStiffnessMakesTheBasis) {
  auto part = samples::bar("bar", 1, 2, 3.0, 1.0);
  auto& m = part.model;
  m.stiffness.push_back({"rate", m.stiffness.front().matrix, m.lawIndex(samples::spinRate())});
  m.stiffness.push_back({"foundation", m.mass, 0});
  const Matrix expected = Matrix(m.stiffness[0].matrix) + Matrix(m.mass);
  EXPECT_LT((Matrix(constantStiffness(m)) - expected).norm(), 1e-15);
}

TEST(Partition, RefusesWrongPositions) {
  auto part = samples::bar("shaft", 1, 3, 1.0, 1.0);
  part.interface = {4};
  EXPECT_EQ(refusal(part),
            "Part \"shaft\": position 4 of its interface dofs is outside its 4 dofs.");
  part.interface = {2, 1};
  EXPECT_EQ(refusal(part),
            "Part \"shaft\": position 1 of its interface dofs is not in increasing order. Sort the "
            "positions.");
  part.interface = {1};
  part.retained = {1};
  EXPECT_EQ(refusal(part),
            "Part \"shaft\": position 1 of its retained dofs (u of node 2) appears twice among its "
            "interface and retained dofs.");
}

TEST(Partition, RefusesWrongStatesAndMasses) {
  auto part = samples::bar("shaft", 1, 3, 1.0, 1.0);
  part.reference = Vector::Zero(3);
  EXPECT_EQ(refusal(part), "Part \"shaft\": its reference state has 3 entries for 4 dofs.");
  part.reference = Vector();
  part.model.mass.coeffRef(0, 1) += 0.5;
  EXPECT_EQ(refusal(part), "Part \"shaft\": its mass matrix is not symmetric.");
  part.model.mass.coeffRef(0, 1) = std::nan("");
  EXPECT_EQ(refusal(part),
            "Part \"shaft\": The second-order model is inconsistent: the mass matrix has an entry "
            "that is not finite.");
}

TEST(Partition, BlockPicksRowsAndColumns) {
  Sparse A = Matrix(Matrix::Random(5, 5)).sparseView();
  const Matrix dense = A;
  const Sparse entries = block(A, {3, 0}, {4, 2, 1});
  const Matrix picked = entries;
  for (int i = 0; i < 2; ++i) {
    for (int j = 0; j < 3; ++j)
      EXPECT_EQ(picked(i, j), dense(i == 0 ? 3 : 0, j == 0 ? 4 : j == 1 ? 2 : 1));
    const int* row = entries.innerIndexPtr() + entries.outerIndexPtr()[i];
    EXPECT_TRUE(
        std::is_sorted(row, row + entries.outerIndexPtr()[i + 1] - entries.outerIndexPtr()[i]));
  }
}

/// A large part without boundary stores each matrix once.
TEST(Partition, TheInteriorOfAPartWithoutBoundaryIsTheMatrixItself) {
  const model::SharedSparse A = Sparse(Matrix(Matrix::Random(3, 3)).sparseView());
  Partition whole;
  whole.size = 3;
  whole.interior = {0, 1, 2};
  EXPECT_TRUE(interiorOf(whole, A).sharesWith(A));
  whole.boundary = {1};
  whole.interior = {0, 2};
  const Matrix inner = interiorOf(whole, A).sparse();
  EXPECT_EQ(inner.rows(), 2);
  EXPECT_EQ(inner(1, 0), Matrix(A.sparse())(2, 0));
}

}  // namespace PartitionTest
