// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes matched one to one, repeated ones as subspaces.
#include "estimate/ModeMatching.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <set>

#include "common/Constants.hpp"

namespace ModeMatchingTest {

using namespace tooljoint;
using estimate::matchModes;

Sparse identity(int n) {
  Sparse M(n, n);
  M.setIdentity();
  return M;
}

Eigen::VectorXcd frequencies(const std::vector<double>& omega) {
  Eigen::VectorXcd s(static_cast<Eigen::Index>(omega.size()));
  for (std::size_t i = 0; i < omega.size(); ++i)
    s[static_cast<Eigen::Index>(i)] = std::complex<double>(0, omega[i]);
  return s;
}

Eigen::MatrixXcd rotated(double angle) {
  Matrix R = Matrix::Identity(4, 4);
  R(1, 1) = R(2, 2) = std::cos(angle);
  R(1, 2) = -std::sin(angle);
  R(2, 1) = std::sin(angle);
  return R.cast<std::complex<double>>();
}

TEST(ModeMatching, ARepeatedModeIsASubspace) {
  const Eigen::MatrixXcd own = Matrix::Identity(4, 4).cast<std::complex<double>>();
  for (double angle : {0.0, 0.4, constants::pi / 4, 1.3}) {
    const auto matches = matchModes(identity(4), frequencies({1, 2, 2, 3}), own,
                                    frequencies({1, 2, 2, 3}), rotated(angle));
    std::set<int> partners;
    for (const auto& match : matches) {
      EXPECT_NEAR(match.mac, 1.0, 1e-12) << angle;
      partners.insert(match.partner);
    }
    EXPECT_EQ(partners, (std::set<int>{0, 1, 2, 3})) << angle;
    EXPECT_EQ(matches[1].partner, 1) << "in the order of the candidates";
  }
}

// Distinct values are compared one by one, and a candidate that resembles two of them is taken
// once.
TEST(ModeMatching, NoCandidateIsTakenTwice) {
  const Eigen::MatrixXcd own = Matrix::Identity(3, 3).cast<std::complex<double>>();
  Matrix others(3, 3);  // the first resembles modes 1 and 2, the second nothing better than mode 2
  others << 0.8, 0.5, 0.0, 0.6, 0.1, 0.0, 0.0, 0.8, 1.0;
  const auto matches = matchModes(identity(3), frequencies({1, 2, 3}), own, frequencies({1, 2, 3}),
                                  others.cast<std::complex<double>>());
  EXPECT_EQ(matches[0].partner, 0);
  EXPECT_EQ(matches[1].partner, 1);
  EXPECT_EQ(matches[2].partner, 2);
  EXPECT_NEAR(matches[0].mac, 0.64, 1e-12);
  EXPECT_NEAR(matches[1].mac, 0.01 / 0.9, 1e-12);
}

TEST(ModeMatching, TheLeastCosineOfThePrincipalAnglesCounts) {
  // span(e1, e2) against span(e1, cos a e2 + sin a e3)
  const double a = 0.3;
  Matrix own = Matrix::Identity(4, 2), others = Matrix::Zero(4, 2);
  others(0, 0) = 1;
  others(1, 1) = std::cos(a);
  others(2, 1) = std::sin(a);
  const auto matches =
      matchModes(identity(4), frequencies({5, 5}), own.cast<std::complex<double>>(),
                 frequencies({5, 5}), others.cast<std::complex<double>>());
  for (const auto& match : matches) EXPECT_NEAR(match.mac, std::cos(a) * std::cos(a), 1e-12);
}

TEST(ModeMatching, TheMassMatrixWeighs) {
  Sparse M = identity(2);
  M.coeffRef(1, 1) = 9.0;
  const Eigen::MatrixXcd own = (Matrix(2, 1) << 1, 0).finished().cast<std::complex<double>>();
  const Eigen::MatrixXcd other = (Matrix(2, 1) << 1, 1).finished().cast<std::complex<double>>();
  EXPECT_NEAR(matchModes(M, frequencies({1}), own, frequencies({1}), other)[0].mac, 0.1, 1e-14);
}

// Two motions of one shape: an overdamped one decays at two rates, a free one at 0 and c/m.
TEST(ModeMatching, ValuesTellModesOfOneShapeApart) {
  const Eigen::MatrixXcd own =
      (Matrix(2, 4) << 1, 1, 0, 0, 0, 0, 1, 1).finished().cast<std::complex<double>>();
  Eigen::VectorXcd values(4), others(4);
  values << 0.0, -0.5, -1.0, -100.0;
  others << -100.1, -1.001, -0.5, 0.0;
  const auto matches = matchModes(identity(2), values, own, others, own.rowwise().reverse());
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(matches[static_cast<std::size_t>(i)].partner, 3 - i);
    EXPECT_NEAR(matches[static_cast<std::size_t>(i)].mac, 1.0, 1e-14);
  }
}

TEST(ModeMatching, SaysWhenNoCandidateIsLeft) {
  const Eigen::MatrixXcd own = Matrix::Identity(3, 3).cast<std::complex<double>>();
  const auto matches =
      matchModes(identity(3), frequencies({1, 2, 3}), own, frequencies({1, 2}), own.leftCols(2));
  EXPECT_EQ(matches[2].partner, -1);
  EXPECT_EQ(matches[2].mac, 0.0);
}

}  // namespace ModeMatchingTest
