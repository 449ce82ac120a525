// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The residual flexibility of a part is that of the truncated modes, sum phi phi'/omega^2 (Rubin
/// 1975).
#include "estimate/ResidualFlexibility.hpp"

#include <Eigen/Eigenvalues>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "estimate/PartResidual.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "reduction/Reduce.hpp"
#include "tests/support/SampleParts.hpp"

namespace ResidualFlexibilityTest {

using namespace tooljoint;

TEST(ResidualFlexibility, IsThatOfTheModesLeftOut) {
  auto part = samples::bar("bar", 1, 6, 600.0, 0.3);
  samples::classify(part, {1, 7});
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {2};
  const auto reduced =
      reduction::reduceAll({part}, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()),
                           options)
          .front();
  const Sparse K = part.model.stiffness.front().matrix;
  const estimate::ResidualFlexibility flexibility(part, *reduced.basis, K);
  const auto& inner = flexibility.interior();
  ASSERT_EQ(inner.size(), 5u);
  EXPECT_EQ(flexibility.truncated(), 3);

  const Matrix stiffness = reduction::block(K, inner, inner),
               mass = reduction::block(part.model.mass, inner, inner);
  const auto modes = linalg::symmetricPairs(stiffness, mass);  // phi' M phi = 1
  Matrix expected = Matrix::Zero(5, 5);
  for (int k = 2; k < 5; ++k)
    expected += modes.vectors.col(k) * modes.vectors.col(k).transpose() / modes.values[k];
  EXPECT_LT((flexibility.apply(Matrix::Identity(5, 5)) - expected).norm(), 1e-12 * expected.norm());
}

/// w = -F r on the interior, r = M D'' + C D' + K D - f(t) with terms of different size and the
/// laws at the given time.
TEST(PartResidual, IsWhatTheEquationsOfThePartLack) {
  auto part = samples::bar("bar", 1, 6, 600.0, 0.3);
  samples::classify(part, {1, 7});
  auto& m = part.model;
  const Sparse K = m.stiffness.front().matrix;
  const int growing = m.lawIndex({"t", [](double t) { return t; }});
  m.damping.push_back({"growing", Sparse(0.02 * K), growing});
  m.loads.push_back({"growing", Vector::LinSpaced(7, 1.0, 4.0).cwiseAbs2(), growing});
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {2};
  const auto reduced =
      reduction::reduceAll({part}, *reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList()),
                           options)
          .front();
  Sparse map(4, 4);
  map.setIdentity();
  const estimate::PartResidual residual(part, reduced, map, {});
  const Vector d = Vector::LinSpaced(7, 0.1, 0.5).cwiseAbs2(),
               v = Vector::LinSpaced(7, 3.0, -2.0).cwiseAbs2(),
               a = Vector::LinSpaced(7, -40.0, 90.0).cwiseAbs2();
  const double t = 1.5;
  const Vector r = m.mass * a + t * 0.02 * (K * v) + K * d - t * m.loads.front().vector;
  const estimate::ResidualFlexibility flexibility(part, *reduced.basis, K);
  const auto& inner = flexibility.interior();
  Vector interior(5);
  for (int i = 0; i < 5; ++i) interior[i] = r[inner[static_cast<std::size_t>(i)]];
  const Vector expected = -flexibility.apply(interior);
  const Vector w = residual.truncated(t, {d, v, a}, Vector::Zero(7));
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(w[inner[static_cast<std::size_t>(i)]], expected[i], 1e-12 * expected.norm()) << i;
  for (const int kept : part.interface) EXPECT_EQ(w[kept], 0.0);
  EXPECT_GT(expected.norm(), 1e-4);
}

}  // namespace ResidualFlexibilityTest
