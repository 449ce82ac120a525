// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// ARKODE and CVODE against closed forms and other integrators, their Newton matrix against a dense
/// one, the effect of each parameter, and failures.
#include <Eigen/LU>
#include <gtest/gtest.h>

#include "StatefulModels.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "linalg/DenseDecompositions.hpp"
#include "tests/support/ErrorText.hpp"
#include "transient/schemes/sundials/FirstOrderForm.hpp"

namespace tooljoint::transient::testing {
namespace SundialsTest {

const std::string arkode = "SUNDIALS ARKODE", cvode = "SUNDIALS CVODE";

template <class T>
Teuchos::ParameterList with(const std::string& name, T value, Teuchos::ParameterList list = {}) {
  list.set(name, value);
  return list;
}

Teuchos::ParameterList tolerance(double relative) { return with("Relative Tolerance", relative); }

TransientReport run(const model::SecondOrderModel& model, const std::string& integrator, double end,
                    double sampling, const Teuchos::ParameterList& own, Keep& samples,
                    const RunHooks& hooks = {}) {
  auto o = options(integrator, end, 0, sampling);
  o.own = own;
  return integrate(model, o, samples, hooks);
}

TransientReport run(const model::SecondOrderModel& model, const std::string& integrator, double end,
                    const Teuchos::ParameterList& own = {}) {
  Keep samples;
  auto o = options(integrator, end, 0, end / 10);
  o.own = own;
  o.ledger = false;  // the test counts steps, also inaccurate ones of coarse tolerances
  return integrate(model, o, samples);
}

double largestDifference(const Keep& a, const Keep& b) {
  EXPECT_EQ(a.time.size(), b.time.size());
  double difference = 0;
  for (std::size_t i = 0; i < std::min(a.q.size(), b.q.size()); ++i)
    difference = std::max(difference, (a.q[i] - b.q[i]).cwiseAbs().maxCoeff());
  return difference;
}

/// Whether this build has no SUNDIALS and the integrator reports this; any other refusal has
/// another cause.
bool missing(const std::string& integrator) {
  const auto text = errorText([&] { run(oscillator(1, 0, 1, 1, 0), integrator, 0.1); });
  if (text.find("built without SUNDIALS") == std::string::npos) return false;
  EXPECT_NE(text.find("\"" + integrator + "\" needs. Install libsundials-dev"), std::string::npos)
      << text;
  return true;
}

/// Tests of both integrators; a build without SUNDIALS only tests that they report its absence.
class Sundials : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    if (missing(GetParam())) GTEST_SKIP() << "built without SUNDIALS";
  }
};
INSTANTIATE_TEST_SUITE_P(Transient, Sundials, ::testing::Values(arkode, cvode),
                         [](const auto& each) { return each.param.substr(9); });

/// Free vibration over 3 s. An amplitude of a micron is within the tolerance of a step: the
/// vibration is lost, with a warning. A warning is also given if the errors of many steps add up.
TEST_P(Sundials, warnOfAMotionThatTheirTolerancesDoNotResolve) {
  const struct {
    double amplitude, omega, allowed;
    bool lost;
  } cases[] = {{1e-6, 20, 1e-4, true},
               {0.5, 20, 1e-5, false},
               {1e-3, 50 * constants::twoPi, 3e-4, true},
               {1e-3, 50 * constants::twoPi, 1e-6, false}};
  for (const auto& [amplitude, omega, allowed, lost] : cases) {
    log::clearWarnings();
    Keep samples;
    auto o = options(GetParam(), 3.0, 0, 0.007);
    o.own = with("Maximum Step", 3.0, tolerance(allowed));
    o.ledger = false;
    integrate(oscillator(1.0, 0.0, omega * omega, amplitude, 0.0), o, samples);
    const auto& warnings = log::warnings();
    const bool warned = std::any_of(warnings.begin(), warnings.end(), [](const auto& text) {
      return text.find("are coarse for this motion") != std::string::npos;
    });
    double error = 0;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      error = std::max(error,
                       std::abs(samples.q[i][0] / amplitude - std::cos(omega * samples.time[i])));
    EXPECT_EQ(warned, lost) << amplitude << ", tolerance " << allowed << ": error " << error;
    EXPECT_EQ(error > 0.3, lost) << amplitude << ", tolerance " << allowed << ": " << error;
  }
  log::clearWarnings();
}

/// Largest error of the samples of a damped free vibration of 0.3 m: m 2, zeta 0.05, omega 10.
double freeVibrationError(const std::string& integrator, const Teuchos::ParameterList& own) {
  const double m = 2, omega = 10, zeta = 0.05;
  Keep samples;
  run(oscillator(m, 2 * zeta * omega * m, omega * omega * m, 0.3, -1.0), integrator, 1.0, 0.05, own,
      samples);
  const double wd = omega * std::sqrt(1 - zeta * zeta);
  double error = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const double t = samples.time[i];
    const double exact =
        std::exp(-zeta * omega * t) *
        (0.3 * std::cos(wd * t) + (-1.0 + zeta * omega * 0.3) / wd * std::sin(wd * t));
    error = std::max(error, std::abs(samples.q[i][0] - exact));
    // q'' is that of the equation of motion at the sampled q and v
    EXPECT_NEAR(samples.a[i][0],
                -2 * zeta * omega * samples.v[i][0] - omega * omega * samples.q[i][0], 1e-10);
  }
  EXPECT_EQ(samples.time.size(), 21u);
  return error;
}

TEST_P(Sundials, theErrorFollowsTheTolerance) {
  // Local errors add up over a few periods: the error is within 100 tolerances of the amplitude. A
  // thousandth of the tolerance gives a thousandth of the error within a factor of 30 (the error
  // per step is controlled, not that at the end).
  const double coarse = freeVibrationError(GetParam(), tolerance(1e-4));
  const double fine = freeVibrationError(GetParam(), tolerance(1e-7));
  EXPECT_LT(coarse, 100 * 1e-4 * 0.3);
  EXPECT_LT(fine, 100 * 1e-7 * 0.3 * 30);
  EXPECT_LT(fine, coarse / 30);
}

TEST_P(Sundials, samplesDoNotDependOnTheInterval) {
  const auto model = oscillator(1, 0.4, 400, 0.1, 0);
  Keep few, many;
  const auto own = with("Maximum Step", 1.0, tolerance(1e-6));
  const auto coarse = run(model, GetParam(), 1.0, 0.25, own, few);
  const auto fine = run(model, GetParam(), 1.0, 0.0025, own, many);
  // The interpolation is as accurate as the steps, and samples do not shorten steps.
  EXPECT_NEAR(static_cast<double>(fine.counters.steps), static_cast<double>(coarse.counters.steps),
              2.0);
  for (std::size_t i = 0; i < few.time.size(); ++i)
    EXPECT_EQ(few.q[i], many.q[100 * i]) << "sample " << i;
  for (std::size_t i = 0; i < many.time.size(); ++i) {
    const double wd = std::sqrt(400 - 0.04), t = many.time[i];
    EXPECT_NEAR(many.q[i][0],
                0.1 * std::exp(-0.2 * t) * (std::cos(wd * t) + 0.2 / wd * std::sin(wd * t)), 2e-4);
  }
}

/// Steps end at corners of laws and are no longer than the sampling interval: a step from rest does
/// not skip a pulse of 4 ms, and a pulse of 1 s needs no corner. An impulse of 1 N s moves 1 kg.
TEST_P(Sundials, fromRestNoPulseIsFlownOver) {
  for (const double half : {0.002, 0.5}) {
    auto model = oscillator(1.0, 0.0, 0.01, 0.0, 0.0);
    const auto pulse = [=](double t) {
      return std::max(0.0, (1 - std::abs(t - 8 - half) / half) / half);
    };
    model::ScalarLaw law{"kick", pulse};
    if (half < 0.1) law.corners = {8.0, 8 + half, 8 + 2 * half};
    model.loads.push_back({"kick", Vector::Ones(1), model.lawIndex(law)});
    Keep samples;
    run(model, GetParam(), 9.0, 0.25, tolerance(1e-4), samples);
    EXPECT_NEAR(samples.v.back()[0], std::cos(0.1 * (1 - half)), 0.01) << half;
  }
}

TEST_P(Sundials, ballsFallOnTheFloorAsWithRungeKutta) {
  const auto model = droppedBalls(4, 1e5, 200, 1e10, 1e3);
  Keep reference, samples;
  run(model, "RK4 adaptive", 0.2, 0.005, with("Tolerance", 1e-9), reference);
  const auto report = run(model, GetParam(), 0.2, 0.005, tolerance(1e-8), samples);
  // a fall of 6 mm: the motions agree to a hundredth of a percent of it
  EXPECT_LT(largestDifference(samples, reference), 6e-7);
  EXPECT_LT(std::abs(report.energy.residual()), 1e-3);
  EXPECT_GT(report.contactEvaluations, 0);
}

TEST_P(Sundials, whatWasDoneIsCounted) {
  const auto report = run(droppedBalls(4, 1e6, 2e3, 7e11), GetParam(), 0.2, tolerance(1e-4));
  const auto& c = report.counters;
  EXPECT_GT(c.steps, 20);
  EXPECT_GT(c.rejected, 0);  // the impact is not known in advance
  EXPECT_GE(c.newtonIterations, c.steps);
  EXPECT_GT(c.factorisations, 2);
  EXPECT_GT(c.rightHandSides, c.newtonIterations);
  EXPECT_EQ(c.unconvergedSteps, 0);
  EXPECT_GT(c.minStep, 0);
  EXPECT_LT(c.minStep, c.maxStep);
  EXPECT_EQ(report.end, 0.2);
}

TEST_P(Sundials, stepsStartAndEndAsAsked) {
  const auto model = oscillator(1, 0, 400, 0.1, 0);
  // at a tolerance that needs fewer steps than the bound
  const auto bounded = run(model, GetParam(), 1.0,
                           with("Maximum Step", 1e-3, with("Initial Step", 2e-5, tolerance(1e-4))));
  EXPECT_DOUBLE_EQ(bounded.counters.minStep, 2e-5);
  EXPECT_LE(bounded.counters.maxStep, 1e-3 * (1 + 1e-12));
  EXPECT_GE(bounded.counters.steps, 1000);
  EXPECT_LT(run(model, GetParam(), 1.0, tolerance(1e-4)).counters.steps, 1000);
  // Transient/Step is the first step of an integrator that chooses the others.
  Keep samples;
  const auto report = integrate(model, options(GetParam(), 1.0, 3e-6, 0.1), samples);
  EXPECT_DOUBLE_EQ(report.counters.minStep, 3e-6);
}

TEST_P(Sundials, aDofWithoutMassIsRefused) {
  auto model = springChain(3, 1.0, 0.0, 10.0);
  model.mass.coeffRef(1, 1) = 0.0;
  const auto text = errorText([&] { run(model, GetParam(), 1.0); });
  EXPECT_NE(text.find("The mass matrix is singular at u of node 2: the integrator \"" + GetParam()),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("Generalized-alpha"), std::string::npos) << text;
}

TEST_P(Sundials, tooManyStepsEndTheRun) {
  const auto text = errorText(
      [&] { run(oscillator(1, 0, 1e6, 1e-3, 0), GetParam(), 10.0, with("Maximum Steps", 50)); });
  EXPECT_NE(text.find(GetParam() + " has taken 50 steps by t = "), std::string::npos) << text;
  EXPECT_NE(text.find("Transient/" + GetParam() + "/Maximum Steps"), std::string::npos) << text;
}

TEST_P(Sundials, noNumberInALoadEndsTheRunWithTimeAndDof) {
  auto model = springChain(3, 1.0, 0.5, 100.0);
  const int law = model.lawIndex({"broken", [](double t) { return t < 0.5 ? 1.0 : std::nan(""); }});
  model.loads.push_back({"broken", Vector::Unit(3, 2), law});
  Keep samples;
  const auto text = errorText([&] { run(model, GetParam(), 1.0, 0.1, {}, samples); });
  EXPECT_NE(text.find("The motion is not finite"), std::string::npos) << text;
  EXPECT_TRUE(text.find("t = 0.49") != std::string::npos ||
              text.find("t = 0.5") != std::string::npos)
      << text;
  EXPECT_NE(text.find("of node"), std::string::npos) << text;
  for (const auto& q : samples.q) EXPECT_TRUE(q.allFinite());
  // from the first moment on
  model.laws.own().back().value = [](double) { return std::nan(""); };
  EXPECT_NE(errorText([&] { run(model, GetParam(), 1.0); }).find("not finite"), std::string::npos);
}

TEST_P(Sundials, errorsOfTheModelComeThrough) {
  auto model = springChain(3, 1.0, 0.5, 100.0);
  const int law = model.lawIndex({"ends", [](double t) {
                                    if (t > 0.3)
                                      throw ModelError("The table of loads ends at 0.3 s.");
                                    return 1.0;
                                  }});
  model.loads.push_back({"ends", Vector::Unit(3, 2), law});
  EXPECT_EQ(errorText([&] { run(model, GetParam(), 1.0); }), "The table of loads ends at 0.3 s.");
}

TEST_P(Sundials, toleranceBelowRoundingIsRefused) {
  auto own = tolerance(1e-30);
  const auto text = errorText([&] { run(oscillator(1, 0, 400, 0.1, 0), GetParam(), 1.0, own); });
  EXPECT_NE(text.find("more digits than numbers have"), std::string::npos) << text;
  EXPECT_NE(text.find("Transient/" + GetParam() + "/Relative Tolerance"), std::string::npos)
      << text;
}

TEST_P(Sundials, moreNewtonIterationsSaveSteps) {
  // Number of steps shortened because Newton's method did not converge, on soft to hard walls, with
  // coarse and fine tolerances.
  const auto shortened = [&](int iterations) {
    long sum = 0;
    for (const double stiffness : {1e6, 1e9})
      for (const double relative : {1e-1, 1e-2, 1e-3, 1e-4})
        sum += run(droppedBalls(4, stiffness, 2e3, 7e11, 1e5), GetParam(), 0.2,
                   with("Maximum Newton Iterations", iterations, tolerance(relative)))
                   .counters.halved;
    return sum;
  };
  EXPECT_GT(shortened(2), shortened(12));
}

TEST_P(Sundials, absoluteTolerancesRuleSmallMotion) {
  const auto model = oscillator(1, 0, 400, 1e-5, 0);
  const auto usual = run(model, GetParam(), 1.0).counters.steps;
  EXPECT_GT(run(model, GetParam(), 1.0, with("Absolute Tolerance", 1e-10)).counters.steps, usual);
  EXPECT_GT(run(model, GetParam(), 1.0, with("Absolute Velocity Tolerance", 1e-9)).counters.steps,
            usual);
}

/// Two inertias on a torsional spring, twist 0.2 cos(20 t), after a common rotation of 1e4 rad: the
/// total angle does not loosen the tolerance.
TEST_P(Sundials, whatHasTurnedIsFollowedAsClosely) {
  const auto twistError = [&](double turned) {
    const double k = 200.0;
    auto rotor = denseModel(Matrix::Identity(2, 2), Matrix::Zero(2, 2),
                            (Matrix(2, 2) << k, -k, -k, k).finished());
    rotor.initialDisplacement = Vector::Constant(2, turned);
    rotor.initialDisplacement[0] += 0.1;
    rotor.initialDisplacement[1] -= 0.1;
    rotor.initialVelocity = Vector::Constant(2, 3.0);
    Keep samples;
    run(rotor, GetParam(), 3.0, 0.05, with("Maximum Step", 3.0), samples);
    double error = 0;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      error = std::max(error, std::abs(samples.q[i][0] - samples.q[i][1] -
                                       0.2 * std::cos(20.0 * samples.time[i])));
    return error;
  };
  const double still = twistError(0.0), turned = twistError(1e4);
  EXPECT_LT(still, 0.02);
  EXPECT_LT(turned, 3.0 * still);
}

TEST(SundialsMethods, everyTableIntegratesToItsTolerance) {
  const auto* method =
      IntegratorRegistry::instance().find(arkode).parameters.findParameter("Method");
  ASSERT_NE(method, nullptr);
  if (missing(arkode)) GTEST_SKIP() << "built without SUNDIALS";
  for (const auto& name : method->choices)
    EXPECT_LT(freeVibrationError(arkode, with("Method", name, tolerance(1e-5))), 100 * 1e-5 * 0.3)
        << name;
}

TEST(SundialsMethods, ordersAboveTwoSaveStepsOnDampedMotionOnly) {
  if (missing(cvode)) GTEST_SKIP() << "built without SUNDIALS";
  const auto steps = [](double damping, int order) {
    return run(oscillator(1, damping, 400, 0.1, 0), cvode, 2.0,
               with("Maximum Order", order, tolerance(1e-6)))
        .counters.steps;
  };
  EXPECT_LT(steps(40, 5), steps(40, 2));
  EXPECT_LT(steps(40, 2), steps(40, 1));
}

// The Newton matrix
// -------------------------------------------------------------------------------------------------

/// A chain of nodes with two dofs each, unsymmetric K, changing damping, and points in contact,
/// points on several dofs and distant points.
model::SecondOrderModel entangled() {
  const int n = 8;
  Matrix M = 2.0 * Matrix::Identity(n, n), C = Matrix::Zero(n, n), K = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 500 + 10 * i;
    C(i, i) = 3;
    if (i > 0)
      M(i, i - 1) = M(i - 1, i) = 0.3, K(i, i - 1) = -120, K(i - 1, i) = -90, C(i, i - 1) = 1.5,
               C(i - 1, i) = -1.5;
  }
  auto model = denseModel(M, C, K, 2);
  const int law = model.lawIndex({"swell", [](double t) { return 1 + t; }});
  model.damping.push_back({"swelling", (0.7 * Matrix::Identity(n, n)).sparseView(), law});
  addFloor(model, 800, 20, 30);
  model.points.back().rows.coeffRef(2, 3) = 0.5;
  model.points.back().rows.coeffRef(5, 4) = -0.4;
  model.points.back().offset[7] = 5.0;
  return model;
}

/// The Newton matrix of a model against that of differences, rated states of point laws included.
void expectItsJacobian(const model::SecondOrderModel& source, int rated) {
  CompiledModel model(source);
  FirstOrderForm form;
  form.bind(model, "a test");
  const int m = form.size();
  ASSERT_EQ(m, 2 * source.size() + rated);
  const double t = 0.4;
  Vector y(m), up(m), down(m);
  for (int i = 0; i < m; ++i) y[i] = 0.05 * std::sin(1.0 + 3.1 * i);
  // J by central differences of the right-hand side: error of the order of e^2 f''' with lengths of
  // 1/lambda
  const double e = 1e-6;
  Matrix J(m, m);
  for (int j = 0; j < m; ++j) {
    Vector there = y;
    there[j] += e;
    form.rightHandSide(t, there.data(), up.data());
    there[j] -= 2 * e;
    form.rightHandSide(t, there.data(), down.data());
    J.col(j) = (up - down) / (2 * e);
  }
  for (const double gamma : {1e-4, 1e-2, 0.3}) {
    ASSERT_TRUE(form.factor(t, y.data(), gamma));
    form.rightHandSide(t, y.data(), up.data());  // solvers evaluate between the two
    Vector x(m);
    for (int i = 0; i < m; ++i) x[i] = std::cos(2.0 * i);
    const Vector expected = linalg::DenseLu(Matrix::Identity(m, m) - gamma * J).solve(x);
    form.solve(x.data());
    EXPECT_LT((x - expected).norm(), 1e-7 * expected.norm()) << "gamma " << gamma;
  }
}

TEST(FirstOrderForm, solvesWithItsJacobian) { expectItsJacobian(entangled(), 0); }

TEST(FirstOrderForm, solvesWithItsJacobianForStatesOfPointLaws) {
  auto source = entangled();
  addStatefulLaws(source);
  expectItsJacobian(source, source.size());
}

TEST(FirstOrderForm, aPointActsWhereverItIsLookedAt) {
  // The solver may evaluate a state in contact after one far away, at any time: the force must be
  // that of the state.
  auto source = oscillator(2.0, 0, 0, 1.0, 0);
  addFloor(source, 1e4, 0, 1e6);
  CompiledModel model(source);
  FirstOrderForm form;
  form.bind(model, "a test");
  Vector y(2), yDot(2);
  y << 1.0, 0.0;
  form.rightHandSide(0.0, y.data(), yDot.data());
  EXPECT_EQ(yDot[1], 0.0);
  y << -0.01, 0.0;
  form.rightHandSide(1.0, y.data(), yDot.data());
  EXPECT_NEAR(yDot[1], 1e4 * 0.01 / 2.0, 1e-2);
  y << 1.0, 0.0;
  form.rightHandSide(0.5, y.data(), yDot.data());
  EXPECT_EQ(yDot[1], 0.0);
}

TEST(FirstOrderForm, singularMatricesAreTold) {
  // M + g C vanishes for C = -M/g.
  const auto source = oscillator(2.0, -20.0, 0.0, 1.0, 0);
  CompiledModel model(source);
  FirstOrderForm form;
  form.bind(model, "a test");
  const Vector y = Vector::Ones(2);
  EXPECT_FALSE(form.factor(0.0, y.data(), 0.1));
  EXPECT_TRUE(form.factor(0.0, y.data(), 0.2));
}

}  // namespace SundialsTest
}  // namespace tooljoint::transient::testing
