// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/DirectSolver.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>
#include <limits>
#include <utility>

#include "Models.hpp"
#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/blocks/ChainFactor.hpp"

namespace tooljoint::linalg {
namespace DirectSolverTest {

using tooljoint::testing::beam;
using tooljoint::testing::springChain;
using tooljoint::testing::transport;

std::string message(const std::function<void()>& work) {
  try {
    work();
  } catch (const ModelError& error) {
    return error.what();
  }
  return "nothing was thrown";
}

const DofNamer spoken = [](int i) { return "<" + std::to_string(i) + ">"; };

void expectSolved(const Sparse& A, double tolerance = 1e-10, double residual = 1e-14) {
  const DirectSolver solver(A);
  const Vector b = scatteredNumbers(A.rows(), 1, 1);
  const Vector x = solver.solve(b);
  EXPECT_LT((b - A * x).norm() / b.norm(), tolerance);
  EXPECT_LT(solver.lastResidual(), residual);
  const Vector exact = DenseLu(Matrix(A)).solve(b);
  EXPECT_LT((x - exact).norm() / exact.norm(), 1e-6);
}

TEST(DirectSolver, SolvesSymmetricUnsymmetricAndIndefiniteSystems) {
  const auto held = springChain(300, 1e7, 2.0);
  expectSolved(held.K);
  expectSolved(transport(300));
  // beyond the first modes K - sigma M is indefinite
  expectSolved(Sparse(held.K - 1e5 * held.M));
  expectSolved(beam(50, 100.0, 3e6).K);
}

TEST(DirectSolver, SolvesManyColumnsLikeOneByOne) {
  const Sparse A = transport(120);
  const DirectSolver solver(A);
  const Matrix B = scatteredNumbers(120, 9, 2);
  const Matrix X = solver.solve(B);
  ASSERT_EQ(X.cols(), 9);
  for (int j = 0; j < 9; ++j) {
    const Vector alone = solver.solve(B.col(j));
    EXPECT_LT((X.col(j) - alone).norm(), 1e-13 * alone.norm());
  }
  const Vector ofExpression = solver.solve(2.0 * B.col(0) - B.col(0));
  EXPECT_LT((ofExpression - X.col(0)).norm(), 1e-13 * X.col(0).norm());
}

TEST(DirectSolver, SolvesTheTransposedSystem) {
  const Sparse A = transport(200);
  DirectSolver solver(A);
  const Vector b = scatteredNumbers(200, 1, 3);
  const Vector y = solver.solveTransposed(b);
  EXPECT_LT((b - A.transpose() * y).norm(), 1e-12 * b.norm());
  EXPECT_GT((b - A * y).norm(), 0.1 * b.norm());  // and not the plain one
  const Sparse twice = 2.0 * A;
  solver.refactor(twice);  // must not use the old transpose
  EXPECT_LT((b - twice.transpose() * Vector(solver.solveTransposed(b))).norm(), 1e-12 * b.norm());
}

TEST(DirectSolver, SolvesRowsAndColumnsOfVeryDifferentSize) {
  const int n = 80;
  Vector scale(n);
  for (int i = 0; i < n; ++i) scale[i] = std::pow(10.0, (i % 7) - 3);
  const Sparse A = scale.asDiagonal() * transport(n) * scale.asDiagonal();
  const Vector exact = scatteredNumbers(n, 1, 4);
  const Vector x = DirectSolver(A).solve(A * exact);
  EXPECT_LT(((x - exact).cwiseProduct(scale)).norm(), 1e-11 * exact.cwiseProduct(scale).norm());
}

TEST(DirectSolver, AcceptsBadlyConditionedMatricesThatAreNotSingular) {
  // condition number about 1e12
  const auto fine = beam(1000, 1000.0, 3e6);
  const DirectSolver solver(fine.K);
  solver.solve(Vector::Ones(fine.K.rows()));
  EXPECT_LT(solver.lastResidual(), 1e-14);
}

TEST(DirectSolver, RefactorsWithTheSameAndWithAnotherPattern) {
  const Sparse first = transport(60);
  DirectSolver solver(first);
  const Vector b = Vector::Ones(60);
  for (const Sparse& A :
       {Sparse(3.0 * first), springChain(60, 5.0, 1.0).K, Sparse(transport(90)), first}) {
    solver.refactor(A);
    ASSERT_EQ(solver.size(), A.rows());
    const Vector rhs = Vector::Ones(A.rows());
    const Vector x = solver.solve(rhs);
    EXPECT_LT((rhs - A * x).norm(), 1e-11 * rhs.norm());
  }
  EXPECT_THROW(solver.refactor(springChain(60, 5.0, 1.0, true).K), ModelError);
  solver.refactor(first);
  EXPECT_LT((b - first * Vector(solver.solve(b))).norm(), 1e-11 * b.norm());
  DirectSolver moved(std::move(solver));
  EXPECT_LT((b - first * Vector(moved.solve(b))).norm(), 1e-11 * b.norm());
}

/// Nodes of six dofs in a row, coupled to their neighbours by full unsymmetric blocks. The dominant
/// entries are in the diagonal blocks, or in the coupling of nodes 0 and 1, 2 and 3 ...
Sparse nodeChain(int nodes, double diagonal, double pairs = 0.0) {
  const Matrix numbers = scatteredNumbers(18 * nodes, 6, 11);
  Triplets entries;
  for (int n = 0; n < nodes; ++n)
    for (int i = 0; i < 6; ++i)
      for (int j = 0; j < 6; ++j) {
        const int row = 6 * n + i, column = 6 * n + j;
        entries.emplace_back(row, column,
                             diagonal * ((i == j ? 20.0 : 0.0) + numbers(18 * n + i, j)));
        if (n == 0) continue;
        const double pair = i == j && n % 2 == 1 ? pairs : 0.0;
        entries.emplace_back(row, column - 6, pair + numbers(18 * n + 6 + i, j));
        entries.emplace_back(row - 6, column, pair + numbers(18 * n + 12 + i, j));
      }
  return testing::assembled(6 * nodes, entries);
}

TEST(DirectSolver, FactorsALongChainOfNodesByItsBlocks) {
  const Sparse A = nodeChain(200, 1.0);
  ASSERT_TRUE(ChainFactor::isChain(A));
  EXPECT_FALSE(ChainFactor::isChain(springChain(1200, 1.0, 1.0).K));
  expectSolved(A);
  DirectSolver solver(A);
  // two factors of three blocks of 36 per node, and nothing else
  EXPECT_LT(solver.factorEntries(), 200 * 3 * 36 * 1.3);
  const Sparse other = nodeChain(200, 3.0);
  solver.refactor(other);
  const Vector b = scatteredNumbers(1200, 1, 3);
  EXPECT_LT((b - other * solver.solve(b)).norm(), 1e-13 * b.norm());
  EXPECT_LT((b - other.transpose() * solver.solveTransposed(b)).norm(), 1e-13 * b.norm());
}

TEST(DirectSolver, SolvesChainsWhoseDiagonalBlocksCannotBePivots) {
  for (const double diagonal : {0.0, 1e-18, 1e-14}) expectSolved(nodeChain(200, diagonal, 20.0));
}

TEST(DirectSolver, NamesTheDofOfALongChainThatNothingHolds) {
  Sparse A = nodeChain(200, 1.0);
  for (int k = 0; k < A.rows(); ++k)
    for (Sparse::InnerIterator it(A, k); it; ++it)
      if (k == 603 || it.col() == 603) it.valueRef() = 0.0;
  const std::string text = message([&] { DirectSolver(A, spoken); });
  EXPECT_NE(text.find("singular"), std::string::npos) << text;
  EXPECT_NE(text.find("<603>"), std::string::npos) << text;
}

TEST(DirectSolver, HandlesEmptyAndSingleSystems) {
  EXPECT_EQ(DirectSolver(Sparse(0, 0)).solve(Vector(0)).size(), 0);
  Sparse one(1, 1);
  one.insert(0, 0) = 4.0;
  EXPECT_DOUBLE_EQ(DirectSolver(one).solve(Vector::Constant(1, 2.0))[0], 0.5);
  EXPECT_EQ(DirectSolver(one).solve(Matrix(1, 0)).cols(), 0);
}

TEST(DirectSolver, NamesTheDofOfASingularMatrix) {
  // a held chain of 5 and a floating one of 4: the motion without resistance is in dofs 5 to 8
  const Sparse held = springChain(5, 2.0, 1.0).K, floating = springChain(4, 3.0, 1.0, true).K;
  Triplets both;
  for (int i = 0; i < 5; ++i)
    for (Sparse::InnerIterator it(held, i); it; ++it) both.emplace_back(i, it.col(), it.value());
  for (int i = 0; i < 4; ++i)
    for (Sparse::InnerIterator it(floating, i); it; ++it)
      both.emplace_back(5 + i, 5 + it.col(), it.value());
  const std::string text = message([&] { DirectSolver(testing::assembled(9, both), spoken); });
  EXPECT_NE(text.find("singular"), std::string::npos) << text;
  EXPECT_NE(text.find("<5>"), std::string::npos) << text;
  EXPECT_NE(message([&] { DirectSolver(testing::assembled(9, both)); }).find("dof 6"),
            std::string::npos);
}

TEST(DirectSolver, FindsMatricesThatAreSingularUpToRounding) {
  for (const int elements : {3, 20, 60, 200}) {
    // A rotation about one end moves the other end most; a free beam has no pivot that is exactly
    // zero.
    const auto free = beam(elements, 170.3, 2.9e6, 1, true);
    const std::string text = message([&] { DirectSolver(free.K, spoken); });
    EXPECT_NE(text.find("singular"), std::string::npos) << elements << ": " << text;
  }
}

TEST(DirectSolver, NamesTheDofWithoutAnyStiffness) {
  Triplets entries{{0, 0, 1.0}, {1, 1, 2.0}, {2, 2, 0.0}, {3, 3, 1.0}};
  EXPECT_NE(message([&] { DirectSolver(testing::assembled(4, entries), spoken); }).find("<2>"),
            std::string::npos);
  // an empty column (but not row): the motion of dof 1 causes no force
  Triplets column{{0, 0, 1.0}, {1, 0, 2.0}, {2, 2, 1.0}};
  EXPECT_NE(message([&] { DirectSolver(testing::assembled(3, column), spoken); }).find("<1>"),
            std::string::npos);
}

TEST(DirectSolver, NamesEntriesThatAreNotFinite) {
  for (const double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    Sparse A = springChain(6, 1.0, 1.0).K;
    A.coeffRef(3, 4) = bad;
    const std::string text = message([&] { DirectSolver(A, spoken); });
    EXPECT_NE(text.find("<3>"), std::string::npos) << text;
    EXPECT_NE(text.find("<4>"), std::string::npos) << text;
    const DirectSolver solver(springChain(6, 1.0, 1.0).K, spoken);
    Vector b = Vector::Ones(6);
    b[2] = bad;
    EXPECT_NE(message([&] { solver.solve(b); }).find("<2>"), std::string::npos);
  }
}

TEST(DirectSolver, RefusesSizesThatDoNotFit) {
  EXPECT_THROW(DirectSolver(Sparse(3, 4)), ModelError);
  EXPECT_THROW(DirectSolver(springChain(6, 1.0, 1.0).K).solve(Vector::Ones(5)), ModelError);
}

TEST(DirectSolver, ChecksEverySolution) {
  const Sparse A = transport(50);
  const Vector b = scatteredNumbers(50, 1, 5);
  const Vector x = DirectSolver(A).solve(b);
  EXPECT_LT(backwardError(A, x, b), 1e-15);
  Vector wrong = x;
  wrong[17] += 1e-6 * x.norm();
  EXPECT_GT(backwardError(A, wrong, b), 1e-9);
  wrong[17] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_GT(backwardError(A, wrong, b), 1.0);
  DirectSolverOptions impossible;
  impossible.tolerance = 1e-30;
  EXPECT_THROW(DirectSolver(A, {}, impossible).solve(b), ModelError);
}

}  // namespace DirectSolverTest
}  // namespace tooljoint::linalg
