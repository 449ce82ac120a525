// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws with states in every integrator that supports them: against closed forms, with the
/// order of the scheme.
///
/// Maxwell: the motion is that of a linear system of three equations. Elastic-plastic: free flight
/// against constant friction between an elastic arrival and elastic vibration about the position
/// where it sticks. Delay: q'' = -b q(t - tau) from rest at 1, by the method of steps: q(t) = sum_k
/// (-b)^k (t - (k-1) tau)^{2k} / (2k)! over all k with t >= (k-1) tau.
#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "model/laws/DelayLine.hpp"
#include "tests/unit/transient/StatefulModels.hpp"
#include "transient/schemes/Explicit.hpp"
#include "transient/schemes/FixedStepIntegrator.hpp"

namespace tooljoint::transient::testing {
namespace StatefulLawTest {

constexpr double kEnd = 0.4;

double maxwellError(const std::string& integrator, double step) {
  const MaxwellMass mass;
  Keep samples;
  integrate(mass.model(), options(integrator, kEnd, step, 0.02), samples);
  return largestError(samples, mass);
}

/// The motion moves by 3 cm before it creeps. Errors fall as h^2: factors of 4 within 5 % at steps
/// of a fiftieth of the relaxation time and less.
TEST(StatefulLaw, MaxwellElementIsOfSecondOrderInGeneralizedAlpha) {
  const double coarse = maxwellError("Generalized-alpha", 1e-3),
               fine = maxwellError("Generalized-alpha", 5e-4),
               finest = maxwellError("Generalized-alpha", 2.5e-4);
  EXPECT_LT(coarse, 2e-5);
  EXPECT_NEAR(coarse / fine, 4.0, 0.2);
  EXPECT_NEAR(fine / finest, 4.0, 0.2);
}

TEST(StatefulLaw, MaxwellElementIsOfFourthOrderInRungeKutta) {
  const double coarse = maxwellError("RK4", 1e-2), fine = maxwellError("RK4", 5e-3);
  EXPECT_LT(coarse, 1e-4);
  EXPECT_NEAR(coarse / fine, 16.0, 3.0);
}

TEST(StatefulLaw, AdaptiveRungeKuttaHoldsTheToleranceForMaxwell) {
  const MaxwellMass mass;
  for (const double tolerance : {1e-5, 1e-7}) {
    auto o = options("RK4 adaptive", kEnd, 0.0, 0.02);
    o.own.set("Tolerance", tolerance).set("First Step", 0.05).set("Growth", 1.2);
    Keep samples;
    const auto report = integrate(mass.model(), o, samples);
    EXPECT_GT(report.counters.rejected, 0);  // the first step is far too long
    // some hundred steps, each within the tolerance in v, act over a time of 0.05 s
    EXPECT_LT(largestError(samples, mass), 20 * tolerance);
  }
}

/// Steps of a tenth of the relaxation time h: interpolation leaves (h k/c)^4/384 = 2.6e-7 of the
/// displacement of the dashpot, which reaches 4 cm.
TEST(StatefulLaw, RatedStatesBetweenStepsAreInterpolated) {
  const MaxwellMass mass;
  Keep samples;
  integrate(mass.model(), options("RK4", kEnd, 5e-3, 5e-4), samples);
  for (std::size_t i = 0; i < samples.time.size(); ++i)
    EXPECT_NEAR(samples.x[i][0], mass.exact(samples.time[i])[2], 3e-7) << samples.time[i];
}

/// The integrators of SUNDIALS in this build.
std::vector<std::string> sundials() {
  std::vector<std::string> built;
  for (const auto* name : {"SUNDIALS ARKODE", "SUNDIALS CVODE"}) {
    try {
      IntegratorRegistry::instance().make(name, Teuchos::ParameterList())->checkParameters(0);
      built.emplace_back(name);
    } catch (const DeckError&) {  // built without SUNDIALS
    }
  }
  return built;
}

/// The error of a step is within the tolerance relative to the size of the motion, 3 cm and 1 m/s,
/// plus 1 cm and 1 m/s; errors of v act over the relaxation time of 0.05 s. The total error is at
/// most the sum over the steps. Separate masses keep the states apart.
TEST(StatefulLaw, MaxwellElementFollowsTheToleranceOfSundials) {
  const MaxwellMass mass;
  for (const auto& integrator : sundials()) {
    double before = 0;
    for (const double tolerance : {1e-5, 1e-8}) {
      auto o = options(integrator, kEnd, 0.0, 0.02);
      o.own.set("Relative Tolerance", tolerance);
      Keep samples, exact;
      const auto report = integrate(mass.model(3), o, samples);
      const double bound =
          static_cast<double>(report.counters.steps) * tolerance * (0.03 + 0.01 + 2 * 0.05);
      const double error = largestError(samples, mass);
      EXPECT_LT(error, bound) << integrator;
      if (before > 0) {
        EXPECT_LT(error, before / 30) << integrator;
      }
      before = error;
      integrate(mass.model(3), options("RK4", kEnd, 1e-3, 0.02), exact);
      for (std::size_t i = 0; i < exact.q.size(); ++i)
        EXPECT_LT((samples.q[i] - exact.q[i]).cwiseAbs().maxCoeff(), bound + 1e-8)
            << integrator << " and RK4 at " << exact.time[i];
    }
  }
}

/// The loss of the dashpot, c x'^2, and the energy of the spring close the ledger; at the end the
/// law has dissipated nearly all kinetic energy.
TEST(StatefulLaw, LedgerCountsWhatTheLawDissipates) {
  const MaxwellMass mass;
  const double energy = 0.5 * mass.m * mass.speed * mass.speed;
  for (const auto* integrator : {"Generalized-alpha", "RK4"}) {
    Keep samples;
    const auto report = integrate(mass.model(), options(integrator, kEnd, 5e-4, 0.02), samples);
    const Vector3 end = mass.exact(kEnd);
    const double left =
        0.5 * mass.m * end[1] * end[1] + 0.5 * mass.k * (end[0] - end[2]) * (end[0] - end[2]);
    EXPECT_NEAR(report.energy.contactDamping, energy - left, 1e-3 * energy) << integrator;
    EXPECT_NEAR(report.energy.contact, 0.5 * mass.k * std::pow(end[0] - end[2], 2), 1e-3 * energy);
    EXPECT_LT(std::abs(report.energy.residual()), 1e-3) << integrator;
  }
}

/// Thrown at 1 m/s from rest in the spring, the mass yields at d_y = F/k and slides until v = 0;
/// then it vibrates about d_s - F/k. With m v_y^2 = m v^2 - F d_y the sliding takes m v_y / F.
struct PlasticMass {
  double m = 2.0, k = 5e4, F = 100.0, speed = 1.0;
  double yields() const { return F / k; }
  double omega() const { return std::sqrt(k / m); }
  double yieldTime() const { return std::asin(yields() * omega() / speed) / omega(); }
  double yieldSpeed() const { return speed * std::cos(omega() * yieldTime()); }
  double stops() const { return yields() + 0.5 * m * yieldSpeed() * yieldSpeed() / F; }
  double stopTime() const { return yieldTime() + m * yieldSpeed() / F; }
  double exact(double t) const {
    if (t < yieldTime()) return speed / omega() * std::sin(omega() * t);
    const double s = t - yieldTime();
    if (t < stopTime()) return yields() + yieldSpeed() * s - 0.5 * F / m * s * s;
    return stops() - yields() * (1 - std::cos(omega() * (t - stopTime())));
  }
  model::SecondOrderModel model() const {
    auto model = denseModel(scalar(m), Matrix(), Matrix());
    model.initialVelocity[0] = speed;
    Teuchos::ParameterList own;
    own.set("Stiffness", k).set("Yield Force", F);
    addLaw(model, "Elastic-Plastic", own);
    return model;
  }
};

/// The force has kinks at two instants, so schemes are of second order here whatever their own.
TEST(StatefulLaw, ElasticPlasticSpringSlidesAndSticks) {
  const PlasticMass mass;
  auto integrators = sundials();
  for (const auto* integrator : {"Generalized-alpha", "RK4", "RK4 adaptive"})
    integrators.emplace_back(integrator);
  for (const auto& integrator : integrators) {
    auto o = options(integrator, 0.05, 2e-5, 1e-3);
    if (integrator == "RK4 adaptive") o.own.set("Tolerance", 1e-6);
    if (integrator.find("SUNDIALS") == 0)
      o.own.set("Relative Tolerance", 1e-7).set("Maximum Step", 1e-4);
    Keep samples;
    const auto report = integrate(mass.model(), o, samples);
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      EXPECT_NEAR(samples.q[i][0], mass.exact(samples.time[i]), 2e-4 * mass.stops())
          << integrator << " at " << samples.time[i];
    const double slid = mass.stops() - mass.yields();
    EXPECT_NEAR(report.energy.friction, mass.F * slid, 1e-3 * mass.F * slid) << integrator;
    EXPECT_LT(std::abs(report.energy.residual()), 2e-3) << integrator;
  }
}

/// A mass of 1 kg on a spring and on a belt of 0.02 m/s, whose friction of 30 N falls to 5 N over
/// 0.02 m/s. After the first slip, at 0.42 s, the belt takes it along again: friction holds more
/// than the 18 N of the spring. A step of 1 ms changes the velocity by 0.02 m/s there and would
/// pass over the peak. Slips begin and end within a step, in which the mass moves by 0.4 mm at
/// most.
TEST(StatefulLaw, StepsAcrossThePeakOfFrictionAreHalved) {
  const double belt = 0.02;
  const auto end = [&](const std::string& integrator, double step,
                       const Teuchos::ParameterList& more = Teuchos::ParameterList()) {
    const auto diagonal = [](double mass, double ofBelt) {
      return Matrix(Eigen::Vector2d(mass, ofBelt).asDiagonal());
    };
    auto model = denseModel(diagonal(1.0, 1e7), diagonal(2.0, 0.0), diagonal(4000.0, 0.0));
    model.initialVelocity[1] = belt;
    Teuchos::ParameterList own;
    own.set("Static Force", 30.0).set("Dynamic Force", 5.0).set("Decay Velocity", 0.02);
    own.set("Viscous Damping", 0.0).set("Slip Velocity", 1e-3);
    model::PointSet set;
    set.name = "belt";
    set.law = model::PointLawRegistry::instance().make("Stribeck", own, {1, 1});
    set.rows = Matrix((Matrix(1, 2) << 1.0, -1.0).finished()).sparseView();
    set.offset = Vector::Zero(1);
    set.entities = {1};
    model.points.push_back(set);
    auto o = options(integrator, 0.6, step, 0.1);
    o.own.setParameters(more);
    Keep samples;
    integrate(model, o, samples);
    return samples.q.back()[0];
  };
  const double exact = end("RK4", 1e-5);
  EXPECT_NEAR(exact, -8.6e-4, 1e-4);
  EXPECT_NEAR(end("Generalized-alpha", 1e-3), exact, 4e-4);
  Teuchos::ParameterList controlled, without;
  controlled.set("Step Tolerance", 1e-4);
  without.set("Resolve Impacts", false);
  EXPECT_NEAR(end("Generalized-alpha", 1e-3, controlled), exact, 4e-4);
  EXPECT_GT(end("Generalized-alpha", 1e-3, without), exact + 2e-3);
}

/// A force on the displacement with a delay.
struct Echo : model::Formula<1> {
  double b = 40.0, tau = 0.1;
  model::DelayLine past{1, 0.1, 64};
  int held() const { return past.states(); }
  void initial(double t, const double* d, const double*, double* x) const { past.start(t, d, x); }
  void accept(double t, const double* d, const double* v, double* x) const {
    past.append(t, d, v, x);
  }
  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T*) const {
    double then = 0;
    past.at(at.t - tau, at.held, &then);
    f[0] = T(-b * then);
  }
  Power power(const model::PointAt<double>& at, const double*) const {
    double f = 0;
    (*this)(at, &f, static_cast<double*>(nullptr));
    Power p;
    p.drive = f * at.v[0];
    return p;
  }
  double exact(double t) const {
    double q = 0, factor = 1;  // (-b)^k / (2k)!
    for (int k = 0; k < 20 && t >= (k - 1) * tau; ++k) {
      q += factor * std::pow(t - (k - 1) * tau, 2 * k);
      factor *= -b / ((2 * k + 1) * (2 * k + 2));
    }
    return q;
  }
};

model::SecondOrderModel echoing(const Echo& law) {
  auto model = denseModel(scalar(1.0), Matrix(), Matrix());
  model.initialDisplacement[0] = 1.0;
  model::PointSet set;
  set.name = "echo";
  set.law = std::make_shared<model::FormulaLaw<Echo>>(law, 1);
  set.rows = scalar(1.0).sparseView();
  set.offset = Vector::Zero(1);
  set.entities = {1};
  model.points = {set};
  return model;
}

TEST(StatefulLaw, DelayedForceFollowsTheMethodOfSteps) {
  const Echo law;
  const auto error = [&](const std::string& integrator, double step) {
    Keep samples;
    integrate(echoing(law), options(integrator, 0.5, step, 0.01), samples);
    double largest = 0;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      largest = std::max(largest, std::abs(samples.q[i][0] - law.exact(samples.time[i])));
    return largest;
  };
  EXPECT_LT(error("RK4", 1e-3), 1e-6);
  // at the default tolerance of 1e-4 of motion of about 1 m; steps shorten to the delay by
  // themselves
  for (const auto& integrator : sundials()) EXPECT_LT(error(integrator, 0), 5e-3) << integrator;
  EXPECT_LT(error("Generalized-alpha", 1e-3), 1e-4);
  EXPECT_NEAR(error("Generalized-alpha", 1e-3) / error("Generalized-alpha", 5e-4), 4.0, 0.4);
}

TEST(StatefulLaw, DelayShorterThanTheStepIsRefused) {
  const Echo law;
  Keep samples;
  try {
    integrate(echoing(law), options("RK4", 1.0, 0.25, 0.25), samples);
    FAIL() << "no error";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(std::string(error.what()).find("the delay is shorter than the time step"),
              std::string::npos)
        << error.what();
  }
}

/// Explicit Euler without support of states, with a required parameter.
class Stateless final : public FixedStepIntegrator {
 public:
  explicit Stateless(const Teuchos::ParameterList& own) : factor_(own.get<double>("Factor")) {}

 protected:
  void start(CompiledModel& model, State& state) override {
    rhs_.bind(model, "Stateless", counters_);
    rhs_.look(state.t, 0, state.q.data());
    rhs_.complete(state);
  }
  void step(const State& from, State& to) override {
    const double h = factor_ * (to.t - from.t);
    to.q = from.q + h * from.v;
    to.v = from.v + h * from.a;
    rhs_.complete(to);
  }

 private:
  double factor_;
  ExplicitRightHandSide rhs_;
};
const bool registered = IntegratorRegistry::instance().add(
    "Stateless",
    {"Euler (1768).",
     deck::ListSpec("Stateless", "")
         .real("Factor", "", deck::Required{}, deck::Range::positive(), "1."),
     [](const Teuchos::ParameterList& own) { return std::make_unique<Stateless>(own); }});

TEST(StatefulLaw, IntegratorsThatDoNotCarryStatesRefuseTheLaw) {
  ASSERT_TRUE(registered);
  Keep samples;
  auto o = options("Stateless", 0.1, 1e-3, 0.01);
  o.own.set("Factor", 1.0);
  try {
    integrate(MaxwellMass().model(), o, samples);
    FAIL() << "no error";
  } catch (const ModelError& error) {
    EXPECT_STREQ(
        error.what(),
        "The integrator \"Stateless\" does not carry the states of point laws, but the law "
        "of \"Maxwell\" has states. Use \"Generalized-alpha\" or \"RK4\".");
  }
  EXPECT_EQ(integrate(oscillator(1, 0, 9, 0.1, 0), o, samples).counters.steps, 100);
}

}  // namespace StatefulLawTest
}  // namespace tooljoint::transient::testing
