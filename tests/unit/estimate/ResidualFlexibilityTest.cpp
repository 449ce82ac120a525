// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The residual flexibility of a part is that of the modes its basis leaves out, sum phi phi'/omega^2 (Rubin 1975).
#include "estimate/ResidualFlexibility.hpp"

#include <Eigen/Eigenvalues>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace {

using namespace tooljoint;

TEST(ResidualFlexibility, IsThatOfTheModesLeftOut) {
  auto part = samples::bar("bar", 1, 6, 600.0, 0.3);
  samples::classify(part, {1, 7});
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {2};
  const auto reduced =
      reduction::reduceAll({part}, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()), options).front();
  const Sparse K = part.model.stiffness.front().matrix;
  const estimate::ResidualFlexibility flexibility(part, *reduced.basis, K);
  const auto& inner = flexibility.interior();
  ASSERT_EQ(inner.size(), 5u);
  EXPECT_EQ(flexibility.truncated(), 3);

  const Matrix stiffness = reduction::block(K, inner, inner), mass = reduction::block(part.model.mass, inner, inner);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> modes(stiffness, mass);  // phi' M phi = 1
  Matrix expected = Matrix::Zero(5, 5);
  for (int k = 2; k < 5; ++k)
    expected += modes.eigenvectors().col(k) * modes.eigenvectors().col(k).transpose() / modes.eigenvalues()[k];
  EXPECT_LT((flexibility.apply(Matrix::Identity(5, 5)) - expected).norm(), 1e-12 * expected.norm());
}

}  // namespace
