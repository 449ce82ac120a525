// SPDX-License-Identifier: BSD-3-Clause
#include "linalg/trilinos/Krylov.hpp"

#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "Models.hpp"
#include "common/Error.hpp"
#include "linalg/Deterministic.hpp"

namespace tooljoint::linalg {
namespace {

using testing::beam;
using testing::springChain;
using testing::transport;

TEST(Krylov, OneIterationWithTheFactorOfTheMatrixItself) {
  const Sparse A = transport(300);
  const KrylovSolver solver(A);
  const Vector b = scatteredNumbers(300, 1, 1);
  const Vector x = solver.solve(b);
  EXPECT_LT((b - A * x).norm(), 1e-11 * b.norm());
  EXPECT_LE(solver.lastIterations(), 2);
  EXPECT_LT(solver.lastResidual(), 1e-10);
}

TEST(Krylov, LaggedFactorCostsIterationsButGivesTheSameSolution) {
  const Sparse A = transport(300);
  KrylovSolver solver(A);
  Sparse changed = A;
  for (int i = 0; i < 300; i += 3) changed.coeffRef(i, i) += 2.0;
  solver.update(changed);
  const Matrix b = scatteredNumbers(300, 4, 2);
  const Matrix lagged = solver.solve(b);
  const int iterations = solver.lastIterations();
  EXPECT_GT(iterations, 2);
  EXPECT_LT((b - changed * lagged).norm(), 1e-9 * b.norm());
  solver.refactor();
  const Matrix fresh = solver.solve(b);
  EXPECT_LT(solver.lastIterations(), iterations);
  EXPECT_LT((fresh - lagged).norm(), 1e-8 * fresh.norm());
}

TEST(Krylov, ConjugateGradientsOnDefiniteMatrices) {
  const auto old = springChain(200, 1e7, 1.0), now = springChain(200, 1.3e7, 1.0);
  KrylovOptions options;
  options.method = KrylovOptions::Cg;
  KrylovSolver solver(Sparse(old.K + 1e4 * old.M), {}, options);
  solver.update(now.K);
  const Vector b = Vector::Ones(200);
  const Vector x = solver.solve(b);
  EXPECT_LT((b - now.K * x).norm(), 1e-9 * b.norm());
}

TEST(Krylov, RowsOfForcesAndMomentsWithHighCondition) {
  const auto fine = beam(500, 500.0, 3e6), other = beam(500, 500.0, 3.3e6);  // condition about 1e11
  KrylovSolver solver(fine.K);
  solver.update(other.K);
  const Vector b = Vector::Ones(fine.K.rows());
  solver.solve(b);
  EXPECT_LT(solver.lastResidual(), 1e-10);
}

TEST(Krylov, SaysWhenItFails) {
  const Sparse A = transport(300);
  Teuchos::ParameterList starved;
  starved.set("Maximum Iterations", 1);
  KrylovOptions options;
  options.belos = &starved;
  KrylovSolver solver(Sparse(50.0 * springChain(300, 1.0, 1.0).K), {}, options);
  solver.update(A);
  EXPECT_THROW(solver.solve(Vector::Ones(300)), ConvergenceError);
  EXPECT_THROW(solver.update(transport(20)), ModelError);
  EXPECT_THROW(solver.solve(Vector::Ones(7)), ModelError);
  EXPECT_THROW(solver.solve(Vector::Constant(300, NAN)), ModelError);
}

TEST(Krylov, ZeroRightHandSide) {
  const KrylovSolver solver(transport(30));
  EXPECT_EQ(Vector(solver.solve(Vector::Zero(30))).norm(), 0.0);
}

TEST(Krylov, DoesNotBelieveAToleranceThatIsTooLoose) {
  const Sparse A = transport(300);
  Teuchos::ParameterList loose;
  loose.set("Convergence Tolerance", 0.5);
  KrylovOptions options;
  options.belos = &loose;
  KrylovSolver solver(Sparse(A + 3.0 * springChain(300, 1.0, 1.0).K), {}, options);
  solver.update(A);
  EXPECT_THROW(solver.solve(Vector::Ones(300)), ConvergenceError);
}

}  // namespace
}  // namespace tooljoint::linalg
