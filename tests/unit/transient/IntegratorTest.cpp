// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Every integrator against closed forms, its order of convergence, and the effect of each
/// parameter.
#include <gtest/gtest.h>

#include "Models.hpp"
#include "StatefulModels.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "tests/support/ErrorText.hpp"

namespace tooljoint::transient::testing {
namespace IntegratorTest {

/// Largest error of the samples of a damped free vibration with step h: m 2, zeta 0.05, omega 10.
double freeVibrationError(const std::string& integrator, double h,
                          const Teuchos::ParameterList& own = {}) {
  const double m = 2, omega = 10, zeta = 0.05;
  const auto model = oscillator(m, 2 * zeta * omega * m, omega * omega * m, 0.3, -1.0);
  Keep samples;
  auto o = options(integrator, 1.0, h, 0.25);
  o.own = own;
  integrate(model, o, samples);
  const double wd = omega * std::sqrt(1 - zeta * zeta);
  double error = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const double t = samples.time[i];
    const double exact =
        std::exp(-zeta * omega * t) *
        (0.3 * std::cos(wd * t) + (-1.0 + zeta * omega * 0.3) / wd * std::sin(wd * t));
    error = std::max(error, std::abs(samples.q[i][0] - exact));
  }
  EXPECT_EQ(samples.time.size(), 5u);
  return error;
}

TransientReport runFor(const model::SecondOrderModel& model, const std::string& integrator,
                       double end, double step, const Teuchos::ParameterList& own = {}) {
  Keep samples;
  auto o = options(integrator, end, step, end / 10);
  o.own = own;
  o.ledger = false;
  acceptCoarseSteps(o);  // the test counts steps, also inaccurate ones
  return integrate(model, o, samples);
}

template <class T>
Teuchos::ParameterList with(const std::string& name, T value) {
  Teuchos::ParameterList list;
  list.set(name, value);
  return list;
}

// Order of convergence
// -------------------------------------------------------------------------------------------------

TEST(Integrators, fixedRungeKuttaIsOfFourthOrder) {
  const double coarse = freeVibrationError("RK4", 0.01);
  const double fine = freeVibrationError("RK4", 0.005);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.15);
  EXPECT_LT(fine, 1e-6);
}

TEST(Integrators, generalizedAlphaIsOfSecondOrderAtEverySpectralRadius) {
  for (double radius : {0.0, 0.5, 0.8, 1.0}) {
    const auto own = with("Spectral Radius", radius);
    const double coarse = freeVibrationError("Generalized-alpha", 0.002, own);
    const double fine = freeVibrationError("Generalized-alpha", 0.001, own);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.06) << "spectral radius " << radius;
    EXPECT_LT(fine, 1e-3);
  }
}

TEST(Integrators, phaseCorrectionFollowsVibrationToFourthOrder) {
  // Undamped, so that only the period error remains; the damping of spectral radii below 1 is of
  // third order.
  const auto error = [](double h, double radius, bool corrected) {
    // The start is at rest: the velocity for a given amplitude has an error of second order, the
    // same at every time.
    const auto model = oscillator(2, 0, 200, 0.3, 0.0);
    Keep samples;
    auto o = options("Generalized-alpha", 5.0, h, 1.0);
    o.own = with("Spectral Radius", radius);
    o.own.set("Phase Correction", corrected);
    integrate(model, o, samples);
    double worst = 0;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      worst = std::max(worst, std::abs(samples.q[i][0] - 0.3 * std::cos(10 * samples.time[i])));
    return worst;
  };
  EXPECT_GT(std::log2(error(0.01, 1.0, true) / error(0.005, 1.0, true)), 3.3);
  for (double radius : {0.8, 1.0})
    EXPECT_LT(error(0.01, radius, true), 0.02 * error(0.01, radius, false)) << radius;
  EXPECT_LT(error(0.01, 0.0, true), 0.2 * error(0.01, 0.0, false));  // its own damping is left
}

/// Frequencies of 0.03 to 60 radians per step, undamped, for thousands of steps: nothing grows.
TEST(Integrators, phaseCorrectionIsUnconditionallyStable) {
  for (double radius : {0.0, 0.5, 0.8, 1.0}) {
    Matrix K = Matrix::Zero(40, 40);
    Vector start(40);
    for (int i = 0; i < 40; ++i) {
      K(i, i) = 1e6 * std::pow(10.0, 2 * (-1.5 + 3.3 * i / 39));
      start[i] = 1 / std::sqrt(K(i, i));  // equal energies
    }
    auto model = denseModel(Matrix::Identity(40, 40), Matrix(), K);
    model.initialDisplacement = start;
    Keep samples;
    auto o = options("Generalized-alpha", 4.0, 1e-3, 0.5);
    o.own = with("Spectral Radius", radius);
    acceptCoarseSteps(o);
    o.ledger = false;
    integrate(model, o, samples);
    for (int i = 0; i < 40; ++i)
      for (const auto& q : samples.q)
        ASSERT_LT(std::abs(q[i]), 2.5 * start[i]) << radius << " " << i;
  }
}

TEST(Integrators, adaptiveRungeKuttaFollowsItsTolerance) {
  double last = 1;
  for (double tolerance : {1e-4, 1e-6, 1e-8}) {
    auto own = with("Tolerance", tolerance);
    own.set("Growth", 1.2);  // the growth of the source would show only after a thousand steps
    const double error = freeVibrationError("RK4 adaptive", 0, own);
    EXPECT_LT(error, last / 5) << "tolerance " << tolerance;
    last = error;
  }
  EXPECT_LT(last, 1e-6);
}

/// q = sin(3 t) made to solve m q'' + (c + t^2 d) q' + (k + cos(t) e) q = F(t): it contains every
/// law of time.
model::SecondOrderModel manufactured() {
  auto model = oscillator(2.0, 0.5, 30.0, 0.0, 3.0);
  const int square = model.lawIndex({"t^2", [](double t) { return t * t; }});
  const int cosine = model.lawIndex({"cos t", [](double t) { return std::cos(t); }});
  const int load = model.lawIndex({"load", [](double t) {
                                     return -18.0 * std::sin(3 * t) +
                                            (0.5 + 1.5 * t * t) * 3 * std::cos(3 * t) +
                                            (30.0 + 12.0 * std::cos(t)) * std::sin(3 * t);
                                   }});
  model.damping.push_back({"growing", scalar(1.5).sparseView(), square});
  model.stiffness.push_back({"breathing", scalar(12.0).sparseView(), cosine});
  model.loads.push_back({"load", Vector::Constant(1, 1.0), load});
  return model;
}

double manufacturedError(const std::string& integrator, double h) {
  const auto model = manufactured();
  Keep samples;
  auto o = options(integrator, 2.0, h, 0.1);
  if (integrator == "Generalized-alpha") o.own.set("Phase Correction", false);
  integrate(model, o, samples);
  double error = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    error = std::max(error, std::abs(samples.q[i][0] - std::sin(3 * samples.time[i])));
    error = std::max(error, std::abs(samples.v[i][0] - 3 * std::cos(3 * samples.time[i])));
  }
  return error;
}

TEST(Integrators, keepTheirOrderWhenMatricesAndLoadsChangeWithTime) {
  EXPECT_NEAR(std::log2(manufacturedError("RK4", 0.02) / manufacturedError("RK4", 0.01)), 4.0, 0.2);
  EXPECT_NEAR(std::log2(manufacturedError("Generalized-alpha", 0.004) /
                        manufacturedError("Generalized-alpha", 0.002)),
              2.0, 0.1);
  EXPECT_LT(manufacturedError("RK4", 0.01), 1e-6);
  EXPECT_LT(manufacturedError("Generalized-alpha", 0.002), 1e-4);
}

TEST(Integrators, accelerationBalancesTheForces) {
  const auto model = manufactured();
  for (const char* integrator : {"RK4", "RK4 adaptive", "Generalized-alpha"}) {
    Keep samples;
    integrate(model, options(integrator, 1.0, 0.002, 0.1), samples);
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      EXPECT_NEAR(samples.a[i][0], -9 * std::sin(3 * samples.time[i]), 1e-2)
          << integrator << " at " << samples.time[i];
  }
}

// A ball on a spring-damper floor: second order through impacts, on the mean of many
// --------------------------------------------------

double impactError(double h, double lambda, double damping) {
  const auto model = droppedBalls(12, 1e6, damping, lambda);
  Keep reference, samples;
  auto fine = options("RK4", 0.1, 1e-6, 0.005);
  fine.ledger = false;
  integrate(model, fine, reference);
  auto steps = options("Generalized-alpha", 0.1, h, 0.005);
  steps.own.set("Resolve Impacts", false);  // the order of steps of one length
  integrate(model, steps, samples);
  double error = 0;
  for (std::size_t i = 0; i < samples.q.size(); ++i)
    error += (samples.q[i] - reference.q[i]).squaredNorm();
  return std::sqrt(error);
}

TEST(Integrators, generalizedAlphaIsOfSecondOrderThroughARegularisedStop) {
  const double coarse = impactError(2e-4, 3e4, 300);
  const double fine = impactError(5e-5, 3e4, 300);
  EXPECT_GT(0.5 * std::log2(coarse / fine), 1.6);
  EXPECT_LT(fine, 1e-5);
}

TEST(Integrators, generalizedAlphaIsOfSecondOrderThroughASharpElasticStop) {
  const double coarse = impactError(4e-4, 7e11, 0);
  const double fine = impactError(2.5e-5, 7e11, 0);
  EXPECT_GT(0.25 * std::log2(coarse / fine), 1.6);
}

/// Damping that sets in at once makes the force jump. The time of the jump within the step is not
/// resolved, which causes an error of the impulse proportional to the step.
TEST(Integrators, generalizedAlphaIsOfFirstOrderWhereTheForceJumps) {
  const double coarse = impactError(4e-4, 7e11, 300);
  const double fine = impactError(2.5e-5, 7e11, 300);
  EXPECT_GT(0.25 * std::log2(coarse / fine), 0.8);
}

/// Steps of RK4 adaptive end at corners of laws: a step from rest does not skip a pulse.
TEST(Integrators, adaptiveStepsOfRungeKuttaEndAtCorners) {
  auto model = oscillator(1.0, 0.0, 0.01, 0.0, 0.0);
  const auto pulse = [](double t) {
    return std::max(0.0, 500 * (1 - std::abs(t - 8.002) / 0.002));
  };
  model.loads.push_back(
      {"kick", Vector::Ones(1), model.lawIndex({"kick", pulse, {8.0, 8.002, 8.004}})});
  Keep samples;
  integrate(model, options("RK4 adaptive", 9.0, 0, 3.0), samples);
  EXPECT_NEAR(samples.v.back()[0], std::cos(0.1), 1e-3);
}

// Parameters
// -------------------------------------------------------------------------------------------------

TEST(Integrators, spectralRadiusDampsOnlyHighFrequencies) {
  // Step 0.01 s: 1e4 rad/s is far above it, 10 rad/s far below.
  const auto amplitude = [](double radius, double omega) {
    Keep samples;
    auto o = options("Generalized-alpha", 0.5, 0.01, 0.01);
    o.own = with("Spectral Radius", radius);
    o.own.set("Phase Correction", false);  // it changes the inertia of such frequencies
    o.ledger = false;                      // the damping would end the run
    acceptCoarseSteps(o);
    integrate(oscillator(1, 0, omega * omega, 1.0, 0), o, samples);
    double largest = 0;
    for (std::size_t i = samples.q.size() - 20; i < samples.q.size(); ++i)
      largest = std::max(largest, std::hypot(samples.q[i][0], samples.v[i][0] / omega));
    return largest;
  };
  EXPECT_GT(amplitude(1.0, 1e4), 0.9);
  EXPECT_LT(amplitude(0.8, 1e4), 0.05);
  EXPECT_LT(amplitude(0.2, 1e4), 1e-6);
  for (double radius : {0.2, 0.8, 1.0}) EXPECT_GT(amplitude(radius, 10), 0.85) << radius;
}

TEST(Integrators, tighterNewtonToleranceCostsIterationsAndBuysAccuracy) {
  // A strongly nonlinear law: a floor regularised over a tenth of its penetration.
  const auto model = droppedBalls(3, 1e6, 300, 1e4);
  const auto end = [&](double tolerance, long& iterations) {
    Keep samples;
    auto o = options("Generalized-alpha", 0.1, 2e-4, 0.1);
    o.own = with("Tolerance", tolerance);
    o.own.set("Phase Correction", false);  // it takes an iteration at any tolerance
    iterations = integrate(model, o, samples).counters.newtonIterations;
    return samples.q.back();
  };
  long loose, tight, exact;
  const Vector atLoose = end(1e-2, loose), atTight = end(1e-6, tight), atExact = end(1e-12, exact);
  EXPECT_LT(loose, tight);
  EXPECT_LT(tight, exact);
  EXPECT_LT((atTight - atExact).norm(), 0.01 * (atLoose - atExact).norm());
}

TEST(Integrators, fewIterationsLeadToHalving) {
  const auto model = droppedBalls(10, 1e7, 1e4, 7e11, 2e5);
  auto own = with("Resolve Impacts", false);
  const auto full = runFor(model, "Generalized-alpha", 0.2, 1e-3, own);
  own.set("Max Iterations", 2);
  own.set("Max Halvings", 12);
  const auto few = runFor(model, "Generalized-alpha", 0.2, 1e-3, own);
  EXPECT_GT(few.counters.halved, full.counters.halved);
  EXPECT_GT(few.counters.steps, full.counters.steps);
  EXPECT_LT(few.counters.minStep, full.counters.minStep);
  EXPECT_EQ(few.counters.unconvergedSteps, 0);
}

TEST(Integrators, withoutHalvingsAFailedStepEndsTheRunWithAdvice) {
  const auto model = droppedBalls(10, 1e7, 1e4, 7e11, 2e5);
  auto own = with("Max Iterations", 1);
  own.set("Max Halvings", 0);
  own.set("Resolve Impacts", false);
  try {
    runFor(model, "Generalized-alpha", 0.2, 1e-3, own);
    FAIL() << "a run that did not converge ended as if it had";
  } catch (const ConvergenceError& error) {
    const std::string text = error.what();
    EXPECT_EQ(error.code(), ExitCode::NotConverged);
    EXPECT_NE(text.find("Newton did not converge in the step from t = 0.0"), std::string::npos)
        << text;
    EXPECT_NE(text.find("u of node "), std::string::npos) << text;
    EXPECT_NE(text.find("Reduce Transient/Step"), std::string::npos) << text;
  }
}

TEST(Integrators, unconvergedStepsAreKeptOnlyOnRequestAndCounted) {
  const auto model = droppedBalls(10, 1e7, 1e4, 7e11, 2e5);
  auto own = with("Max Iterations", 1);
  own.set("Max Halvings", 0);
  own.set("Accept Unconverged", true);
  own.set("Resolve Impacts", false);
  const auto report = runFor(model, "Generalized-alpha", 0.2, 1e-3, own);
  EXPECT_GT(report.counters.unconvergedSteps, 0);
  EXPECT_EQ(report.counters.steps, 200);
}

TEST(Integrators, defaultRungeKuttaStepIsBoundedByTheLargestFrequency) {
  const int n = 40;
  const double k = 3e5, m = 2.0;
  const auto model = springChain(n, m, 0.0, k);
  const double omega = 2 * std::sqrt(k / m) * std::sin(constants::pi * n / (2.0 * (n + 1)));
  auto report = runFor(model, "RK4", 1.0, 0);
  const double limit = 2.78 / omega;
  EXPECT_LE(report.counters.maxStep, 0.9 * limit * (1 + 1e-9));
  EXPECT_GT(report.counters.maxStep, 0.8 * limit);
  report = runFor(model, "RK4", 1.0, 0, with("Safety", 0.3));
  EXPECT_LE(report.counters.maxStep, 0.3 * limit * (1 + 1e-9));
  EXPECT_GT(report.counters.maxStep, 0.25 * limit);
}

/// A wall bounds the step of points in contact and of points that may touch: 1e6 N/m on 1 kg gives
/// 1000 rad/s, and an impact half a radian per step. Without a wall the sampling interval bounds
/// the step.
TEST(Integrators, theStepOfRungeKuttaKnowsContactThatIsOpenAtFirst) {
  auto model = oscillator(1.0, 0, 100.0, -0.001, 0);
  const auto without = runFor(model, "RK4", 0.1, 0);
  addFloor(model, 1e6, 0, 1e6);
  const auto touching = runFor(model, "RK4", 0.1, 0);
  model.initialDisplacement[0] = 0.1;
  const auto apart = runFor(model, "RK4", 0.1, 0);
  EXPECT_LE(touching.counters.maxStep, 0.9 * 0.5 / 1e3);
  EXPECT_GT(touching.counters.maxStep, 0.85 * 0.5 / 1e3);
  EXPECT_NEAR(apart.counters.maxStep, touching.counters.maxStep, 0.02 * apart.counters.maxStep);
  EXPECT_NEAR(without.counters.maxStep, 0.01, 1e-12);
}

/// A mass thrown at a wall of 3e9 N/m rebounds with its energy.
TEST(Integrators, theDefaultStepOfRungeKuttaResolvesAStiffWall) {
  auto model = oscillator(3.0, 0, 100.0, 0.02, -1.0);
  addFloor(model, 3e9, 0, 7e11);
  const auto report = runFor(model, "RK4", 0.2, 0);
  EXPECT_LT(std::abs(report.energy.residual()), 0.02);
}

/// Gyroscopic terms G of a speed that rises from rest to 1: (lambda^2 + k)^2 + (G lambda)^2 = 0
/// has lambda = i (G/2 + sqrt(G^2/4 + k)) at full speed, 500 times the frequency at rest. They do
/// no work.
TEST(Integrators, theDefaultStepOfRungeKuttaKnowsGyroscopicTerms) {
  const double k = 100.0, gyroscopic = 5000.0;
  Matrix K = k * Matrix::Identity(2, 2), G = Matrix::Zero(2, 2);
  G(0, 1) = -gyroscopic, G(1, 0) = gyroscopic;
  auto model = denseModel(Matrix::Identity(2, 2), Matrix(), K, 2);
  model.damping.push_back(
      {"gyroscopic", G.sparseView(), model.lawIndex({"speed", [](double t) { return t; }})});
  model.initialDisplacement << 0.01, 0.0;
  const auto report = runFor(model, "RK4", 1.0, 0);
  const double largest = 0.5 * gyroscopic + std::sqrt(0.25 * gyroscopic * gyroscopic + k);
  EXPECT_LE(report.counters.maxStep, 0.9 * 2.78 / largest);
  EXPECT_GT(report.counters.maxStep, 0.8 * 2.78 / largest);
  EXPECT_LT(std::abs(report.energy.residual()), 0.02);
}

/// Skew stiffness s fifteen times the symmetric one k, held by damping c (stable for s < c
/// sqrt(k)): lambda^2 + c lambda + k +- i s = 0.
TEST(Integrators, theDefaultStepOfRungeKuttaKnowsSkewStiffness) {
  const double k = 100.0, c = 200.0, s = 1500.0;
  Matrix K = k * Matrix::Identity(2, 2);
  K(0, 1) = s, K(1, 0) = -s;
  auto model = denseModel(Matrix::Identity(2, 2), c * Matrix::Identity(2, 2), K, 2);
  model.initialDisplacement << 0.01, 0.0;
  const auto report = runFor(model, "RK4", 1.0, 0);
  const double bound = 0.5 * c + std::sqrt(0.25 * c * c + std::hypot(k, s));
  EXPECT_LE(report.counters.maxStep, 0.9 * 2.78 / bound);
  EXPECT_GT(report.counters.maxStep, 0.8 * 2.78 / bound);
  EXPECT_LT(std::abs(report.energy.residual()), 0.02);
}

/// Dry friction of 1 N, fully developed at 1 mm/s, damps 1 kg with 1500 1/s when it sticks, but not
/// at the start, so that the sampling interval is the default step.
TEST(Integrators, RungeKuttaWarnsOfStepsTooLongForALawThatSticks) {
  auto model = oscillator(1.0, 0, 10.0, 0, 1.0);
  Teuchos::ParameterList own;
  own.set("Static Force", 1.0).set("Dynamic Force", 1.0).set("Decay Velocity", 1.0);
  own.set("Viscous Damping", 0.0).set("Slip Velocity", 1e-3);
  addLaw(model, "Stribeck", own);
  const auto said = [&model](double step) {
    log::clearWarnings();
    Keep samples;
    integrate(model, options("RK4", 3.0, step, 0.01), samples);
    return log::warnings().empty() ? std::string() : log::warnings().back();
  };
  EXPECT_NE(said(0).find("too large for RK4"), std::string::npos) << said(0);
  EXPECT_EQ(said(1e-3), "");
}

/// A dashpot that relaxes in 10 us behind its spring: its state bounds the step, not the frequency
/// of 20 1/s of the mass.
TEST(Integrators, theDefaultStepOfRungeKuttaKnowsRatesOfStates) {
  MaxwellMass mass;
  mass.c = 1e-5 * mass.k;
  Keep samples;
  const auto report = integrate(mass.model(), options("RK4", 1.0, 0, 0.1), samples);
  const double relaxation = mass.k / mass.c;
  EXPECT_LE(report.counters.maxStep, 0.9 * 2.78 / relaxation);
  EXPECT_GT(report.counters.maxStep, 0.8 * 2.78 / relaxation);
  EXPECT_LT(largestError(samples, mass), 1e-9);
}

TEST(Integrators, explicitOnesRefuseADofWithoutMass) {
  auto model = springChain(3, 1.0, 0.0, 10.0);
  model.mass.coeffRef(1, 1) = 0.0;
  for (const char* integrator : {"RK4", "RK4 adaptive"}) {
    const auto text = errorText([&] { runFor(model, integrator, 1.0, 1e-3); });
    EXPECT_NE(text.find("u of node 2"), std::string::npos) << text;
    EXPECT_NE(text.find("Generalized-alpha"), std::string::npos) << text;
  }
}

TEST(Integrators, generalizedAlphaTakesDofsWithoutMass) {
  // A massless node between two springs: q2 = q1/2 at all times, and q1 swings on k + k/2.
  Matrix M = Matrix::Zero(2, 2), K(2, 2);
  M(0, 0) = 1;
  K << 200, -100, -100, 200;
  auto model = denseModel(M, Matrix(), K);
  model.initialDisplacement << 0.1, 0.05;
  Keep samples;
  integrate(model, options("Generalized-alpha", 1.0, 1e-3, 0.1), samples);
  for (std::size_t i = 0; i < samples.q.size(); ++i) {
    EXPECT_NEAR(samples.q[i][1], 0.5 * samples.q[i][0], 1e-9);
    EXPECT_NEAR(samples.q[i][0], 0.1 * std::cos(std::sqrt(150.0) * samples.time[i]), 2e-4);
  }
}

TEST(Integrators, adaptiveStepGrowsShrinksAndStartsAsAsked) {
  const auto model = oscillator(1, 0, 1e4, 1e-3, 0);
  const auto usual = runFor(model, "RK4 adaptive", 0.2, 0);
  EXPECT_NEAR(usual.counters.minStep, 1e-5, 1e-12);
  EXPECT_GT(usual.counters.maxStep, 1e-3);
  const auto fast = runFor(model, "RK4 adaptive", 0.2, 0, with("Growth", 1.5));
  EXPECT_LT(fast.counters.steps, usual.counters.steps / 3);
  const auto still = runFor(model, "RK4 adaptive", 0.02, 0, with("Growth", 1.0));
  EXPECT_EQ(still.counters.steps, 2000);
  EXPECT_EQ(still.counters.rejected, 0);
  // A first step that is far too long is shortened until the error is within the tolerance: by 1.1
  // at a time, or at once.
  const auto shrunk = runFor(model, "RK4 adaptive", 0.2, 0, with("First Step", 0.05));
  auto own = with("First Step", 0.05);
  own.set("Shrink", 10.0);
  const auto atOnce = runFor(model, "RK4 adaptive", 0.2, 0, own);
  EXPECT_GT(shrunk.counters.rejected, 3 * atOnce.counters.rejected);
  EXPECT_GT(atOnce.counters.rejected, 0);
}

TEST(Integrators, adaptiveStepHasASmallestLength) {
  const auto model = oscillator(1, 0, 1e8, 1.0, 0);
  auto own = with("Tolerance", 1e-9);
  own.set("Smallest Step", 1e-5);
  const auto text = errorText([&] { runFor(model, "RK4 adaptive", 1.0, 0, own); });
  EXPECT_NE(text.find("needs a step below 1e-05 s at t = 0"), std::string::npos) << text;
  EXPECT_NE(text.find("u of node 1"), std::string::npos) << text;
  own.set("Smallest Step", 1e-9);
  EXPECT_NO_THROW(runFor(model, "RK4 adaptive", 1e-4, 0, own));
}

TEST(Integrators, fixedStepsDivideTheSamplingInterval) {
  EXPECT_DOUBLE_EQ(fittedStep({0, 1, 0.005, 0}, 1e-3), 1e-3);
  EXPECT_DOUBLE_EQ(fittedStep({0, 1, 0.005, 0}, 0.0019), 0.005 / 3);
  EXPECT_DOUBLE_EQ(fittedStep({0, 1, 0.005, 0}, 0.005), 0.005);
  EXPECT_DOUBLE_EQ(fittedStep({0, 1, 0.005, 0}, 0.03),
                   1.0 / 34);  // longer than the interval: samples are interpolated
}

}  // namespace IntegratorTest
}  // namespace tooljoint::transient::testing
