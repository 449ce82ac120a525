// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The damped modes nearest zero by Krylov subspaces, against all modes of a dense solver.
#include <Eigen/Dense>
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdlib>
#include <gtest/gtest.h>
#include <string>
#include <utility>
#include <vector>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "linalg/GeneralEigen.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace LowestDampedModesTest {

using namespace tooljoint;
using namespace tooljoint::linalg;
using tooljoint::testing::Shaft, tooljoint::testing::shaft, tooljoint::testing::sparse;

/// The values with Im s >= 0 of all, by |s|.
std::vector<std::complex<double>> lowest(const Shaft& s, std::size_t count) {
  const auto all = dampedModes(Matrix(s.M), Matrix(s.C), Matrix(s.K));
  std::vector<std::complex<double>> values;
  for (Eigen::Index i = 0; i < all.values.size(); ++i)
    if (all.values[i].imag() >= 0) values.push_back(all.values[i]);
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  values.resize(count);
  return values;
}

TEST(LowestDampedModes, AreTheOnesNearestZeroOfAll) {
  for (double g : {0.0, 0.4})
    for (double c : {0.0, 0.05, 3.0}) {
      const Shaft s = shaft(50, g, c, false);
      const auto expected = lowest(s, 10);
      const auto modes = lowestDampedModes(s.M, s.C, s.K, 10);
      ASSERT_EQ(modes.values.size(), 10);
      for (Eigen::Index i = 0; i < 10; ++i) {
        EXPECT_NEAR(std::abs(modes.values[i] - expected[static_cast<std::size_t>(i)]), 0.0,
                    1e-8 * std::abs(expected[static_cast<std::size_t>(i)]))
            << "g " << g << ", c " << c << ", mode " << i;
        EXPECT_LE(modes.residuals[i], 1e-8);
      }
    }
}

/// s and -s of a divergence have the same size as the lowest vibration: a shift of that size would
/// equal the growing value.
TEST(LowestDampedModes, BesideOneThatGrowsWithoutVibrationAreAllAccurate) {
  for (const double share : {1.02, 1.3, 3.0}) {
    Shaft s = shaft(50, 0.0, 0.0, false);
    const auto rest = lowest(s, 1).front();
    s.K -= Sparse(share * std::norm(rest) * s.M);
    for (int i = 0; i < 50; ++i)
      s.K.coeffRef(2 * i, 2 * i + 1) += 1e-3, s.K.coeffRef(2 * i + 1, 2 * i) -= 1e-3;
    const auto expected = lowest(s, 8);
    const auto modes = lowestDampedModes(s.M, s.C, s.K, 8);
    ASSERT_EQ(modes.values.size(), 8);
    for (Eigen::Index i = 0; i < 8; ++i)
      EXPECT_NEAR(std::abs(modes.values[i]), std::abs(expected[at(i)]), 1e-8 * std::abs(rest))
          << share << ", mode " << i;
    EXPECT_GT(modes.values.real().maxCoeff(), 0.0);
  }
}

TEST(LowestDampedModes, AFreeBodyHasItsRigidMotionsAtZero) {
  const Shaft s = shaft(90, 0.0, 0.05, true);
  const auto modes = lowestDampedModes(s.M, s.C, s.K, 6);
  EXPECT_LT(std::abs(modes.values[0]), 1e-6);
  EXPECT_LT(std::abs(modes.values[1]), 1e-6);
}

TEST(LowestDampedModes, RefusesWhatIsNoPencil) {
  const Shaft s = shaft(5, 0.1, 0.1, false);
  EXPECT_THROW(lowestDampedModes(s.M, s.C, Sparse(3, 3), 2), ModelError);
  EXPECT_THROW(lowestDampedModes(s.M, s.C, s.K, 21), ModelError);
}

/// Grid of nx x ny equal masses on equal springs that move normal to it: omega^2 = k/m (4 - 2 cos a
/// - 2 cos b), most values twice.
Shaft membrane(int nx, int ny, bool free) {
  const int n = nx * ny;
  Triplets k;
  const auto number = [&](int i, int j) { return i + nx * j; };
  for (int j = 0; j < ny; ++j)
    for (int i = 0; i < nx; ++i)
      for (const auto& [di, dj] :
           {std::pair{1, 0}, std::pair{-1, 0}, std::pair{0, 1}, std::pair{0, -1}}) {
        const bool inside = i + di >= 0 && i + di < nx && j + dj >= 0 && j + dj < ny;
        if (inside || !free) k.emplace_back(number(i, j), number(i, j), 400.0);
        if (inside) k.emplace_back(number(i, j), number(i + di, j + dj), -400.0);
      }
  Shaft s;
  s.K.resize(n, n);
  s.K.setFromTriplets(k.begin(), k.end());
  s.M.resize(n, n);
  s.M.setIdentity();
  s.C.resize(n, n);
  return s;
}

/// Values with Im s >= 0 of s^2 + (alpha + beta omega^2) s + omega^2 = 0 for every omega^2 of the
/// membrane, by |s|.
std::vector<std::complex<double>> proportionallyDamped(int nx, int ny, double alpha, double beta) {
  using constants::pi;
  std::vector<std::complex<double>> values;
  for (int i = 1; i <= nx; ++i)
    for (int j = 1; j <= ny; ++j) {
      const double omega2 = 400.0 *
                            (4 - 2 * std::cos(i * pi / (nx + 1)) - 2 * std::cos(j * pi / (ny + 1))),
                   c = alpha + beta * omega2;
      const std::complex<double> root = std::sqrt(std::complex<double>(c * c / 4 - omega2));
      for (const auto& s : {-c / 2 + root, -c / 2 - root})
        if (s.imag() >= 0) values.push_back(s);
    }
  std::sort(values.begin(), values.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  return values;
}

void expectAmong(const QuadraticModes& modes, std::vector<std::complex<double>> exact,
                 double tolerance, const std::string& what) {
  for (Eigen::Index j = 0; j < modes.values.size(); ++j) {
    const auto nearest = std::min_element(exact.begin(), exact.end(), [&](auto a, auto b) {
      return std::abs(a - modes.values[j]) < std::abs(b - modes.values[j]);
    });
    ASSERT_NE(nearest, exact.end());
    EXPECT_LT(std::abs(*nearest - modes.values[j]), tolerance * std::abs(modes.values[j]))
        << what << ", mode " << j + 1;
    exact.erase(nearest);
  }
}

// Repeated values, with every kind of damping; a double value must be listed twice.
TEST(LowestDampedModes, FindEveryCopyOfARepeatedValue) {
  struct Case {
    const char* name;
    double alpha, beta, tolerance;
  };
  const double first = std::sqrt(400.0 * (4 - 4 * std::cos(constants::pi / 13)));  // of 12 x 12
  for (const Case& c :
       {Case{"undamped", 0, 0, 1e-10}, Case{"light", 1e-6, 1e-9, 1e-10},
        Case{"proportional", 0.4, 1e-3, 1e-10}, Case{"overdamped", 5 * first, 0, 1e-10},
        Case{"critical", 2 * first, 0, 1e-6}}) {
    Shaft s = membrane(12, 12, false);
    s.C = c.alpha * s.M + c.beta * s.K;
    const auto exact = proportionallyDamped(12, 12, c.alpha, c.beta);
    const auto modes = lowestDampedModes(s.M, s.C, s.K, 20);
    ASSERT_EQ(modes.values.size(), 20) << c.name;
    expectAmong(modes, {exact.begin(), exact.begin() + 24}, c.tolerance, c.name);
    EXPECT_LT(modes.residuals.maxCoeff(), 1e-11) << c.name;
  }
}

// More copies than a block of the Krylov space has columns: 20 uncoupled oscillators of each
// frequency.
TEST(LowestDampedModes, FindMoreCopiesThanABlockHas) {
  const int copies = 20, kinds = 8, n = copies * kinds;
  Triplets k, c;
  for (int i = 0; i < n; ++i) {
    const double omega = 1.0 + i / copies;
    k.emplace_back(i, i, omega * omega);
    c.emplace_back(i, i, 0.02 * omega);
  }
  Shaft s{Sparse(n, n), Sparse(n, n), Sparse(n, n)};
  s.M.setIdentity();
  s.K.setFromTriplets(k.begin(), k.end());
  s.C.setFromTriplets(c.begin(), c.end());
  const auto modes = lowestDampedModes(s.M, s.C, s.K, 24);
  ASSERT_EQ(modes.values.size(), 24);
  for (Eigen::Index j = 0; j < 24; ++j)
    EXPECT_NEAR(std::abs(modes.values[j]), j < copies ? 1.0 : 2.0, 1e-9) << j;
}

// A rigid-body motion of a free body is zero twice in a Jordan chain: it is listed once, as zero,
// with and without gyroscopics.
TEST(LowestDampedModes, RigidBodyMotionsAreZeroAndListedOnce) {
  for (const auto& [n, g] : {std::pair(90, 0.0), std::pair(90, 0.4), std::pair(40, 0.4),
                             std::pair(130, 0.3), std::pair(90, 1.3), std::pair(130, 5.0)}) {
    Shaft s = shaft(n, g, 0.0, true);
    const auto modes = lowestDampedModes(s.M, s.C, s.K, 6);
    ASSERT_EQ(modes.values.size(), 6);
    // gyroscopic coupling of free masses turns one chain into a whirl at g / m, far below the first
    // elastic mode here only for the plain shaft
    const int zeros = static_cast<int>((modes.values.cwiseAbs().array() == 0.0).count());
    EXPECT_EQ(zeros, 2) << g;
    const Vector size =
        (s.K * modes.vectors.leftCols(zeros).real()).cwiseAbs().colwise().maxCoeff();
    EXPECT_LT(size.maxCoeff(), 1e-9) << "K phi = 0";
  }
  const auto plate = membrane(14, 14, true);
  const auto modes = lowestDampedModes(plate.M, plate.C, plate.K, 5);
  EXPECT_EQ(modes.values[0], 0.0);
  EXPECT_GT(std::abs(modes.values[1]), 1.0);
}

// u'' + g v' + w^2 u = 0, v'' - g u' + w^2 v = 0 with strong gyroscopics: whirl at sqrt(g^2/4 +
// w^2) -+ g/2, twice each.
TEST(LowestDampedModes, StrongGyroscopicsAreNotDamped) {
  const int nx = 9, n = nx * nx;
  const Shaft plate = membrane(nx, nx, false);
  const double g = 300.0, pi = constants::pi;
  const Matrix K = plate.K;
  Matrix both = Matrix::Zero(2 * n, 2 * n), C = Matrix::Zero(2 * n, 2 * n);
  both.topLeftCorner(n, n) = both.bottomRightCorner(n, n) = K;
  C.topRightCorner(n, n) = g * Matrix::Identity(n, n);
  C.bottomLeftCorner(n, n) = -g * Matrix::Identity(n, n);
  const auto modes =
      lowestDampedModes(sparse(Matrix::Identity(2 * n, 2 * n)), sparse(C), sparse(both), 15);
  std::vector<std::complex<double>> exact;
  for (int i = 1; i <= nx; ++i)
    for (int j = 1; j <= nx; ++j) {
      const double w2 =
          400.0 * (4 - 2 * std::cos(i * pi / (nx + 1)) - 2 * std::cos(j * pi / (nx + 1)));
      exact.emplace_back(0, std::sqrt(g * g / 4 + w2) - g / 2);
    }
  std::sort(exact.begin(), exact.end(), [](auto a, auto b) { return std::abs(a) < std::abs(b); });
  exact.resize(18);
  expectAmong(modes, exact, 1e-9, "gyroscopic");
  for (Eigen::Index j = 0; j < 15; ++j)
    EXPECT_LT(std::abs(modes.values[j].real()), 1e-10 * std::abs(modes.values[j]));
}

// A free body, C = beta K: its rigid-body motions must not appear as relaxing modes because of
// rounding in directions that have mass but no damping.
TEST(LowestDampedModes, StiffnessDampingLeavesWhatRestsAtRest) {
  constexpr int n = 40;
  Matrix K = Matrix::Zero(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    const double k = 1e5 * (1 + 0.37 * std::sin(2.0 * i));
    K(i, i) += k, K(i + 1, i + 1) += k, K(i, i + 1) -= k, K(i + 1, i) -= k;
  }
  const Matrix M = Matrix::Identity(n, n);
  const auto found = lowestDampedModes(M.sparseView(), (1e-5 * K).sparseView(), K.sparseView(), 4);
  EXPECT_EQ(found.values[0], Complex(0));
  for (Eigen::Index j = 1; j < 4; ++j) EXPECT_GT(std::abs(found.values[j]), 10.0) << j;
}

// A dof that does not vibrate has two real values: there are more values than dofs.
TEST(LowestDampedModes, OverdampedDofsHaveTwoValuesEach) {
  const Vector c = Eigen::Vector3d(50, 5, 30), k = Eigen::Vector3d(100, 900, 200);
  Matrix C = c.asDiagonal(), K = k.asDiagonal();
  C(0, 1) = C(1, 0) = 1e-9;  // no longer proportional
  const auto found = lowestDampedModes(Matrix(Matrix::Identity(3, 3)).sparseView(), C.sparseView(),
                                       K.sparseView(), 6);
  std::vector<Complex> exact{{-2.5, std::sqrt(900 - 6.25)}};
  for (int i : {0, 2})
    for (const double sign : {1.0, -1.0})
      exact.push_back(-0.5 * c[i] + sign * std::sqrt(0.25 * c[i] * c[i] - k[i]));
  std::sort(exact.begin(), exact.end(),
            [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  ASSERT_EQ(found.values.size(), 5);
  for (Eigen::Index j = 0; j < 5; ++j)
    EXPECT_LT(std::abs(found.values[j] - exact[static_cast<std::size_t>(j)]), 1e-7) << j;
}

/// A rod of many masses hangs from a flywheel on a soft spring and a damper: one mode is far below
/// all others, and the damping is not proportional. The others are nearly those of a rod held at
/// its top, with j - 1 to j half waves.
TEST(LowestDampedModes, AreFoundAboveOneFarBelowTheOthers) {
  constexpr int n = 1000, count = 12;
  constexpr double flywheel = 5.0 * n, spring = 6e-8 * n, damper = 2e-4 * n;
  Matrix M = Matrix::Identity(n, n), C = Matrix::Zero(n, n), K = Matrix::Zero(n, n);
  for (int i = 1; i < n; ++i) {
    K(i - 1, i - 1) += 1.0, K(i, i) += 1.0;
    K(i - 1, i) -= 1.0, K(i, i - 1) -= 1.0;
  }
  M(0, 0) = flywheel, C(0, 0) = damper, K(0, 0) += spring;
  const auto modes = lowestDampedModes(sparse(M), sparse(C), sparse(K), count);
  ASSERT_EQ(modes.values.size(), count);
  EXPECT_LT(std::abs(modes.values[0]), 0.1 * std::abs(modes.values[1]));
  for (Eigen::Index j = 1; j < count; ++j) {
    const double halfWaves = modes.values[j].imag() * static_cast<double>(n) / constants::pi;
    EXPECT_GT(halfWaves, static_cast<double>(j) - 1.0) << j;
    EXPECT_LT(halfWaves, static_cast<double>(j)) << j;
    EXPECT_LE(modes.residuals[j], 1e-8) << j;
  }
}

// Without damping the values are those of the undamped modes: s = i omega, and +-sqrt(-omega^2)
// where omega^2 < 0.
TEST(LowestDampedModes, WithoutDampingTheyAreTheSymmetricModes) {
  Shaft s = membrane(11, 13, false);
  const double shift = 400.0 * 0.4;  // the lowest ones become negative
  s.K = Sparse(s.K - shift * s.M);
  const auto pairs = lowestModes(s.K, s.M, 12);
  const auto modes = lowestDampedModes(s.M, s.C, s.K, 12);
  ASSERT_LT(pairs.values[0], 0.0);
  for (Eigen::Index j = 0; j < 12; ++j) {
    const auto s2 = modes.values[j] * modes.values[j];
    EXPECT_LT((pairs.values.array() + s2.real()).abs().minCoeff(), 1e-9 * std::abs(s2)) << j;
    EXPECT_TRUE(modes.values[j].real() == 0.0 || modes.values[j].imag() == 0.0);
    if (j > 0) {
      EXPECT_GE(std::abs(modes.values[j]), std::abs(modes.values[j - 1]));
    }
  }
}

}  // namespace LowestDampedModesTest
