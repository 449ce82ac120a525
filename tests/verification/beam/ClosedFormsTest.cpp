// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Straight beams against closed forms: buckling under force and torque, frequencies of rods,
/// beam-columns, chains and spinning shafts. With n Hermite elements the relative error of a mode
/// with k half waves is of order (k pi/n)^4/720.
#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "tests/support/StraightBeam.hpp"

namespace tooljoint::beam {
namespace ClosedFormsTest {

using constants::pi;
using testing_::StraightBeam;
const std::vector<int> lateral{0, 1, 3, 4};

Section slender() {
  return Section::hollow(0.0635, 0.054, Material{7900.0, 2.03e11, 0.3}).withoutShear();
}

/// u = v = 0 at both ends.
std::vector<int> pinned(const StraightBeam& beam) {
  return beam.free(lateral, {0, 1, beam.tip(), beam.tip() + 1});
}
std::vector<int> clamped(const StraightBeam& beam) {
  return beam.free(lateral,
                   {0, 1, 3, 4, beam.tip(), beam.tip() + 1, beam.tip() + 3, beam.tip() + 4});
}

Matrix select(const Matrix& m, const std::vector<int>& dofs) {
  const auto n = static_cast<int>(dofs.size());
  Matrix out(n, n);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j)
      out(i, j) = m(dofs[static_cast<std::size_t>(i)], dofs[static_cast<std::size_t>(j)]);
  return out;
}

Vector frequencies(const Matrix& k, const Matrix& m, const std::vector<int>& dofs) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Matrix> eigen(select(k, dofs), select(m, dofs),
                                                               Eigen::EigenvaluesOnly);
  return eigen.eigenvalues().cwiseSqrt();
}

/// Smallest factor > 0 for which k + factor g is singular (g may be unsymmetric).
double criticalFactor(const Matrix& k, const Matrix& g, const std::vector<int>& dofs) {
  const Matrix ratio = select(k, dofs).partialPivLu().solve(select(-g, dofs));
  const Eigen::EigenSolver<Matrix> eigen(ratio, false);
  double largest = 0.0;
  for (int i = 0; i < eigen.eigenvalues().size(); ++i)
    if (std::abs(eigen.eigenvalues()(i).imag()) < 1e-6 * std::abs(eigen.eigenvalues()(i)))
      largest = std::max(largest, eigen.eigenvalues()(i).real());
  return 1.0 / largest;
}

TEST(Buckling, EulerPinnedAndClamped) {
  const Section s = slender();
  const StraightBeam beam{16, 20.0};
  const Matrix k = beam.assemble(stiffness(s, beam.elementLength()));
  const Matrix g = -beam.assemble(geometricAxial(beam.elementLength()));  // compression
  const double euler = pi * pi * s.youngModulus() * s.inertiaX() / (beam.length * beam.length);
  EXPECT_NEAR(criticalFactor(k, g, pinned(beam)) / euler, 1.0, 5e-6);
  EXPECT_NEAR(criticalFactor(k, g, clamped(beam)) / euler, 4.0, 4.0 * 5e-5);
}

TEST(Buckling, ShearLowersTheEulerLoad) {
  // A stocky tube, Engesser: P = P_E/(1 + P_E/(beta G S)).
  const Section s = Section::hollow(0.1, 0.09, Material{7900.0, 2.03e11, 0.3});
  const StraightBeam beam{32, 1.0};
  const Matrix k = beam.assemble(stiffness(s, beam.elementLength()));
  const Matrix g = -beam.assemble(geometricAxial(beam.elementLength()));
  const double euler = pi * pi * s.youngModulus() * s.inertiaX() / (beam.length * beam.length);
  const double engesser = euler / (1.0 + euler / (0.9 * s.shearModulus() * s.area()));
  ASSERT_LT(engesser, 0.9 * euler);
  EXPECT_NEAR(criticalFactor(k, g, pinned(beam)) / engesser, 1.0, 0.01);
}

TEST(Buckling, GreenhillUnderTorqueAlone) {
  const Section s = slender();
  const StraightBeam beam{24, 20.0};
  const Matrix k = beam.assemble(stiffness(s, beam.elementLength()));
  const Matrix g = beam.assemble(geometricTorque(beam.elementLength()));
  const double unit = s.youngModulus() * s.inertiaX() / beam.length;
  EXPECT_NEAR(criticalFactor(k, g, pinned(beam)) / unit, 2.0 * pi, 2.0 * pi * 2e-5);
  EXPECT_NEAR(criticalFactor(k, g, clamped(beam)) / unit, 8.987, 8.987 * 1e-4);
  // and from the other side
  EXPECT_NEAR(criticalFactor(k, -g, pinned(beam)) / unit, 2.0 * pi, 2.0 * pi * 2e-5);
}

TEST(Buckling, ForceAndTorqueTogether) {
  // P/P_E + (T/T_cr)^2 = 1, also for tension (P < 0)
  const Section s = slender();
  const StraightBeam beam{24, 20.0};
  const double euler = pi * pi * s.youngModulus() * s.inertiaX() / (beam.length * beam.length);
  const double greenhill = 2.0 * pi * s.youngModulus() * s.inertiaX() / beam.length;
  const Matrix elastic = beam.assemble(stiffness(s, beam.elementLength()));
  const Matrix axial = beam.assemble(geometricAxial(beam.elementLength()));
  const Matrix torque = beam.assemble(geometricTorque(beam.elementLength()));
  for (const double ratio : {0.75, 0.5, -1.0}) {
    const double critical = criticalFactor(elastic - ratio * euler * axial, torque, pinned(beam));
    EXPECT_NEAR(ratio + std::pow(critical / greenhill, 2), 1.0, 2e-4) << ratio;
  }
}

TEST(Frequencies, BeamColumn) {
  // omega^2 = (E I q^4 + T q^2)/(rho S + rho I q^2), q = k pi/L
  const Section s = slender();
  const StraightBeam beam{24, 20.0};
  const double euler = pi * pi * s.youngModulus() * s.inertiaX() / (beam.length * beam.length);
  const Matrix m = beam.assemble(mass(s, beam.elementLength()));
  for (const double tension : {0.0, 2.0 * euler, -0.5 * euler}) {
    const Matrix k = beam.assemble(stiffness(s, beam.elementLength()) +
                                   tension * geometricAxial(beam.elementLength()));
    const Vector omega = frequencies(k, m, pinned(beam));
    for (int mode = 1; mode <= 3; ++mode) {
      const double q = mode * pi / beam.length;
      const double exact =
          std::sqrt((s.youngModulus() * s.inertiaX() * std::pow(q, 4) + tension * q * q) /
                    (s.massPerLength() + s.density() * s.inertiaX() * q * q));
      for (int plane = 0; plane < 2; ++plane)
        EXPECT_NEAR(omega(2 * (mode - 1) + plane) / exact, 1.0, 2e-5);
    }
  }
}

TEST(Frequencies, QuarterWaveRods) {
  // fixed-free: omega_k = (2 k - 1) pi c/(2 L); linear elements are too stiff by (omega h/c)^2/24
  const Section s = slender();
  const StraightBeam beam{60, 30.0};
  const Matrix k = beam.assemble(stiffness(s, beam.elementLength()));
  const Matrix m = beam.assemble(mass(s, beam.elementLength()));
  const double axialSpeed = std::sqrt(s.youngModulus() / s.density());
  const double torsionSpeed = std::sqrt(s.shearModulus() / s.density());
  const Vector axial = frequencies(k, m, beam.free({2}, {2}));
  const Vector torsion = frequencies(k, m, beam.free({5}, {5}));
  for (int mode = 1; mode <= 3; ++mode) {
    const double wave = (2 * mode - 1) * pi / (2.0 * beam.length);
    const double error = std::pow(wave * beam.elementLength(), 2) / 24.0;
    EXPECT_NEAR(axial(mode - 1) / (wave * axialSpeed), 1.0 + error, 0.02 * error);
    EXPECT_NEAR(torsion(mode - 1) / (wave * torsionSpeed), 1.0 + error, 0.02 * error);
  }
}

TEST(Frequencies, RodWithEndMass) {
  // lambda tan lambda = rho S L/M
  const Section s = slender();
  const StraightBeam beam{60, 30.0};
  const double tipMass = 2.0 * s.massPerLength() * beam.length;
  double lambda = 0.5;
  for (int i = 0; i < 50; ++i) lambda = std::atan(0.5 / lambda) * 0.5 + 0.5 * lambda;
  ASSERT_NEAR(lambda * std::tan(lambda), 0.5, 1e-12);
  const Matrix k = beam.assemble(stiffness(s, beam.elementLength()));
  Matrix m = beam.assemble(mass(s, beam.elementLength()));
  m(beam.tip() + 2, beam.tip() + 2) += tipMass;
  const double omega = frequencies(k, m, beam.free({2}, {2}))(0);
  EXPECT_NEAR(omega * beam.length / std::sqrt(s.youngModulus() / s.density()) / lambda, 1.0, 1e-5);
}

TEST(Frequencies, HangingChain) {
  // omega = j_k/2 sqrt(g/L) with the zeros of J_0; a bending stiffness of 1e-7 w L^3 shifts it by
  // about its square root
  const double g = 9.81;
  const Material rope{7900.0, 2.03e11, 0.3};
  const StraightBeam beam{60, 100.0};
  const double area = 1e-3;
  const double weight = 7900.0 * area * g;
  const double inertia = 1e-8 * weight * std::pow(beam.length, 3) / rope.youngModulus;
  const Section s = Section::general(area, inertia, inertia, 1e-9, rope);
  const double l = beam.elementLength();
  const Matrix k = beam.assemble([&](int e) -> Matrix12 {
    const double tension = weight * (beam.length - (e + 0.5) * l);
    return stiffness(s, l) + tension * geometricAxial(l);
  });
  const Matrix m = weight / g * beam.assemble(lateralMass(l));
  const Vector omega = frequencies(k, m, beam.free(lateral, {0, 1}));
  const double unit = std::sqrt(g / beam.length);
  const double exact[] = {1.20241, 2.76004, 4.32686};
  for (int mode = 0; mode < 3; ++mode)
    EXPECT_NEAR(omega(2 * mode) / unit / exact[mode], 1.0, 5e-4) << mode;
}

TEST(Frequencies, GyroscopicSplittingOfAPinnedShaft) {
  // (rho S + rho I q^2) w^2 - 2 rho I q^2 Omega w - E I q^4 = 0: the positive root whirls forward
  const Section s = Section::hollow(0.1, 0.0, Material{7900.0, 2.03e11, 0.3}).withoutShear();
  const StraightBeam beam{12, 1.5};
  const double speed = 1500.0;
  const auto dofs = pinned(beam);
  const auto n = static_cast<int>(dofs.size());
  const Matrix c = beam.assemble(gyroscopic(s, beam.elementLength()));
  const Matrix gyro = select(speed * (c.transpose() - c), dofs);
  const Matrix stiff = select(beam.assemble(stiffness(s, beam.elementLength())), dofs);
  const Eigen::PartialPivLU<Matrix> inertia(
      select(beam.assemble(mass(s, beam.elementLength())), dofs));
  Matrix state = Matrix::Zero(2 * n, 2 * n);
  state.topRightCorner(n, n).setIdentity();
  state.bottomLeftCorner(n, n) = -inertia.solve(stiff);
  state.bottomRightCorner(n, n) = -inertia.solve(gyro);
  const Eigen::EigenSolver<Matrix> eigen(state);

  const double q = pi / beam.length;
  const double a = s.massPerLength() + s.density() * s.inertiaX() * q * q;
  const double b = s.density() * s.inertiaX() * q * q * speed;
  const double root = std::sqrt(b * b + a * s.youngModulus() * s.inertiaX() * std::pow(q, 4));
  const double forward = (b + root) / a;
  const double backward = (root - b) / a;
  ASSERT_GT(forward, 1.02 * backward);
  std::vector<std::pair<double, int>> positive;
  for (int i = 0; i < 2 * n; ++i)
    if (eigen.eigenvalues()(i).imag() > 0.0)
      positive.emplace_back(eigen.eigenvalues()(i).imag(), i);
  std::sort(positive.begin(), positive.end());
  EXPECT_NEAR(positive[0].first / backward, 1.0, 1e-5);
  EXPECT_NEAR(positive[1].first / forward, 1.0, 1e-5);
  // forward: v lags u by a quarter turn, v = -i u (x turns into y)
  const auto u = std::find(dofs.begin(), dofs.end(), 6 * (beam.elements / 2)) - dofs.begin();
  const Eigen::MatrixXcd vectors = eigen.eigenvectors();
  const auto ratio = [&](int mode) {
    const int column = positive[static_cast<std::size_t>(mode)].second;
    return vectors(u + 1, column) / vectors(u, column);
  };
  EXPECT_LT(std::abs(ratio(1) - std::complex<double>(0.0, -1.0)), 1e-3);
  EXPECT_LT(std::abs(ratio(0) - std::complex<double>(0.0, 1.0)), 1e-3);
}

}  // namespace ClosedFormsTest
}  // namespace tooljoint::beam
