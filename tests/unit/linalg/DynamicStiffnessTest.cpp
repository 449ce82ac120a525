// SPDX-License-Identifier: BSD-3-Clause
// Harmonic solutions and the refinement of one damped mode against dense algebra.
#include "linalg/DynamicStiffness.hpp"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {
namespace DynamicStiffnessTest {

using Complex = std::complex<double>;

struct Rotor {
  Matrix M = Matrix(Eigen::Vector3d(2.0, 1.0, 3.0).asDiagonal());
  Matrix C = (Matrix(3, 3) << 0.2, 1.5, 0.0, -1.5, 0.1, 0.0, 0.0, 0.0, 0.3).finished();
  Matrix K = (Matrix(3, 3) << 50, -8, 0, -8, 60, -5, 2, -5, 40).finished();
  Sparse m = M.sparseView(), c = C.sparseView(), k = K.sparseView();
};

TEST(DynamicStiffness, SolvesAndSolvesTransposed) {
  const Rotor r;
  const Complex s(-0.3, 2.0);
  const Eigen::MatrixXcd Q =
      s * s * r.M.cast<Complex>() + s * r.C.cast<Complex>() + r.K.cast<Complex>();
  DynamicStiffness factors(r.m, r.c, r.k, s);
  ASSERT_FALSE(factors.singular());
  Eigen::MatrixXcd f(3, 2);
  f << 1.0, Complex(0, 2), 3.0, 0.0, Complex(1, 1), 4.0;
  EXPECT_LT((Q * factors.solve(f) - f).norm(), 1e-13);
  EXPECT_LT((Q.transpose() * factors.solveTransposed(f) - f).norm(), 1e-13);
}

TEST(DynamicStiffness, RefinesAModeFromAGuess) {
  const Rotor r;
  const auto all = dampedModes(r.M, r.C, r.K);
  const auto last = all.values.size() - 1;
  const Complex exact = all.values[last];
  Eigen::VectorXcd guess = all.vectors.col(last);
  guess[0] += 0.05;
  const auto mode = refine(r.m, r.c, r.k, {1.02 * exact, guess});
  ASSERT_TRUE(mode);
  EXPECT_LT(std::abs(mode->s - exact), 1e-12 * std::abs(exact));
}

}  // namespace DynamicStiffnessTest
}  // namespace tooljoint::linalg
