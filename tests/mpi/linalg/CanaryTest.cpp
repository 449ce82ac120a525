// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Every solver of the toolkit on every rank of a job of several ranks. KLU2 of Trilinos 13.2
/// silently returns wrong solutions for matrices on communicators of two and more ranks, and for
/// its own transposed solve. These tests fail if a solver of the toolkit uses such a communicator,
/// and hang if a solver waits for another rank.
#include <gtest/gtest.h>
#include <mpi.h>
#include <vector>

#include "../../unit/linalg/Models.hpp"
#include "../../unit/statics/Problems.hpp"
#include "common/Error.hpp"
#include "linalg/Deterministic.hpp"
#include "linalg/trilinos/DirectSolver.hpp"
#include "linalg/trilinos/EigenSolver.hpp"
#include "statics/NewtonSolver.hpp"

namespace tooljoint::linalg {
namespace CanaryTest {

using testing::beam;
using testing::springChain;
using testing::transport;

int rank() {
  int value = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &value);
  return value;
}

/// The numbers of rank 0 on every rank. Collective.
std::vector<double> ofRankZero(const Matrix& mine) {
  std::vector<double> numbers(mine.data(), mine.data() + mine.size());
  MPI_Bcast(numbers.data(), static_cast<int>(numbers.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return numbers;
}

void expectSameOnAllRanks(const Matrix& mine) {
  EXPECT_EQ(ofRankZero(mine), std::vector<double>(mine.data(), mine.data() + mine.size()));
}

void expectSolved(const Sparse& A) {
  const DirectSolver solver(A);
  const Vector b = scatteredNumbers(A.rows(), 1, 1);
  const Vector x = solver.solve(b);
  EXPECT_LT((b - A * x).norm() / b.norm(), 1e-10);
  const Vector y = solver.solveTransposed(b);
  EXPECT_LT((b - A.transpose() * y).norm() / b.norm(), 1e-10);
  const Matrix B = scatteredNumbers(A.rows(), 5, 2);
  EXPECT_LT((B - A * Matrix(solver.solve(B))).norm() / B.norm(), 1e-10);
  expectSameOnAllRanks(x);
}

TEST(Canary, DirectSolverOnEveryRank) {
  const auto chain = springChain(200, 1e3, 2.0);
  expectSolved(chain.K);                            // symmetric positive definite
  expectSolved(Sparse(chain.K - 200.0 * chain.M));  // indefinite
  expectSolved(transport(200));                     // unsymmetric
}

TEST(Canary, RanksSolveDifferentSystemsWithoutWaitingForEachOther) {
  // sizes and numbers of solves differ by rank: anything collective would hang or mix them up
  for (int k = 0; k <= rank(); ++k) {
    const Sparse A = transport(50 + 37 * rank() + k);
    const Vector b = Vector::Ones(A.rows());
    EXPECT_LT((b - A * Vector(DirectSolver(A).solve(b))).norm() / b.norm(), 1e-10);
    const auto pencil = beam(110 + 10 * rank() + k, 170.3, 3e6, 2);
    EXPECT_EQ(lowestModes(pencil.K, pencil.M, 4 + 2 * k).count(), 4 + 2 * k);
  }
}

TEST(Canary, SingularMatricesAreNamedOnEveryRank) {
  EXPECT_THROW(DirectSolver(springChain(50, 1.0, 1.0, true).K), ModelError);
  if (rank() == 0) {
    EXPECT_THROW(DirectSolver(springChain(20, 1.0, 1.0, true).K), ModelError);  // and on one alone
  }
}

TEST(Canary, ModesAreTheSameOnEveryRank) {
  for (const int elements : {40, 120}) {  // dense and Krylov
    const auto pencil = beam(elements, 170.3, 3e6, 2);
    if (rank() % 2 == 1) lowestModes(pencil.K, pencil.M, 3);  // earlier calls must have no effect
    const EigenPairs modes = lowestModes(pencil.K, pencil.M, 20);
    EXPECT_LT(modes.residuals.maxCoeff(), 1e-10);
    EXPECT_LT(modes.orthogonality, 1e-11);
    expectSameOnAllRanks(modes.values);
    expectSameOnAllRanks(modes.vectors);
  }
}

TEST(Canary, NewtonIsTheSameOnEveryRank) {
  testing::ContactChain chain(60, 100.0, 2e3);
  Vector x = Vector::Zero(60);
  statics::NewtonOptions options;
  const auto report = statics::solve(chain, x, options);
  EXPECT_TRUE(report.converged) << report.message;
  expectSameOnAllRanks(x);
  // a failure on one rank alone stays there
  if (rank() == 0) {
    Vector y = Vector::Zero(60);
    options.maxIterations = 1;
    EXPECT_FALSE(statics::solve(chain, y, options).converged);
  }
}

}  // namespace CanaryTest
}  // namespace tooljoint::linalg
