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

/// Modes eta of a part and its massless ends u, which they move but for small residual
/// flexibilities, u = Phi'eta + G f, on springs k. Without u,
///
///     K = Omega^2 + Phi (G + 1/k)^-1 Phi'
///
/// The scale of u is arbitrary and must not affect the choice of pivots.
TEST(DynamicStiffness, TheScaleOfMasslessDofsDecidesNothing) {
  constexpr int modes = 24, ends = 6;
  constexpr double k = 100.0;
  Matrix phi(modes, ends);
  Vector squares(modes), g(ends);
  for (int j = 0; j < ends; ++j) g[j] = std::pow(10.0, -10.0 - 0.4 * j);
  for (int i = 0; i < modes; ++i) {
    squares[i] = std::pow(10.0 * (i + 1), 2);
    for (int j = 0; j < ends; ++j) phi(i, j) = 0.3 * std::sin(1.0 + 2.0 * i + 1.3 * i * j + j);
  }
  const Vector stiff = g.cwiseInverse(), both = (g.array() + 1 / k).inverse();
  const Matrix coupling = phi * stiff.asDiagonal();
  const Matrix condensed = Matrix(squares.asDiagonal()) + phi * both.asDiagonal() * phi.transpose();
  const Eigen::SelfAdjointEigenSolver<Matrix> exact(condensed);
  constexpr int n = modes + ends;
  Matrix M = Matrix::Zero(n, n), K(n, n);
  M.topLeftCorner(modes, modes).setIdentity();
  K << Matrix(squares.asDiagonal()) + phi * stiff.asDiagonal() * phi.transpose(), -coupling,
      -coupling.transpose(), Matrix((stiff.array() + k).matrix().asDiagonal());
  for (const double scale : {1e-7, 1e-9}) {
    Vector d = Vector::Ones(n);
    d.tail(ends).setConstant(scale);
    const Matrix scaled = d.asDiagonal() * K * d.asDiagonal();
    for (int j : {4, 11, 23}) {
      const double omega = std::sqrt(exact.eigenvalues()[j]);
      const Vector shape = exact.eigenvectors().col(j);
      Eigen::VectorXcd guess(n);
      guess << shape.cast<Complex>(), (phi.transpose() * shape / scale).cast<Complex>();
      guess[0] += 0.01;
      const auto mode = refine(M.sparseView(), Sparse(n, n), scaled.sparseView(),
                               {Complex(0, 1.001 * omega), guess});
      ASSERT_TRUE(mode) << scale << " " << j;
      EXPECT_LT(std::abs(mode->s - Complex(0, omega)), 1e-8 * omega) << scale << " " << j;
    }
  }
}

}  // namespace DynamicStiffnessTest
}  // namespace tooljoint::linalg
