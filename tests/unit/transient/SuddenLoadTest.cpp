// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Loads that jump: anywhere inside a step, for less than a step, and at the start on dofs without
/// mass.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "StatefulModels.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"

namespace tooljoint::transient::testing {
namespace SuddenLoadTest {

constexpr double mass = 2.0, damping = 0.8, stiffness = 50.0, force = 3.0;

/// Displacement and velocity of the oscillator a time t after the load sets in.
std::pair<double, double> stepResponse(double t) {
  if (t <= 0) return {0.0, 0.0};
  const double decay = 0.5 * damping / mass, omega = std::sqrt(stiffness / mass - decay * decay);
  const double fade = std::exp(-decay * t);
  return {
      force / stiffness * (1 - fade * (std::cos(omega * t) + decay / omega * std::sin(omega * t))),
      force / (mass * omega) * fade * std::sin(omega * t)};
}

model::SecondOrderModel pushed(double from) {
  auto model = oscillator(mass, damping, stiffness, 0.0, 0.0);
  const int law =
      model.lawIndex({"push", [from](double t) { return t < from ? 0.0 : 1.0; }, {from}});
  model.loads.push_back({"push", Vector::Constant(1, force), law});
  return model;
}

/// Largest relative error of displacement and velocity. At the end of the step in which the load
/// sets in, the velocity is accurate to first order only.
double errorOf(TransientOptions o, double from, double h) {
  o.step = h;
  Keep samples;
  const auto report = integrate(pushed(from), o, samples);
  EXPECT_LT(std::abs(report.energy.residual()), 2 * h) << o.integrator;
  double worst = 0;
  const double omega = std::sqrt(stiffness / mass), static_ = force / stiffness;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    if (std::abs(samples.time[i] - from) <= h) continue;
    const auto [q, v] = stepResponse(samples.time[i] - from);
    worst = std::max({worst, std::abs(samples.q[i][0] - q) / static_,
                      std::abs(samples.v[i][0] - v) / (static_ * omega)});
  }
  return worst;
}

/// Second order for every time of the jump within the step, its ends included. A load that began at
/// the start of this step or of the next one would be early or late by a part of a step.
TEST(SuddenLoad, isOfSecondOrderWhereverItFalls) {
  const double h = 0.01;
  for (const char* integrator : {"Generalized-alpha", "RK4"})
    for (const double radius : {0.0, 0.8, 1.0})
      for (const double part : {0.0, 0.1, 0.5, 0.75, 0.99}) {
        auto o = options(integrator, 3.0, h, 0.05);
        if (integrator == std::string("Generalized-alpha"))
          o.own.set("Spectral Radius", radius).set("Phase Correction", false);
        // the finer steps have the jump at the same fraction of a step
        const double coarse = errorOf(o, 1.0 + part * h, h),
                     fine = errorOf(o, 1.0 + 0.25 * part * h, 0.25 * h);
        EXPECT_LT(coarse, 0.02 * std::pow(h / 0.02, 2) * 4) << integrator << radius << " " << part;
        EXPECT_GT(coarse, 10 * fine) << integrator << radius << " " << part;
      }
}

/// Nine tenths of a spring break at some time: second order for every time within a step, and the
/// energy of the broken part is booked.
TEST(SuddenLoad, aSpringThatBreaksCountsFromThere) {
  const double omega = std::sqrt(stiffness / mass), left = omega * std::sqrt(0.1), q0 = 0.2;
  const auto errorOfBreak = [&](const char* integrator, double from, double h) {
    auto model = denseModel(scalar(mass), Matrix(), Matrix());
    const int law =
        model.lawIndex({"break", [from](double t) { return t < from ? 1.0 : 0.1; }, {from}});
    model.stiffness.push_back({"spring", scalar(stiffness).sparseView(), law});
    model.initialDisplacement[0] = q0;
    auto o = options(integrator, 3.0, h, 0.05);
    if (integrator == std::string("Generalized-alpha"))
      o.own.set("Spectral Radius", 1.0).set("Phase Correction", false);
    acceptCoarseSteps(o);
    Keep samples;
    const auto report = integrate(model, o, samples);
    EXPECT_LT(std::abs(report.energy.residual()), h) << integrator << from;
    const double q1 = q0 * std::cos(omega * from), v1 = -q0 * omega * std::sin(omega * from);
    double worst = 0;
    for (std::size_t i = 0; i < samples.time.size(); ++i) {
      const double t = samples.time[i], after = t - from;
      const double q = after < 0 ? q0 * std::cos(omega * t)
                                 : q1 * std::cos(left * after) + v1 / left * std::sin(left * after);
      worst = std::max(worst, std::abs(samples.q[i][0] - q) / q0);
    }
    return worst;
  };
  const double h = 0.01;
  for (const char* integrator : {"Generalized-alpha", "RK4"})
    for (const double part : {0.0, 0.1, 0.5, 0.99}) {
      const double coarse = errorOfBreak(integrator, 1.0 + part * h, h),
                   fine = errorOfBreak(integrator, 1.0 + 0.25 * part * h, 0.25 * h);
      EXPECT_LT(coarse, 0.01) << integrator << part;
      EXPECT_GT(coarse, 8 * fine) << integrator << part;
    }
}

/// A heavy mass in motion: a load that sets in late in a step works only in the rest of the step.
TEST(SuddenLoad, worksFromWhenItComes) {
  const double heavy = 1e6, speed = 2.0, end = 2.0;
  for (const char* integrator : {"Generalized-alpha", "RK4"})
    for (const double from : {1.0, 1.0009, 1.0001}) {
      auto model = denseModel(scalar(heavy), Matrix(), Matrix());
      model.initialVelocity[0] = speed;
      const int law =
          model.lawIndex({"push", [from](double t) { return t < from ? 0.0 : 1.0; }, {from}});
      model.loads.push_back({"push", Vector::Constant(1, force), law});
      Keep samples;
      const auto report = integrate(model, options(integrator, end, 1e-3, 0.1), samples);
      const double t = end - from, work = force * (speed * t + 0.5 * force / heavy * t * t);
      EXPECT_NEAR(report.energy.loads, work, 1e-6 * work) << integrator << from;
    }
}

/// A pulse shorter than a step, within a step or across the end of one, gives its full impulse at
/// the end of a step: the motion is late or early by up to a step, a relative error of h omega =
/// 0.025.
TEST(SuddenLoad, aPulseShorterThanAStepGivesItsImpulse) {
  for (const char* integrator : {"Generalized-alpha", "RK4"})
    for (const auto& [from, to] : {std::pair{0.5013, 0.5016}, {0.4988, 0.5012}}) {
      auto model = oscillator(mass, damping, stiffness, 0.0, 0.0);
      const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
      const int law = model.lawIndex(
          {"kick",
           [=](double t) { return std::max(0.0, 1 - std::abs(t - middle) / half) / half; },
           {from, middle, to}});
      model.loads.push_back({"kick", Vector::Ones(1), law});
      Keep samples;
      auto o = options(integrator, 1.5, 5e-3, 0.05);
      acceptCoarseSteps(o);
      integrate(model, o, samples);
      const double size = 1 / std::sqrt(mass * stiffness);
      for (std::size_t i = 11; i < samples.time.size(); ++i)
        EXPECT_NEAR(samples.q[i][0] / size,
                    stepResponse(samples.time[i] - middle).second / force / size, 0.025)
            << integrator << from;
    }
}

/// A stiff spring and dashpot act all the time and are no wall: steps and motion are the same as
/// with these terms in the matrices.
TEST(SuddenLoad, aSpringIsNoWall) {
  for (const double k : {2e5, 2e7}) {
    const double c = 0.02 * std::sqrt(k), speed = 1.0;
    const auto pushedOn = [speed](model::SecondOrderModel model) {
      model.loads.push_back({"push", Vector::Unit(2, 0) * force, 0});
      model.initialVelocity[1] = speed;
      return model;
    };
    Matrix K(2, 2), own = Matrix::Zero(2, 2), damper = Matrix::Zero(2, 2);
    K << 50, -50, -50, 90;
    own(1, 1) = k, damper(1, 1) = c;
    const Matrix M = mass * Matrix::Identity(2, 2);
    auto sprung = pushedOn(denseModel(M, Matrix(), K));
    Teuchos::ParameterList list;
    list.set("Stiffness", k).set("Cubic Stiffness", 0.0).set("Damping", c);
    addLaw(sprung, "Spring", list);
    sprung.points.back().rows = Matrix(own / k).sparseView();
    Keep samples, expected;
    auto o = options("Generalized-alpha", 2.0, 1e-3, 0.05);
    acceptCoarseSteps(o);
    const auto report = integrate(sprung, o, samples);
    integrate(pushedOn(denseModel(M, damper, K + own)), o, expected);
    EXPECT_EQ(report.counters.steps, 2000) << k;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      EXPECT_LT((samples.q[i] - expected.q[i]).norm(), 1e-4 * force / 50) << k << " " << i;
  }
}

/// A mass m is loaded through a spring to a dof without mass. The massless dof starts in
/// equilibrium of spring and load, the motion is that of the mass under the load itself, and no
/// energy is lost.
TEST(SuddenLoad, aDofWithoutMassStartsInBalance) {
  const double k = 80.0, q0 = 0.01, v0 = 0.3;
  Matrix M = Matrix::Zero(2, 2), K(2, 2);
  M(0, 0) = mass;
  K << stiffness + k, -k, -k, k;
  auto model = denseModel(M, Matrix(), K);
  model.loads.push_back({"push", Vector::Unit(2, 1) * force, 0});
  model.initialDisplacement[0] = q0;
  model.initialVelocity[0] = v0;
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 2.0, 2e-3, 0.1), samples);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-4);
  const double omega = std::sqrt(stiffness / mass), rest = force / stiffness;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const double t = samples.time[i];
    const double q = rest + (q0 - rest) * std::cos(omega * t) + v0 / omega * std::sin(omega * t);
    const double v = (rest - q0) * omega * std::sin(omega * t) + v0 * std::cos(omega * t);
    EXPECT_NEAR(samples.q[i][0], q, 2e-4 * rest);
    EXPECT_NEAR(samples.q[i][1], q + force / k, 2e-4 * rest);
    EXPECT_NEAR(samples.v[i][1], v, i == 0 ? 1e-12 : 1e-3 * omega * rest);
  }
}

/// With a damper beside its spring the dof keeps the given start and creeps.
TEST(SuddenLoad, aDampedDofWithoutMassKeepsItsStart) {
  const double k = 80.0, c = 4.0, q1 = 0.05;
  Matrix M = Matrix::Zero(2, 2), C = Matrix::Zero(2, 2), K(2, 2);
  M(0, 0) = mass;
  C(1, 1) = c;
  K << 1e9 + k, -k, -k, k;
  auto model = denseModel(M, C, K);
  model.initialDisplacement[1] = q1;
  Keep samples;
  auto o = options("Generalized-alpha", 0.2, 1e-4, 0.01);
  acceptCoarseSteps(o);
  integrate(model, o, samples);
  for (std::size_t i = 0; i < samples.time.size(); ++i)
    EXPECT_NEAR(samples.q[i][1], q1 * std::exp(-k / c * samples.time[i]), 2e-3 * q1);
}

/// A law without known corners, such as a user's law: steps of variable length follow a pulse, warn
/// of it or refuse it, but never miss it silently. J/(m omega) exp().
TEST(SuddenLoad, aPulseWithoutCornersIsNotLost) {
  for (const double length : {2e-4, 1e-3, 3e-3, 0.02}) {
    auto model = oscillator(mass, 0.0, stiffness, 0.0, 0.0);
    const double from = 0.4013;
    const int law = model.lawIndex(
        {"pulse", [=](double t) { return t >= from && t <= from + length ? 1.0 : 0.0; }});
    model.loads.push_back({"push", Vector::Constant(1, force / length), law});
    const double exact = force / std::sqrt(mass * stiffness);
    for (const char* integrator : {"RK4 adaptive", "SUNDIALS ARKODE", "SUNDIALS CVODE"}) {
      auto o = options(integrator, 2.0, 0, 5e-3);
      o.ledger = false;  // it would detect some of it, too
      Keep samples;
      const auto before = log::warnings().size();
      try {
        integrate(model, o, samples);
      } catch (const Error&) {
        continue;  // refused, or built without SUNDIALS
      }
      double largest = 0;
      for (const auto& q : samples.q) largest = std::max(largest, std::abs(q[0]));
      if (log::warnings().size() == before)
        EXPECT_NEAR(largest / exact, 1.0, 0.05) << integrator << ", " << length;
      else
        EXPECT_GT(largest, 0.5 * exact) << integrator << ", " << length;
    }
  }
}

}  // namespace SuddenLoadTest
}  // namespace tooljoint::transient::testing
