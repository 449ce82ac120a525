// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The damped modes nearest zero, found by Krylov subspaces, against all of them found dense.
#include <algorithm>
#include <gtest/gtest.h>
#include <vector>

#include "common/Error.hpp"
#include "linalg/EigenSolver.hpp"

namespace {

using namespace tooljoint;
using namespace tooljoint::linalg;

struct Shaft {
  Sparse M, C, K;
};

/// `n` masses with two lateral coordinates each in a chain of springs between walls (or free), gyroscopic coupling g and damping c.
Shaft shaft(int n, double g, double c, bool free) {
  Triplets m, d, k;
  for (int i = 0; i < n; ++i)
    for (int x = 0; x < 2; ++x) {
      const int row = 2 * i + x;
      m.emplace_back(row, row, 1.0 + 0.01 * i);
      d.emplace_back(row, row, c * (1.0 + 0.1 * x));
      d.emplace_back(row, 2 * i + 1 - x, x == 0 ? g : -g);
      const double ends = free ? (i > 0) + (i + 1 < n) : 2.0;
      k.emplace_back(row, row, 100.0 * (1.0 + 0.1 * x) * ends);
      if (i + 1 < n) {
        k.emplace_back(row, row + 2, -100.0 * (1.0 + 0.1 * x));
        k.emplace_back(row + 2, row, -100.0 * (1.0 + 0.1 * x));
      }
    }
  const auto matrix = [n](const Triplets& t) {
    Sparse A(2 * n, 2 * n);
    A.setFromTriplets(t.begin(), t.end());
    return A;
  };
  return {matrix(m), matrix(d), matrix(k)};
}

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
      const Shaft s = shaft(90, g, c, false);
      const auto expected = lowest(s, 10);
      const auto modes = lowestDampedModes(s.M, s.C, s.K, 10);
      ASSERT_EQ(modes.values.size(), 10);
      for (Eigen::Index i = 0; i < 10; ++i) {
        EXPECT_NEAR(std::abs(modes.values[i] - expected[static_cast<std::size_t>(i)]), 0.0, 1e-8 * std::abs(expected[static_cast<std::size_t>(i)]))
            << "g " << g << ", c " << c << ", mode " << i;
        EXPECT_LE(modes.residuals[i], 1e-8);
      }
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
  EXPECT_THROW(lowestDampedModes(s.M, s.C, s.K, 11), ModelError);
}

}  // namespace
