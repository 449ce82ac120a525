// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Damped modes near a frequency by complex Krylov spaces, against closed forms and all modes of a
/// dense solver.
#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <vector>

#include "Models.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace NearbyModesTest {

using namespace tooljoint;
using namespace tooljoint::linalg;
using tooljoint::testing::beam;
using tooljoint::testing::springChain;
using Complex = std::complex<double>;

/// Two planes of a chain of masses, coupled by a gyroscopic term g, damped by c.
struct Rotor {
  Sparse M, C, K;
  Rotor(int n, double g, double c) {
    const auto both =
        tooljoint::testing::sideBySide({springChain(n, 100.0, 1.0), springChain(n, 110.0, 1.0)});
    M = both.M, K = both.K;
    Triplets damping;
    for (int i = 0; i < n; ++i) {
      damping.emplace_back(i, i, c), damping.emplace_back(n + i, n + i, 0.7 * c);
      damping.emplace_back(i, n + i, g), damping.emplace_back(n + i, i, -g);
    }
    C = tooljoint::testing::assembled(2 * n, damping);
  }
};

/// Values of modes with Im s >= 0 that are in the target, by |s|.
std::vector<Complex> inTarget(const QuadraticModes& all, const DampedTarget& target) {
  std::vector<Complex> values;
  for (Eigen::Index i = 0; i < all.values.size(); ++i)
    if (all.values[i].imag() >= 0.0) values.push_back(all.values[i]);
  const auto distance = [&](Complex s) { return std::abs(s - target.centre); };
  std::sort(values.begin(), values.end(),
            [&](Complex a, Complex b) { return distance(a) < distance(b); });
  auto last = static_cast<std::size_t>(target.count);
  while (last < values.size() && distance(values[last]) <= target.radius) ++last;
  values.resize(last);
  std::sort(values.begin(), values.end(),
            [](Complex a, Complex b) { return std::abs(a) < std::abs(b); });
  return values;
}

void compare(const QuadraticModes& modes, const std::vector<Complex>& exact) {
  ASSERT_EQ(modes.values.size(), static_cast<Eigen::Index>(exact.size()));
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_LT(std::abs(modes.values[static_cast<Eigen::Index>(i)] - exact[i]),
              1e-8 * std::abs(exact[i]))
        << i;
    EXPECT_LE(modes.residuals[static_cast<Eigen::Index>(i)], 1e-8);
  }
}

// Models small enough for dense matrices and larger ones, undamped, damped and gyroscopic.
TEST(NearbyModes, AreThoseOfTheTargetAmongAll) {
  for (const int n : {20, 50})
    for (const double g : {0.0, 0.4})
      for (const double c : {0.0, 0.1}) {
        const Rotor rotor(n, g, c);
        const auto all = dampedModes(Matrix(rotor.M), Matrix(rotor.C), Matrix(rotor.K));
        for (const DampedTarget& target :
             {DampedTarget{{0, 9.0}, 0.0, 6}, DampedTarget{{0, 9.0}, 1.5, 0},
              DampedTarget{{0, 2.0}, 2.0, 0}}) {
          SCOPED_TRACE(::testing::Message() << n << " g " << g << " c " << c << " target "
                                            << target.centre << " " << target.radius);
          compare(dampedModesNear(rotor.M, rotor.C, rotor.K, target), inTarget(all, target));
        }
      }
}

// Ten planes of one beam: every value ten times, more copies than a start block has columns.
TEST(NearbyModes, FindAllCopiesOfRepeatedValues) {
  const auto many = beam(40, 10.0, 1e4, 10);
  const double exact = std::sqrt(1e4) * std::pow(5 * constants::pi / 10.0, 2);
  const Sparse none(many.M.rows(), many.M.cols());
  const auto modes = dampedModesNear(many.M, none, many.K, {{0.0, exact}, 0.1 * exact, 0});
  ASSERT_EQ(modes.values.size(), 10);
  for (Eigen::Index i = 0; i < 10; ++i)
    EXPECT_NEAR(modes.values[i].imag(), exact, 2e-4 * exact);  // of 40 elements
}

// lambda_j = 4 k/m sin^2(j pi/(2 (n + 1))): the modes about the middle of 1000.
TEST(NearbyModes, OfALongChainAreFoundInItsMiddle) {
  const int n = 1000;
  const auto chain = springChain(n, 100.0, 1.0);
  const auto omega = [&](int j) { return 20.0 * std::sin(j * constants::pi / (2.0 * (n + 1))); };
  const Sparse none(n, n);
  const double low = omega(500) - 1e-6, high = omega(511) + 1e-6;
  const auto modes =
      dampedModesNear(chain.M, none, chain.K, {{0.0, 0.5 * (low + high)}, 0.5 * (high - low), 0});
  ASSERT_EQ(modes.values.size(), 12);
  for (int i = 0; i < 12; ++i)
    EXPECT_NEAR(modes.values[i].imag(), omega(500 + i), 1e-9 * omega(500));
}

TEST(NearbyModes, AnEmptyWindowHasNone) {
  const auto chain = springChain(200, 100.0, 1.0);
  const Sparse none(200, 200);
  EXPECT_EQ(dampedModesNear(chain.M, none, chain.K, {{0.0, 40.0}, 5.0, 0}).values.size(), 0);
}

// The shift is an eigenvalue.
TEST(NearbyModes, AShiftThatIsAValueFindsIt) {
  Sparse M(100, 100), K(100, 100), C(100, 100);
  for (int i = 0; i < 100; ++i) M.insert(i, i) = 1.0, K.insert(i, i) = (i + 1.0) * (i + 1.0);
  const auto modes = dampedModesNear(M, C, K, {{0.0, 7.0}, 0.0, 3});
  ASSERT_EQ(modes.values.size(), 3);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(modes.values[i].imag(), 6.0 + i, 1e-9);
}

TEST(NearbyModes, TooManyForTheSpaceAreRefused) {
  const int n = 300;
  const auto chain = springChain(n, 100.0, 1.0);
  const Sparse none(n, n);
  EXPECT_THROW(dampedModesNear(chain.M, none, chain.K, {{0.0, 10.0}, 9.9, 0}), ConvergenceError);
}

}  // namespace NearbyModesTest
