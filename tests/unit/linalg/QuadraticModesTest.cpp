// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Dense>
#include <cmath>
#include <gtest/gtest.h>
#include <random>

#include "Models.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::linalg {
namespace QuadraticModesTest {

TEST(QuadraticModes, DampedOscillator) {
  const double m = 3.0, k = 4.8e5, zeta = 0.02, omega = std::sqrt(k / m);
  const QuadraticModes modes =
      dampedModes(Matrix::Constant(1, 1, m), Matrix::Constant(1, 1, 2.0 * zeta * omega * m),
                  Matrix::Constant(1, 1, k));
  ASSERT_EQ(modes.values.size(), 2);
  EXPECT_NEAR(modes.values[0].real(), -zeta * omega, 1e-10 * omega);
  EXPECT_NEAR(modes.values[0].imag(), -omega * std::sqrt(1.0 - zeta * zeta), 1e-10 * omega);
  EXPECT_NEAR(modes.values[1].imag(), omega * std::sqrt(1.0 - zeta * zeta), 1e-10 * omega);
}

TEST(QuadraticModes, OverdampedOscillatorHasTwoRealRoots) {
  // s^2 + 5 s + 4 = 0
  const QuadraticModes modes = dampedModes(Matrix::Constant(1, 1, 1.0), Matrix::Constant(1, 1, 5.0),
                                           Matrix::Constant(1, 1, 4.0));
  EXPECT_NEAR(modes.values[0].real(), -4.0, 1e-12);
  EXPECT_NEAR(modes.values[1].real(), -1.0, 1e-12);
}

TEST(QuadraticModes, GyroscopicSplitting) {
  // u'' + g v' + w0^2 u = 0, v'' - g u' + w0^2 v = 0: whirl at g/2 +- sqrt(g^2/4 + w0^2)
  const double w0 = 30.0, g = 8.0;
  Matrix C(2, 2);
  C << 0.0, g, -g, 0.0;
  const QuadraticModes modes =
      dampedModes(Matrix::Identity(2, 2), C, w0 * w0 * Matrix::Identity(2, 2));
  const double slow = std::sqrt(g * g / 4 + w0 * w0) - g / 2, fast = slow + g;
  for (int j = 0; j < 4; ++j) {
    EXPECT_NEAR(std::abs(modes.values[j].imag()), j < 2 ? slow : fast, 1e-11 * w0);
    EXPECT_NEAR(modes.values[j].real(), 0.0, 1e-11 * w0);
    EXPECT_LT(modes.residuals[j], 1e-14);
    // circular whirl: v = -+ i u, one sense slow and the other fast
    EXPECT_NEAR(std::abs(modes.vectors(1, j) / modes.vectors(0, j)), 1.0, 1e-10);
  }
  EXPECT_LT(modes.values[0].imag(), modes.values[1].imag());
}

TEST(QuadraticModes, WithoutDampingTheyAreTheSymmetricModesTwice) {
  const auto beam = testing::beam(12, 30.0, 3e6);
  const int n = static_cast<int>(beam.K.rows());
  const QuadraticModes modes = dampedModes(Matrix(beam.M), Matrix::Zero(n, n), Matrix(beam.K));
  const EigenPairs pairs = symmetricModes(Matrix(beam.K), Matrix(beam.M));
  const double largest = std::sqrt(pairs.values[n - 1]);
  for (int j = 0; j < n; ++j)
    for (int side = 0; side < 2; ++side)
      EXPECT_NEAR(std::abs(modes.values[2 * j + side].imag()), std::sqrt(pairs.values[j]),
                  1e-8 * largest);
}

TEST(QuadraticModes, ProportionalDampingDampsEachModeAsPredicted) {
  const auto chain = testing::springChain(10, 400.0, 2.0);
  const Matrix K(chain.K), M(chain.M), C = 0.3 * M + 1e-3 * K;
  const QuadraticModes modes = dampedModes(M, C, K);
  const EigenPairs pairs = symmetricModes(K, M);
  for (int j = 0; j < 10; ++j)
    EXPECT_NEAR(modes.values[2 * j].real(), -0.5 * (0.3 + 1e-3 * pairs.values[j]), 1e-9);
}

// Rigid motions with mass-proportional damping decay at one rate: rounding makes pairs of repeated
// real values, and each must be listed with its multiplicity.
TEST(QuadraticModes, RepeatedRealValuesAreAllThere) {
  constexpr int n = 50, rigid = 5;
  std::mt19937 random(1);
  std::normal_distribution<double> entry;
  for (int trial = 0; trial < 20; ++trial) {
    const Matrix Q = Eigen::HouseholderQR<Matrix>(Matrix::NullaryExpr(n, n, [&] {
                       return entry(random);
                     })).householderQ();
    Vector stiffness = Vector::LinSpaced(n, 1.0, 100.0).array().square();
    stiffness.head(rigid).setZero();
    Matrix gyroscopic = Matrix::Zero(n, n);
    for (int i = rigid; i + 1 < n; i += 2) {
      gyroscopic(i, i + 1) = 2.0;
      gyroscopic(i + 1, i) = -2.0;
    }
    const auto turned = [&Q](const Matrix& A) {
      return Sparse((Q * A * Q.transpose()).sparseView());
    };
    const auto modes = lowestDampedModes(turned(Matrix::Identity(n, n)),
                                         turned(0.5 * Matrix::Identity(n, n) + gyroscopic),
                                         turned(stiffness.asDiagonal()), 2 * rigid + 1);
    ASSERT_EQ(modes.values.size(), 2 * rigid + 1) << trial;
    for (int j = 0; j < rigid; ++j) {
      EXPECT_EQ(modes.values[j], 0.0) << trial;
      EXPECT_NEAR(std::abs(modes.values[rigid + j] + 0.5), 0.0, 1e-9) << trial;
    }
    EXPECT_GT(std::abs(modes.values[2 * rigid]), 1.0) << trial;
  }
}

/// A search for hundreds of modes ends with a signal.
TEST(QuadraticModes, LongSearchIsInterrupted) {
  const int n = 110;
  const Vector stiffness = Vector::LinSpaced(n, 1.0, 9.0), damping = stiffness.cwiseSqrt() / 50.0;
  const auto diagonal = [](const Vector& d) { return Sparse(Matrix(d.asDiagonal()).sparseView()); };
  const auto search = [&] {
    return lowestDampedModes(diagonal(Vector::Ones(n)), diagonal(damping), diagonal(stiffness),
                             2 * n - 10);
  };
  requestInterrupt();
  EXPECT_THROW(search(), InterruptedError);
  requestInterrupt(false);
}

TEST(QuadraticModes, RefusesASingularMassMatrix) {
  EXPECT_THROW(dampedModes(Matrix::Zero(2, 2), Matrix::Zero(2, 2), Matrix::Identity(2, 2)),
               ModelError);
  EXPECT_THROW(dampedModes(Matrix::Identity(2, 2), Matrix::Zero(3, 3), Matrix::Identity(2, 2)),
               ModelError);
  EXPECT_THROW(
      dampedModes(Matrix::Identity(2, 2), Matrix::Constant(2, 2, NAN), Matrix::Identity(2, 2)),
      ModelError);
  EXPECT_EQ(dampedModes(Matrix(0, 0), Matrix(0, 0), Matrix(0, 0)).values.size(), 0);
}

}  // namespace QuadraticModesTest
}  // namespace tooljoint::linalg
