// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Rigid-body motions after rounding to the digits of a text file, and exact numbers.
#include <cmath>
#include <gtest/gtest.h>
#include <utility>
#include <vector>

#include "linalg/trilinos/EigenChecks.hpp"

namespace RoundingOfTextTest {

using namespace tooljoint;
using namespace tooljoint::linalg;

/// x with this number of decimal digits.
double cut(double x, int digits) {
  if (x == 0.0) return x;
  const double last = std::pow(10.0, digits - 1 - std::floor(std::log10(std::abs(x))));
  return std::round(x * last) / last;
}

/// Masses of 1 kg in a row, links of (1 + i / 10) `link`, each on a spring `ground` [N/m].
Matrix row(int n, double link, double ground) {
  Matrix K = ground * Matrix::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i) {
    const double k = (1 + 0.1 * i) * link;
    K(i, i) += k, K(i + 1, i + 1) += k, K(i, i + 1) = K(i + 1, i) = -k;
  }
  return K;
}

QuadraticModes lowest(const Matrix& K, int count) {
  const auto n = K.rows();
  const Sparse M = Matrix(Matrix::Identity(n, n)).sparseView(), k = K.sparseView();
  return lowestDampedModes(M, Sparse(n, n), k, count);
}

/// Truncated entries give a free body a stiffness of the size of rounding, and no growing motion; a
/// held body keeps its lowest value.
TEST(RoundingOfText, LeavesRigidMotionsAtZero) {
  for (const int digits : {9, 12}) {
    const auto text = [digits](double x) { return cut(x, digits); };
    const auto free = lowest(row(30, std::sqrt(2.0), 0.0).unaryExpr(text), 4).values;
    EXPECT_EQ(free[0], 0.0) << digits;
    for (int j = 0; j < 4; ++j) EXPECT_LE(free[j].real(), 1e-12) << digits;
    EXPECT_GT(std::abs(free[1]), 0.05) << digits;
    const auto held = lowest(row(30, std::sqrt(2.0), 1e-3).unaryExpr(text), 1).values;
    EXPECT_NEAR(std::abs(held[0]), std::sqrt(1e-3), 1e-4 * std::sqrt(1e-3)) << digits;
  }
}

/// Chosen numbers are exact whatever their digits: soft springs to the ground beside stiff links.
TEST(RoundingOfText, IsNotThatOfChosenNumbers) {
  for (const auto& [link, ground] :
       {std::pair{1e11, 20.0}, std::pair{1e8, 0.25}, std::pair{1e6, 0.1}})
    for (const int n : {2, 3, 12, 200}) {
      const auto found = lowest(row(n, link, ground), 1).values;
      EXPECT_NEAR(std::abs(found[0]), std::sqrt(ground), 1e-2 * std::sqrt(ground))
          << link << ", " << n << " masses";
    }
}

/// A negative ground stiffness: 999999.9 and 1999999.9 are chosen values, too.
TEST(RoundingOfText, IsNotThatOfADifference) {
  const int n = 200;
  Matrix K = -0.1 * Matrix::Identity(n, n);
  for (int i = 0; i + 1 < n; ++i)
    K.block(i, i, 2, 2) += 1e6 * (Matrix(2, 2) << 1, -1, -1, 1).finished();
  const auto found = lowest(K, 2).values;
  EXPECT_NEAR(found.real().maxCoeff(), std::sqrt(0.1), 1e-3);
}

/// Whole numbers, few digits and all digits.
TEST(RoundingOfText, IsNoneOfWholeNumbersAndFullOnes) {
  const double none = 30 * 2.3e-16;
  const Matrix whole = row(20, 123456789.0, 0.0).unaryExpr([](double x) { return std::round(x); });
  EXPECT_LT(roundingOf(whole.sparseView()), none);
  EXPECT_LT(roundingOf(row(20, 2.5, 0.0).sparseView()), none);
  EXPECT_LT(roundingOf(row(20, std::sqrt(2.0), 0.0).sparseView()), none);
  const Matrix given = row(20, std::sqrt(2.0), 0.0).unaryExpr([](double x) { return cut(x, 10); });
  EXPECT_NEAR(roundingOf(given.sparseView()), 0.5e-9, 1e-15);
}

/// A computed eigenvalue of a rigid-body motion has the rounding of the largest ones, which may be
/// more than that of its energy.
TEST(AreRounding, IsToldByTheEnergyOfTheShapeToo) {
  const Sparse K = row(20, 1e6, 0.0).sparseView();
  Matrix shapes = Matrix::Ones(20, 2);
  shapes(0, 1) = -1.0;  // stretches the first link
  const Vector values{{1e-3, 4e6}};
  EXPECT_EQ(areRounding(values, shapes, K), (std::vector<char>{1, 0}));
}

}  // namespace RoundingOfTextTest
