// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Starts of motions without mass: each is that of a mass of 1 kg on 100 N/m and, beyond a massless
/// node, on two springs of 100 N/m in series; q1 = 0.1 cos(sqrt(150) t), q2 = q1/2.
#include <gtest/gtest.h>

#include "StatefulModels.hpp"
#include "common/report/Log.hpp"
#include "model/laws/Connectors.hpp"

namespace tooljoint::transient::testing {
namespace MasslessStartTest {

constexpr double start = 0.1, omega2 = 150.0;

/// The mass starts at 0.1 m, the node out of equilibrium at 0. \param own spring of the node [N/m]
model::SecondOrderModel massAndNode(double own = 100.0) {
  Matrix M = Matrix::Zero(2, 2), K(2, 2);
  M(0, 0) = 1;
  K << 200, -100, -100, 100 + own;
  auto model = denseModel(M, Matrix(), K);
  model.initialDisplacement[0] = start;
  return model;
}

model::PointSet onNode(int size, int position, std::shared_ptr<const model::PointLaw> law) {
  model::PointSet set;
  set.name = "law";
  set.law = std::move(law);
  set.rows.resize(1, size);
  set.rows.insert(0, position) = 1.0;
  set.offset = Vector::Zero(1);
  set.entities = {2};
  return set;
}

/// q1 and q2 of the samples; `rows` computes them from the dofs.
void expectMotion(const model::SecondOrderModel& model, const Matrix& rows) {
  log::clearWarnings();
  for (const double radius : {0.3, 0.8, 1.0})
    for (const double step : {1e-3, 1e-4}) {
      auto o = options("Generalized-alpha", 1.0, step, 0.02);
      o.own.set("Spectral Radius", radius);
      Keep samples;
      integrate(model, o, samples);
      for (std::size_t i = 0; i < samples.q.size(); ++i) {
        const double t = samples.time[i], omega = std::sqrt(omega2);
        const Vector q = rows * samples.q[i], v = rows * samples.v[i];
        const double bound = 300.0 * step * step * start + 1e-9;
        EXPECT_NEAR(q[0], start * std::cos(omega * t), bound) << radius << " " << step;
        EXPECT_NEAR(q[1], 0.5 * q[0], bound) << radius << " " << step;
        EXPECT_NEAR(v[1], -0.5 * start * omega * std::sin(omega * t), 10 * omega * bound)
            << radius << " " << step << " " << t;
      }
    }
  EXPECT_TRUE(log::warnings().empty()) << log::warnings().front();
}

/// A stop that the node never reaches.
TEST(MasslessStart, BesideAnOpenStop) {
  auto model = massAndNode();
  Teuchos::ParameterList stop;
  stop.set("Stiffness", 1e6).set("Gap", 1.0);
  model.points.push_back(
      onNode(2, 1, model::PointLawRegistry::instance().make("Stop", stop, {1, 1})));
  expectMotion(model, Matrix::Identity(2, 2));
}

/// Half of the spring of the node is a point law.
TEST(MasslessStart, WithTheForceOfALaw) {
  auto model = massAndNode(50.0);
  model.points.push_back(onNode(2, 1, model::springs({{50.0, 0.0, 0.0}})));
  expectMotion(model, Matrix::Identity(2, 2));
}

/// Rotated dofs: each has mass.
TEST(MasslessStart, WhereNoDofAloneIsWithoutMass) {
  Matrix M = Matrix::Zero(2, 2), K(2, 2), T(2, 2);
  M(0, 0) = 1;
  K << 200, -100, -100, 200;
  T << 0.8, 0.6, -0.6, 0.8;  // q = T x
  auto model = denseModel(T.transpose() * M * T, Matrix(), T.transpose() * K * T);
  model.initialDisplacement = T.transpose() * Vector::Unit(2, 0) * start;
  expectMotion(model, T);
}

/// With a damper to the ground the node has its own state, x' = (100 q1 - 200 x) / c, and starts at
/// the given displacement with this rate. Errors are of second order in the step.
TEST(MasslessStart, OfADampedNodeHasItsRate) {
  const Matrix T = (Matrix(2, 2) << 0.8, 0.6, -0.6, 0.8).finished();  // q = T x
  for (const bool turned : {false, true})
    for (const double c : {40.0, 4.0}) {
      Matrix C = Matrix::Zero(2, 2), A(3, 3);  // of q1, its velocity, q2
      C(1, 1) = c;
      A << 0, 1, 0, -200, 0, 100, 100 / c, 0, -200 / c;
      auto model = massAndNode();
      Matrix M = model.mass, K = model.stiffnessAt(0);
      const Matrix rows = turned ? T : Matrix::Identity(2, 2);
      model = denseModel(rows.transpose() * M * rows, rows.transpose() * C * rows,
                         rows.transpose() * K * rows);
      model.initialDisplacement = rows.transpose() * Vector::Unit(2, 0) * start;
      log::clearWarnings();
      Keep samples;
      integrate(model, options("Generalized-alpha", 0.1, 1e-3, 0.02), samples);
      EXPECT_TRUE(log::warnings().empty()) << log::warnings().front();
      const Vector q = rows * samples.q[0], v = rows * samples.v[0];
      EXPECT_NEAR(q[0], start, 1e-9);
      EXPECT_NEAR(q[1], 0.0, 1e-9);
      EXPECT_NEAR(v[1], 100 * start / (c + 200 * 1e-3), 1e-5);
      const int fine = 200;  // steps of RK4 between samples
      const Matrix h = 0.02 / fine * A, h2 = h * h,
                   step = Matrix::Identity(3, 3) + h + h2 / 2 + h2 * h / 6 + h2 * h2 / 24;
      Vector state = Vector::Unit(3, 0) * start;
      for (std::size_t i = 1; i < samples.q.size(); ++i) {
        for (int k = 0; k < fine; ++k) state = step * state;
        EXPECT_NEAR((rows * samples.q[i])[0], state[0], 6e-4 * start) << turned << " " << c;
        EXPECT_NEAR((rows * samples.q[i])[1], state[2], 6e-4 * start) << turned << " " << c;
      }
    }
}

}  // namespace MasslessStartTest
}  // namespace tooljoint::transient::testing
