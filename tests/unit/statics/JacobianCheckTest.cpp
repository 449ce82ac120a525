// SPDX-License-Identifier: BSD-3-Clause
#include "statics/JacobianCheck.hpp"

#include <gtest/gtest.h>

#include "Problems.hpp"

namespace tooljoint::statics {
namespace {

using testing::ContactChain;
using testing::DenseProblem;
using testing::rosenbrock;

TEST(JacobianCheck, AcceptsRightJacobians) {
  Vector x(2);
  x << -1.2, 1.0;
  const JacobianError error = checkJacobian(rosenbrock(), x);
  EXPECT_LT(error.relative, 1e-10);
  EXPECT_TRUE(error.patternComplete);
  const ContactChain chain(12, 100.0, 2e3);
  EXPECT_LT(checkJacobian(chain, Vector::LinSpaced(12, -0.012, 0.013), 1e-6).relative, 1e-7);
  testing::StringInHole string(6);
  string.sharpness = 2e3;
  EXPECT_LT(checkJacobian(string, Vector::LinSpaced(12, 0.011, 0.029), 1e-6).relative, 1e-7);
}

TEST(JacobianCheck, FindsOneWrongEntryAndNamesIt) {
  DenseProblem wrong = rosenbrock();
  const auto right = wrong.J;
  wrong.J = [right](const Vector& x) -> Matrix {
    Matrix J = right(x);
    J(0, 1) *= 1.001;
    return J;
  };
  const JacobianError error = checkJacobian(wrong, Vector::Constant(2, 0.7));
  EXPECT_NEAR(error.relative, 1e-3, 1e-5);
  EXPECT_EQ(error.row, 0);
  EXPECT_EQ(error.column, 1);
  EXPECT_NE(error.describe(wrong).find("row x1, column x2"), std::string::npos)
      << error.describe(wrong);
}

TEST(JacobianCheck, FindsAnEntryTheSparsityPatternForgot) {
  struct Forgetful : ContactChain {
    using ContactChain::ContactChain;
    void jacobian(const Vector& x, Sparse& J) const override {
      ContactChain::jacobian(x, J);
      J.prune([](int row, int column, double) { return !(row == 3 && column == 4); });
    }
  };
  const Forgetful chain(8, 100.0, 2e3);
  const JacobianError error = checkJacobian(chain, Vector::Constant(8, 0.004), 1e-6);
  EXPECT_FALSE(error.patternComplete);
  EXPECT_EQ(error.row, 3);
  EXPECT_EQ(error.column, 4);
}

}  // namespace
}  // namespace tooljoint::statics
