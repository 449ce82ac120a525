// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// MacNeal's and Craig and Chang's matrices against their formulas; parts with little residual
/// flexibility; integrators that accept them.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "tests/support/BasisFamilies.hpp"
#include "transient/Transient.hpp"

namespace MacNealTest {

using namespace tooljoint;
using namespace tooljoint::reduction;
using samples::modes;

ReducedSubstructure reduced(const model::Substructure& part, const std::string& basis,
                            const ModeRequest& request) {
  return reduce(part, makeBasis(basis, Teuchos::ParameterList())->build(part, request),
                ReductionOptions(), 0);
}

/// The clamped column of a frame, symmetric: K^-1 exists.
model::Substructure column() { return samples::loopFrame(6, false)[0]; }

TEST(MacNeal, MatricesAreThoseOfTheFormulas) {
  const auto part = column();
  const int m = 5;
  const Matrix K = constantStiffness(part.model), M = part.model.mass;
  const auto all = linalg::symmetricPairs(K, M);
  const Matrix Phi = all.vectors.leftCols(m);
  const Vector lambda = all.values.head(m);
  Matrix Gr = linalg::inverseOf(K);
  for (int k = 0; k < m; ++k) Gr -= Phi.col(k) * Phi.col(k).transpose() / lambda[k];
  Matrix G(3, 3), Phib(3, m), Psi(K.rows(), 3);
  for (int i = 0; i < 3; ++i) {
    Psi.col(i) = Gr.col(part.interface[static_cast<std::size_t>(i)]);
    Phib.row(i) = Phi.row(part.interface[static_cast<std::size_t>(i)]);
  }
  for (int i = 0; i < 3; ++i) G.row(i) = Psi.row(part.interface[static_cast<std::size_t>(i)]);
  const Matrix F = linalg::inverseOf(G), H = F * Psi.transpose() * M * Psi * F;
  Matrix k(3 + m, 3 + m), mass = Matrix::Zero(3 + m, 3 + m);
  k << F, -F * Phib, -Phib.transpose() * F,
      Matrix(lambda.asDiagonal()) + Phib.transpose() * F * Phib;
  mass.bottomRightCorner(m, m).setIdentity();

  const auto near = [](const Matrix& a,
                       const Matrix& b) {  // signs of modes are free: absolute values
    const Vector s = b.diagonal().cwiseAbs().cwiseSqrt();
    double worst = 0;
    for (Eigen::Index i = 0; i < a.rows(); ++i)
      for (Eigen::Index j = 0; j < a.cols(); ++j)
        worst = std::max(
            worst, std::abs(std::abs(a(i, j)) - std::abs(b(i, j))) / std::max(s[i] * s[j], 1e-300));
    return worst;
  };
  const auto macNeal = reduced(part, "MacNeal", modes(m));
  EXPECT_LT(near(macNeal.model.stiffness.front().matrix, k), 1e-7);
  EXPECT_EQ((Matrix(macNeal.model.mass) - mass).norm(), 0.0) << "no mass but that of the modes";
  EXPECT_EQ(macNeal.model.mass.nonZeros(), m);
  EXPECT_LT(macNeal.report.staticDefect, 1e-9);
  EXPECT_LT(macNeal.report.explicitStep, 0);

  const auto craigChang = reduced(part, "Craig-Chang", modes(m));
  Matrix withMass = mass;
  withMass.topLeftCorner(3, 3) = H;
  withMass.topRightCorner(3, m) = -H * Phib;
  withMass.bottomLeftCorner(m, 3) = -Phib.transpose() * H;
  withMass.bottomRightCorner(m, m) += Phib.transpose() * H * Phib;
  EXPECT_LT(near(craigChang.model.stiffness.front().matrix, k), 1e-7);
  EXPECT_LT(near(craigChang.model.mass, withMass), 1e-7);
  for (int i = 0; i < m; ++i)
    EXPECT_NEAR(craigChang.basis->eigenvalues[i], lambda[i], 1e-9 * lambda[i]);
}

TEST(MacNeal, DampingActsOnTheModesAlone) {
  auto part = column();
  part.model.damping.push_back(
      {"Rayleigh", Sparse(0.3 * part.model.mass + 1e-4 * constantStiffness(part.model)), 0});
  const auto small = reduced(part, "MacNeal", modes(4));
  const Matrix c = small.model.damping.front().matrix;
  EXPECT_LT(c.topRows(3).cwiseAbs().maxCoeff(), 1e-10 * c.cwiseAbs().maxCoeff());
  for (int i = 0; i < 4; ++i) {
    const double expected = 0.3 + 1e-4 * small.basis->eigenvalues[i];
    EXPECT_NEAR(c(3 + i, 3 + i), expected, 1e-8 * expected);
  }
}

TEST(MacNeal, FewAndAllModesLeaveAUsableModel) {
  const auto part = column();
  const Vector exact = samples::eigenvalues(part.model);
  const int n = part.model.size();
  for (int m = n - 4; m <= n; ++m) {
    const auto small = reduced(part, "MacNeal", modes(m));
    const Vector values = samples::eigenvalues(small.model);
    ASSERT_GE(values.size(), n - 4);
    for (int k = 0; k < 6; ++k)
      EXPECT_NEAR(values[k], exact[k], 1e-6 * exact[k]) << m << " of " << n << " modes";
    EXPECT_LT(small.report.staticDefect, 1e-8);
  }
}

class Nothing : public transient::SampleSink {
 public:
  void sample(double, const Vector& q, const Vector&, const Vector&) override { last = q; }
  Vector last;
};

TEST(MacNeal, RunsWithImplicitIntegratorsOnly) {
  auto parts = samples::loopFrame(6, false);
  Vector load = Vector::Zero(parts[2].model.size());
  load[4] = 1e4;
  parts[2].model.loads.push_back({"push", load, 0});
  const auto coupled = samples::synthesised(parts, {"MacNeal", "", ""}, 6).coupled.model;
  const auto rubin = samples::synthesised(parts, {"Rubin", "", ""}, 6).coupled.model;
  transient::TransientOptions options;
  options.end = 0.05;
  options.step = 1e-4;
  options.sampling = 1e-2;
  options.progress = false;
  options.integrator = "Generalized-alpha";
  Nothing sink, other;
  transient::integrate(coupled, options, sink);
  transient::integrate(rubin, options, other);
  const Vector a = coupled.recovery * sink.last, b = rubin.recovery * other.last;
  EXPECT_GT(b.cwiseAbs().maxCoeff(), 0.0);
  EXPECT_LT((a - b).cwiseAbs().maxCoeff(), 0.05 * b.cwiseAbs().maxCoeff());
  options.integrator = "RK4";
  try {
    transient::integrate(coupled, options, sink);
    FAIL() << "RK4 cannot run a singular mass";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("mass matrix is singular"), std::string::npos)
        << error.what();
  }
}

}  // namespace MacNealTest
