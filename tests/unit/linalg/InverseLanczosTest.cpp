// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Block Lanczos iteration, partial factors and nested dissection on grids of springs.
#include "linalg/InverseLanczos.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/factor/NestedDissection.hpp"
#include "linalg/factor/PartialFactor.hpp"

namespace InverseLanczosTest {

using namespace tooljoint;
using namespace tooljoint::linalg;

/// Unit springs between the points of an n x n grid and its walls:
/// lambda = 4 - 2 cos(i pi / (n+1)) - 2 cos(j pi / (n+1)), most of them double.
Sparse grid(int n) {
  Triplets entries;
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int i = x + n * y;
      entries.emplace_back(i, i, 4.0);
      if (x > 0) entries.emplace_back(i, i - 1, -1.0), entries.emplace_back(i - 1, i, -1.0);
      if (y > 0) entries.emplace_back(i, i - n, -1.0), entries.emplace_back(i - n, i, -1.0);
    }
  return sparse(n * n, n * n, entries);
}

Vector eigenvalues(int n) {
  std::vector<double> values;
  for (int i = 1; i <= n; ++i)
    for (int j = 1; j <= n; ++j)
      values.push_back(4 - 2 * std::cos(i * constants::pi / (n + 1)) -
                       2 * std::cos(j * constants::pi / (n + 1)));
  std::sort(values.begin(), values.end());
  return Eigen::Map<Vector>(values.data(), sizeOf(values));
}

TEST(InverseLanczos, FindsTheLowestDoubleValuesToo) {
  for (const int n : {12, 30}) {  // dense, and iterated
    const Sparse K = grid(n);
    const Eigen::LDLT<Matrix> factor{Matrix(K)};
    InversePencil pencil;
    pencil.size = n * n;
    pencil.solve = [&](const Matrix& B) { return Matrix(factor.solve(B)); };
    pencil.mass = [](const Matrix& X) { return X; };
    pencil.stiffness = [&] { return Matrix(K); };
    RitzRequest request;
    request.count = 25;
    request.tolerance = 1e-8;
    const auto found = lowestRitzVectors(pencil, request);
    ASSERT_EQ(found.values.size(), 25);
    EXPECT_LT((found.values - eigenvalues(n).head(25)).cwiseAbs().maxCoeff(), 1e-10);
    const Matrix gram = found.vectors.transpose() * (K * found.vectors);
    EXPECT_LT((gram - Matrix::Identity(25, 25)).cwiseAbs().maxCoeff(), 1e-10);
    request.count = n * n;
    request.below = found.values[20] * 1.0001;
    EXPECT_EQ(lowestRitzVectors(pencil, request).values.size(),
              (eigenvalues(n).array() < request.below).count());
  }
}

TEST(InverseLanczos, LeavesOutInfiniteValues) {
  const int n = 20;
  const Sparse K = grid(n);
  const Eigen::LDLT<Matrix> factor{Matrix(K)};
  Vector mass = Vector::Zero(n * n);
  mass.head(15).setOnes();
  InversePencil pencil;
  pencil.size = n * n;
  pencil.solve = [&](const Matrix& B) { return Matrix(factor.solve(B)); };
  pencil.mass = [&](const Matrix& X) { return Matrix(mass.asDiagonal() * X); };
  pencil.stiffness = [&] { return Matrix(K); };
  RitzRequest some;
  some.count = 100;
  const auto iterated = lowestRitzVectors(pencil, some);
  EXPECT_TRUE(iterated.complete);
  EXPECT_EQ(iterated.values.size(), 15);
  EXPECT_EQ(lowestRitzVectors(pencil, {}).values.size(), 15);
}

TEST(PartialFactor, HasSolutionsAndSchurComplement) {
  const int n = 15, inner = 180;
  const Sparse K = grid(n);
  const Matrix full = K;
  const Matrix ii = full.topLeftCorner(inner, inner),
               ib = full.topRightCorner(inner, n * n - inner);
  PartialFactor factor;
  Matrix schur;
  for (int again = 0; again < 2; ++again) {
    ASSERT_TRUE(factor.factor(K, inner, schur));
    const Matrix expected =
        full.bottomRightCorner(n * n - inner, n * n - inner) - ib.transpose() * ii.ldlt().solve(ib);
    EXPECT_LT((schur - expected).cwiseAbs().maxCoeff(), 1e-13);
    const Matrix b = scatteredNumbers(inner, 3, 5);
    EXPECT_LT((ii * factor.solve(b) - b).cwiseAbs().maxCoeff(), 1e-13);
  }
  Sparse indefinite = K;
  indefinite.coeffRef(3, 3) = -1;
  EXPECT_FALSE(factor.factor(indefinite, inner, schur));
}

TEST(NestedDissection, CutsAGridEvenlyByNarrowSeparators) {
  const int n = 40;
  Graph graph;
  graph.offsets.push_back(0);
  const Sparse K = grid(n);
  for (int i = 0; i < n * n; ++i) {
    forEachInRow(K, i, [&](int j, double) {
      if (j != i) graph.neighbours.push_back(j);
    });
    graph.offsets.push_back(sizeOf(graph.neighbours));
    graph.weights.push_back(1);
  }
  const auto cut = dissect(graph, 7);
  int leaves = 0, total = 0;
  for (int i = 0; i < cut.pieces(); ++i) {
    const int size = sizeOf(cut.vertices[at(i)]);
    total += size;
    leaves += cut.leaf[at(i)];
    if (cut.leaf[at(i)] == 0) {
      EXPECT_LE(size, 60) << "a separator";
    }
  }
  EXPECT_EQ(leaves, 7);
  EXPECT_EQ(total, n * n);
  const auto again = dissect(graph, 7);
  EXPECT_EQ(again.vertices, cut.vertices);
  EXPECT_EQ(dissect(graph, 1).pieces(), 1);
}

TEST(NestedDissection, StopsWhereNothingCanBeCut) {
  Graph pair;  // two vertices and an edge
  pair.offsets = {0, 1, 2};
  pair.neighbours = {1, 0};
  pair.weights = {1, 1};
  const auto cut = dissect(pair, 5);
  EXPECT_EQ(cut.pieces(), 1);
}

}  // namespace InverseLanczosTest
