// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Linear models against modal solutions, matrix exponentials and closed forms of rotor dynamics.
#include <Eigen/Eigenvalues>
#include <complex>
#include <gtest/gtest.h>
#include <unsupported/Eigen/MatrixFunctions>

#include "../../unit/transient/Models.hpp"
#include "common/Constants.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "substructures/beam/BeamMatrices.hpp"

namespace tooljoint::transient::testing {
namespace LinearMotionTest {

const std::vector<std::string> all = {"Generalized-alpha", "RK4", "RK4 adaptive"};

/// A clamped shaft of `elements` spinning beam elements in a skew frame, so that all six dofs of a
/// node are coupled.
model::SecondOrderModel shaft(int elements, double spin, double damping, double torque) {
  const auto section = beam::Section::hollow(0.05, 0.02, {7800, 2.1e11, 0.3});
  const double l = 0.5;
  const int nodes = elements;  // node 0 is clamped
  const int n = 6 * nodes;
  const Matrix3 frame = (Matrix3() << 0.6, -0.8, 0, 0.48, 0.36, 0.8, -0.64, -0.48, 0.6).finished();
  const beam::Matrix12 R = beam::rotation12(frame, Matrix3::Identity(), Matrix3::Identity());
  Matrix M = Matrix::Zero(n, n), C = M, K = M;
  for (int e = 0; e < elements; ++e) {
    const beam::Matrix12 G = beam::gyroscopic(section, l);
    const beam::Matrix12 mass = beam::mass(section, l);
    const beam::Matrix12 m = R.transpose() * mass * R;
    const beam::Matrix12 c = R.transpose() * (spin * (G.transpose() - G) + damping * mass) * R;
    const beam::Matrix12 k =
        R.transpose() * (beam::stiffness(section, l) + torque * beam::geometricTorque(l)) * R;
    for (int i = 0; i < 12; ++i)
      for (int j = 0; j < 12; ++j) {
        const int row = 6 * (e - 1) + i, column = 6 * (e - 1) + j;
        if (row < 0 || column < 0) continue;
        M(row, column) += m(i, j), C(row, column) += c(i, j), K(row, column) += k(i, j);
      }
  }
  return denseModel(M, C, K, 6);
}

/// Error of the samples against exp(A t), relative to the largest displacement.
double errorAgainstExponential(const model::SecondOrderModel& model, const TransientOptions& o) {
  const int n = model.size();
  // In the coordinates D q, D q'/w with D = sqrt(diag M), w = 1e4 rad/s the exponential is well
  // scaled.
  const double w = 1e4;
  const Vector D = Matrix(model.mass).diagonal().cwiseSqrt();
  const Matrix M =
      D.cwiseInverse().asDiagonal() * Matrix(model.mass) * D.cwiseInverse().asDiagonal();
  const Matrix K =
      D.cwiseInverse().asDiagonal() * Matrix(model.stiffnessAt(0)) * D.cwiseInverse().asDiagonal();
  const Matrix C =
      D.cwiseInverse().asDiagonal() * Matrix(model.dampingAt(0)) * D.cwiseInverse().asDiagonal();
  Matrix A = Matrix::Zero(2 * n, 2 * n);
  A.topRightCorner(n, n) = w * Matrix::Identity(n, n);
  A.bottomLeftCorner(n, n) = -linalg::inverseOf(M) * K / w;
  A.bottomRightCorner(n, n) = -linalg::inverseOf(M) * C;
  const Matrix step = (A * o.sampling).exp();
  Keep samples;
  integrate(model, o, samples);
  Vector x(2 * n);
  x << D.cwiseProduct(model.initialDisplacement), D.cwiseProduct(model.initialVelocity) / w;
  double error = 0, size = 0;
  for (const auto& q : samples.q) {
    const Vector exact = x.head(n).cwiseQuotient(D);
    error = std::max(error, (q - exact).cwiseAbs().maxCoeff());
    size = std::max(size, exact.cwiseAbs().maxCoeff());
    x = step * x;
  }
  return error / size;
}

/// The three softest shapes of the shaft as initial displacement, which an integrator resolves with
/// a reasonable step.
void bend(model::SecondOrderModel& model) {
  const Matrix K(model.stiffness[0].matrix);
  const auto modes = linalg::symmetricPairs(0.5 * (K + K.transpose()), Matrix(model.mass));
  model.initialDisplacement =
      1e-2 * (modes.vectors.col(0) + 0.5 * modes.vectors.col(1) - 0.2 * modes.vectors.col(2));
}

TEST(LinearMotion, spinningTwistedShaftFollowsTheMatrixExponential) {
  auto model = shaft(6, 300.0, 2.0, 1e4);
  bend(model);
  auto o = options("RK4", 0.05, 4e-6, 0.005);
  EXPECT_LT(errorAgainstExponential(model, o), 1e-6);
  o = options("Generalized-alpha", 0.05, 2e-6, 0.005);
  EXPECT_LT(errorAgainstExponential(model, o), 1e-4);
  o = options("RK4 adaptive", 0.05, 0, 0.005);
  o.own.set("Tolerance", 1e-8);
  EXPECT_LT(errorAgainstExponential(model, o), 1e-4);
}

/// Without torque the start excites soft modes only, and reasonable steps show the order of the
/// method.
TEST(LinearMotion, shaftConvergesAtTheOrderOfTheMethod) {
  auto model = shaft(6, 300.0, 2.0, 0.0);
  bend(model);
  const auto error = [&](double h, bool corrected) {
    auto o = options("Generalized-alpha", 0.05, h, 0.01);
    o.own.set("Phase Correction", corrected);
    return errorAgainstExponential(model, o);
  };
  EXPECT_NEAR(std::log2(error(4e-5, false) / error(2e-5, false)), 2.0, 0.1);
  EXPECT_LT(error(4e-5, true), 0.1 * error(4e-5, false));
}

TEST(LinearMotion, chainFollowsItsModes) {
  // omega_j = 2 sqrt(k/m) sin(j pi / (2 (n + 1))), shapes sin(i j pi / (n + 1));
  // stiffness-proportional damping.
  const int n = 30;
  const double m = 0.5, k = 2e3, c = 0.2;
  auto model = springChain(n, m, c, k);
  model.initialDisplacement[4] = 0.01;
  model.initialVelocity[20] = -0.3;
  for (const auto& integrator : all) {
    Keep samples;
    auto o = options(integrator, 0.5,
                     integrator == "RK4"                 ? 5e-4
                     : integrator == "Generalized-alpha" ? 1e-5
                                                         : 0,
                     0.05);
    if (integrator == "RK4 adaptive") o.own.set("Tolerance", 1e-6);
    integrate(model, o, samples);
    for (std::size_t s = 0; s < samples.time.size(); ++s) {
      const double t = samples.time[s];
      Vector exact = Vector::Zero(n);
      for (int j = 1; j <= n; ++j) {
        Vector shape(n);
        for (int i = 0; i < n; ++i)
          shape[i] = std::sqrt(2.0 / (n + 1)) * std::sin((i + 1) * j * constants::pi / (n + 1));
        const double omega = 2 * std::sqrt(k / m) * std::sin(j * constants::pi / (2.0 * (n + 1)));
        const double zeta = 0.5 * c / k * omega;
        const double wd = omega * std::sqrt(1 - zeta * zeta);
        const double a = shape.dot(model.initialDisplacement), b = shape.dot(model.initialVelocity);
        exact += shape * std::exp(-zeta * omega * t) *
                 (a * std::cos(wd * t) + (b + zeta * omega * a) / wd * std::sin(wd * t));
      }
      EXPECT_LT((samples.q[s] - exact).cwiseAbs().maxCoeff(), 2e-5) << integrator << " at " << t;
    }
  }
}

TEST(LinearMotion, gyroscopicRotorKeepsItsEnergyAndItsWhirl) {
  // A disc on isotropic springs: I theta'' + Ip Omega J theta' + k theta = 0 turns at w = (+-g +
  // sqrt(g^2 + 4 k/I))/2, g = Ip Omega/I.
  const double inertia = 0.4, g = 25.0, k = 90.0;
  auto model =
      denseModel(inertia * Matrix::Identity(2, 2), Matrix(), k * Matrix::Identity(2, 2), 2);
  Matrix G(2, 2);
  G << 0, g * inertia, -g * inertia, 0;
  model.damping.push_back({"gyroscopic", G.sparseView(), 0});
  model.initialDisplacement << 0.1, 0;
  const double root = std::sqrt(g * g + 4 * k / inertia);
  const double forward = 0.5 * (g + root), backward = 0.5 * (g - root);
  for (const auto& integrator : all) {
    Keep samples;
    auto o = options(integrator, 20.0, integrator == "RK4 adaptive" ? 0 : 1e-3, 0.5);
    if (integrator == "Generalized-alpha") o.own.set("Spectral Radius", 1.0);
    if (integrator == "RK4 adaptive") o.own.set("Tolerance", 1e-7);
    const auto report = integrate(model, o, samples);
    for (std::size_t s = 0; s < samples.time.size(); ++s) {
      // z = u + i v solves z'' - i g z' + (k/I) z = 0 with z(0) = 0.1, z'(0) = 0
      const double t = samples.time[s];
      const std::complex<double> i(0, 1);
      const std::complex<double> z =
          0.1 / (forward - backward) *
          (-backward * std::exp(i * forward * t) + forward * std::exp(i * backward * t));
      EXPECT_NEAR(samples.q[s][0], z.real(), 2e-3) << integrator << " at " << t;
      EXPECT_NEAR(samples.q[s][1], z.imag(), 2e-3) << integrator << " at " << t;
    }
    const double energy = report.energy.kinetic + report.energy.strain;
    EXPECT_NEAR(energy / (0.5 * k * 0.01), 1.0, 1e-4) << integrator;
    EXPECT_TRUE(report.energy.damping.empty());
  }
}

TEST(LinearMotion, harmonicForceSettlesToItsResponse) {
  // After the decay of the transient: amplitude F / sqrt((k - m w^2)^2 + (c w)^2), phase atan2(c w,
  // k - m w^2).
  const double m = 1, c = 8, k = 900, w = 25, F = 3;
  auto model = oscillator(m, c, k, 0, 0);
  const int law = model.lawIndex({"cos", [w](double t) { return std::cos(w * t); }});
  model.loads.push_back({"force", Vector::Constant(1, F), law});
  const double amplitude = F / std::hypot(k - m * w * w, c * w),
               phase = std::atan2(c * w, k - m * w * w);
  for (const auto& integrator : all) {
    Keep samples;
    auto o = options(integrator, 6.0, integrator == "RK4 adaptive" ? 0 : 5e-4, 0.01);
    if (integrator == "RK4 adaptive") o.own.set("Tolerance", 1e-6);
    integrate(model, o, samples);
    for (std::size_t s = 500; s < samples.time.size(); ++s)
      EXPECT_NEAR(samples.q[s][0], amplitude * std::cos(w * samples.time[s] - phase),
                  1e-3 * amplitude)
          << integrator;
  }
}

TEST(LinearMotion, fallingBodyIsExact) {
  auto model = denseModel(scalar(3.0), Matrix(), Matrix());
  model.loads.push_back({"weight", Vector::Constant(1, -3 * 9.81), 0});
  model.initialVelocity[0] = 2.0;
  for (const auto& integrator : all) {
    Keep samples;
    integrate(model, options(integrator, 1.0, integrator == "RK4 adaptive" ? 0 : 0.01, 0.1),
              samples);
    for (std::size_t s = 0; s < samples.time.size(); ++s)
      EXPECT_NEAR(samples.q[s][0],
                  2 * samples.time[s] - 0.5 * 9.81 * samples.time[s] * samples.time[s], 1e-12)
          << integrator;
  }
}

/// A dof with damping alone moves at F / c for every spectral radius, beside an uncoupled mass on a
/// spring; a dof without any term is refused.
TEST(LinearMotion, aDofOfDampingAloneFollowsItsLoad) {
  Matrix M = Matrix::Zero(2, 2), C = M, K = M;
  M(0, 0) = 2.0, K(0, 0) = 800.0, C(1, 1) = 4.0;
  for (double radius : {0.0, 0.5, 0.8, 1.0}) {
    auto model = denseModel(M, C, K);
    model.loads.push_back({"pull", (Vector(2) << 8.0, 10.0).finished(), 0});
    auto o = options("Generalized-alpha", 0.1, 1e-3, 0.01);
    o.own.set("Spectral Radius", radius);
    Keep samples;
    integrate(model, o, samples);
    // v = 2.5 m/s from the first step on; the first one starts from rest
    EXPECT_NEAR(samples.v.back()[1], 2.5, 1e-6) << radius;
    EXPECT_NEAR(samples.q.back()[1], 2.5 * 0.1, 2.5 * 1e-3) << radius;
    EXPECT_NEAR(samples.q.back()[0], 0.01 * (1 - std::cos(20.0 * 0.1)), 1e-6) << radius;
    model.damping.clear();
    try {
      integrate(model, o, samples);
      ADD_FAILURE() << "a load on nothing was accepted";
    } catch (const ModelError& error) {
      EXPECT_NE(std::string(error.what()).find("u of node 2"), std::string::npos) << error.what();
    }
  }
}

}  // namespace LinearMotionTest
}  // namespace tooljoint::transient::testing
