// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Grouped rows against the sparse product: shared columns, scattered rows, single entries, empty
/// rows, an empty matrix.
#include "linalg/blocks/GroupedRows.hpp"

#include <gtest/gtest.h>
#include <random>

namespace tooljoint::linalg {
namespace GroupedRowsTest {

TEST(GroupedRows, multiplyAsTheSparseMatrix) {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Triplets entries;
  for (int row = 0; row < 60; ++row) {
    if (row % 7 == 6) continue;                             // nothing
    if (row % 7 == 5) entries.emplace_back(row, row, 1.0);  // a dof that is kept
    if (row % 7 > 4) continue;
    const int part = row / 20, family = row % 2;  // two families of three parts, rows interleaved
    for (int j = family; j < 12; j += 2) entries.emplace_back(row, 20 * part + j, uniform(random));
  }
  Sparse A(60, 60);
  A.setFromTriplets(entries.begin(), entries.end());
  const GroupedRows grouped(A);
  EXPECT_EQ(grouped.rows(), 60);
  Vector y = Vector::Constant(60, 9.0);
  for (int repeat = 0; repeat < 3; ++repeat) {
    const Vector x = Vector::NullaryExpr(60, [&] { return uniform(random); });
    grouped.multiply(x, y);
    EXPECT_LT((y - A * x).cwiseAbs().maxCoeff(), 1e-15);
    const Vector second = 2.0 * x, third = -x;
    Vector twice, minus;
    grouped.multiply({&x, &second, &third}, {&y, &twice, &minus});
    EXPECT_LT((y - A * x).cwiseAbs().maxCoeff(), 1e-15);
    EXPECT_EQ(twice, Vector(2.0 * y));
    EXPECT_EQ(minus, Vector(-y));
  }
}

TEST(GroupedRows, ofNothing) {
  Vector y;
  GroupedRows(Sparse(0, 0)).multiply(Vector(0), y);
  EXPECT_EQ(y.size(), 0);
  GroupedRows(Sparse(3, 2)).multiply(Vector::Ones(2), y);
  EXPECT_EQ(y, Vector(Vector::Zero(3)));
}

}  // namespace GroupedRowsTest
}  // namespace tooljoint::linalg
