// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The run around an integrator: samples, reports, errors, interrupts, energy, allocation.
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <gtest/gtest.h>
#include <utility>

#include "StatefulModels.hpp"
#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/report/Log.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "tests/support/ErrorText.hpp"

// Counts every allocation of this program. The sanitizers have their own malloc.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__) && defined(__GLIBC__)
#define COUNTS_ALLOCATIONS 1
static long allocations = 0;
extern "C" void* __libc_malloc(std::size_t);
extern "C" void* malloc(std::size_t bytes) {
  ++allocations;
  return __libc_malloc(bytes);
}
#endif

namespace tooljoint::transient::testing {
namespace TransientTest {

const std::vector<std::string> allIntegrators = {"Generalized-alpha", "RK4", "RK4 adaptive"};

// Samples
// -------------------------------------------------------------------------------------------------

TEST(Transient, samplesStandAtMultiplesOfTheInterval) {
  const auto model = oscillator(1, 0.1, 400, 0.1, 0);
  for (const auto& integrator : allIntegrators) {
    Keep samples;
    auto o = options(integrator, 1.7, 5e-3, 0.05);
    o.start = 0.5;
    const auto report = integrate(model, o, samples);
    ASSERT_EQ(samples.time.size(), 25u) << integrator;
    for (std::size_t i = 0; i < samples.time.size(); ++i)
      EXPECT_DOUBLE_EQ(samples.time[i], 0.5 + 0.05 * static_cast<double>(i));
    EXPECT_EQ(report.samples, 25);
    EXPECT_EQ(report.start, 0.5);
    EXPECT_EQ(report.end, 1.7);
  }
}

TEST(Transient, anEndBetweenSamplesIsReachedButNotSampled) {
  const auto model = oscillator(1, 0.1, 400, 0.1, 0);
  for (const auto& integrator : allIntegrators) {
    Keep samples;
    const auto report = integrate(model, options(integrator, 0.117, 1e-3, 0.05), samples);
    EXPECT_EQ(samples.time.size(), 3u);
    EXPECT_EQ(report.end, 0.117);
  }
}

/// Interpolation leaves h^4/384 = 2.6e-7 of q and v and sqrt(3) h^3/216 = 8e-6 of a, beside the
/// error of the steps.
TEST(Transient, samplesBetweenLongStepsAreInterpolated) {
  const auto model = oscillator(1, 0, 1, 1.0, 0);
  Keep samples;
  integrate(model, options("RK4", 2.0, 0.1, 0.01), samples);
  ASSERT_EQ(samples.time.size(), 201u);
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    EXPECT_NEAR(samples.q[i][0], std::cos(samples.time[i]), 2e-6);
    EXPECT_NEAR(samples.v[i][0], -std::sin(samples.time[i]), 2e-6);
    EXPECT_NEAR(samples.a[i][0], -std::cos(samples.time[i]), 1e-5);
  }
}

TEST(Transient, samplesAreInTheOrderOfTheModel) {
  // Dofs of two nodes are mixed: the kernel sorts them by node, which must not affect the sink.
  auto model = springChain(4, 1, 0, 50);
  model.dofs = {model::DofLabel::physical(1, 0), model::DofLabel::physical(2, 0),
                model::DofLabel::physical(1, 1), model::DofLabel::physical(2, 1)};
  model.initialDisplacement << 1, 2, 3, 4;
  model.initialVelocity << 5, 6, 7, 8;
  Keep samples;
  integrate(model, options("RK4", 0.1, 1e-3, 0.1), samples);
  EXPECT_EQ(samples.q[0], model.initialDisplacement);
  EXPECT_EQ(samples.v[0], model.initialVelocity);
  EXPECT_LT((samples.a[0] + model.stiffness[0].matrix * model.initialDisplacement).norm(), 1e-12);
}

TEST(Transient, integratorsAgree) {
  const auto model = droppedBalls(5, 1e6, 300, 1e6, 2e4);
  std::vector<Keep> samples(3);
  integrate(model, options("RK4", 0.05, 1e-6, 0.005), samples[0]);
  integrate(model, options("Generalized-alpha", 0.05, 1e-5, 0.005), samples[1]);
  auto o = options("RK4 adaptive", 0.05, 0, 0.005);
  o.own.set("Tolerance", 1e-7);
  integrate(model, o, samples[2]);
  for (std::size_t i = 0; i < samples[0].q.size(); ++i) {
    EXPECT_LT((samples[1].q[i] - samples[0].q[i]).cwiseAbs().maxCoeff(), 2e-6);
    EXPECT_LT((samples[2].q[i] - samples[0].q[i]).cwiseAbs().maxCoeff(), 2e-6);
  }
}

// Options
// -------------------------------------------------------------------------------------------------

TEST(Transient, readsItsListWithDefaults) {
  Teuchos::ParameterList list("Transient");
  list.set("End Time", 2.0);
  auto o = readOptions(list);
  EXPECT_EQ(o.integrator, "Generalized-alpha");
  EXPECT_EQ(o.start, 0.0);
  EXPECT_EQ(o.sampling, 0.005);
  EXPECT_EQ(o.step, 0.0);
  EXPECT_TRUE(o.progress);
  EXPECT_TRUE(o.ledger);
  list.set("Integrator", "RK4");
  list.set("Step", 1e-4);
  list.sublist("RK4").set("Safety", 0.5);
  o = readOptions(list);
  EXPECT_EQ(o.step, 1e-4);
  EXPECT_EQ(o.own.get<double>("Safety"), 0.5);
  EXPECT_TRUE(isExplicit(list));
  list.set("Integrator", "Generalized-alpha");
  EXPECT_FALSE(isExplicit(list));
}

TEST(Transient, refusesAnEndBeforeTheStart) {
  Teuchos::ParameterList list("Transient");
  list.set("End Time", 1.0);
  list.set("Start Time", 1.0);
  EXPECT_NE(errorText([&] { readOptions(list); }).find("must be later than Transient/Start Time"),
            std::string::npos);
}

TEST(Transient, refusesCountsOfStepsAndSamplesThatNobodyCanCompute) {
  Teuchos::ParameterList list("Transient");
  list.set("End Time", 1e6);
  list.set("Step", 1e-9);
  EXPECT_NE(errorText([&] { readOptions(list); })
                .find("Transient/Step is 1e-09 s, which gives 1e+15 intervals in the 1e+06 s from "
                      "Start Time to End Time. The limit is 1e+12"),
            std::string::npos)
      << errorText([&] { readOptions(list); });
  list.set("Step", 1e-3);
  list.set("Sampling Interval", 1e-3);
  EXPECT_NE(errorText([&] {
              readOptions(list);
            }).find("Transient/Sampling Interval is 0.001 s, which gives 1e+09 intervals"),
            std::string::npos);
  list.set("Sampling Interval", 1.0);
  EXPECT_EQ(readOptions(list).sampling, 1.0);
  list.set("Start Time", -1e308);
  list.set("End Time", 1e308);  // their difference is no number
  EXPECT_THROW(readOptions(list), DeckError);
}

TEST(Transient, everyIntegratorDescribesItself) {
  const auto spec = parameters();
  for (const auto& integrator : allIntegrators) {
    const auto* own = spec.findList(integrator);
    ASSERT_NE(own, nullptr) << integrator;
    EXPECT_GT(own->doc().size(), 20u);
    EXPECT_FALSE(own->parameters().empty());
  }
  EXPECT_NE(errorText([] {
              IntegratorRegistry::instance().make("Newmark", Teuchos::ParameterList());
            }).find("\"RK4 adaptive\""),
            std::string::npos);
}

// Failures
// -------------------------------------------------------------------------------------------------

/// The advice after a wrong motion names parameters of this integrator.
TEST(Transient, adviceFitsTheIntegrator) {
  const auto& registry = IntegratorRegistry::instance();
  for (const auto& name : allIntegrators) {
    const auto advice = registry.make(name, Teuchos::ParameterList())->advice();
    EXPECT_EQ(advice.rfind("Reduce Transient/", 0), 0u) << advice;
    const bool hasStep = name == "Generalized-alpha" || name == "RK4";
    EXPECT_EQ(advice.find("Transient/Step") != std::string::npos, hasStep) << advice;
    if (!hasStep) {
      EXPECT_NE(advice.find("Transient/" + name + "/"), std::string::npos) << advice;
      EXPECT_NE(advice.find("Tolerance"), std::string::npos) << advice;
    }
  }
  Teuchos::ParameterList own;
  own.set("Step Tolerance", 1e-6);
  EXPECT_NE(
      registry.make("Generalized-alpha", own)->advice().find("Generalized-alpha/Step Tolerance"),
      std::string::npos);
}

TEST(Transient, rightHandSidesAreCounted) {
  const auto model = springChain(4, 1, 0.1, 100);
  Keep samples;
  EXPECT_EQ(integrate(model, options("RK4", 1, 0.01, 0.1), samples).counters.rightHandSides,
            1 + 4 * 100);
  const auto adaptive = integrate(model, options("RK4 adaptive", 1, 0.01, 0.1), samples).counters;
  EXPECT_EQ(adaptive.rightHandSides,
            1 + 10 * (adaptive.steps + adaptive.rejected) + adaptive.steps);
  EXPECT_EQ(
      integrate(model, options("Generalized-alpha", 1, 0.01, 0.1), samples).counters.rightHandSides,
      0);
}

TEST(Transient, blowUpIsDetectedWithTimeAndDof) {
  auto model = springChain(3, 1.0, 0.0, 100.0);
  Sparse negative(3, 3);
  negative.coeffRef(1, 1) = -40.0;  // feeds energy in at node 2
  model.damping = {{"unstable", negative, 0}};
  model.initialVelocity[1] = 1.0;
  for (const auto& integrator : allIntegrators) {
    Keep samples;
    const auto text =
        errorText([&] { integrate(model, options(integrator, 100.0, 1e-2, 1.0), samples); });
    EXPECT_NE(text.find("The motion blew up in the step from t = "), std::string::npos)
        << integrator << ": " << text;
    EXPECT_NE(text.find("u of node 2"), std::string::npos) << text;
  }
}

TEST(Transient, aStepBeyondTheStabilityLimitIsNotAResult) {
  auto model = oscillator(1, 0, 1e6, 1e-3, 0);
  Keep samples;
  const auto text = errorText([&] { integrate(model, options("RK4", 10.0, 4e-3, 1.0), samples); });
  EXPECT_NE(text.find("blew up"), std::string::npos) << text;
  for (const auto& q : samples.q) EXPECT_LT(q.cwiseAbs().maxCoeff(), 1e6);
}

TEST(Transient, notANumberInALoadEndsTheRunAtItsTime) {
  auto model = springChain(3, 1.0, 0.5, 100.0);
  const int law = model.lawIndex({"broken", [](double t) { return t < 0.5 ? 1.0 : std::nan(""); }});
  model.loads.push_back({"broken", Vector::Unit(3, 2), law});
  for (const auto& integrator : allIntegrators) {
    Keep samples;
    const auto text =
        errorText([&] { integrate(model, options(integrator, 1.0, 1e-2, 0.1), samples); });
    EXPECT_TRUE(text.find("t = 0.4") != std::string::npos ||
                text.find("t = 0.5") != std::string::npos)
        << integrator << ": " << text;
    EXPECT_NE(text.find("of node"), std::string::npos) << text;
    for (const auto& q : samples.q) EXPECT_TRUE(q.allFinite());
  }
}

/// A pulse of two steps, and one of a hundred.
TEST(Transient, aLawFasterThanTheStepsIsWarnedOf) {
  for (const double duration : {2e-3, 0.1}) {
    auto model = oscillator(1.0, 1.0, 4.0, 0.0, 0.0);
    const int law = model.lawIndex({"push", [=](double t) { return std::exp(-t / duration); }});
    model.loads.push_back({"push", Vector::Ones(1), law});
    log::clearWarnings();
    Keep samples;
    integrate(model, options("Generalized-alpha", 1.0, 1e-3, 0.1), samples);
    const auto& warnings = log::warnings();
    EXPECT_EQ(std::any_of(warnings.begin(), warnings.end(),
                          [](const auto& one) {
                            return one.find("too large for the law \"push\"") != std::string::npos;
                          }),
              duration < 0.01);
  }
}

/// A pulse that ends before the middle, or before a quarter, of a step: sums over whole and half
/// steps do not detect it, and the motion contains none of its effect.
TEST(Transient, aPulseBetweenTheHalvesOfAStepIsRefused) {
  auto model = oscillator(1.0, 1.0, 4.0, 0.0, 0.0);
  const double h = 1e-2, begin = 5e-2;
  const int law = model.lawIndex({"kick", [=](double t) {
                                    const double part = (t - begin) / h;
                                    return part > 0.05 && part < 0.2 ? 1.0 : 0.0;
                                  }});
  model.loads.push_back({"kick", Vector::Ones(1), law});
  auto o = options("Generalized-alpha", 1.0, h, 0.1);
  Keep samples;
  const std::string sentence = "too large for the law \"kick\"";
  EXPECT_NE(errorText([&] { integrate(model, o, samples); }).find(sentence), std::string::npos);
  log::clearWarnings();
  acceptCoarseSteps(o);
  integrate(model, o, samples);
  const auto& warnings = log::warnings();
  EXPECT_TRUE(std::any_of(warnings.begin(), warnings.end(), [&](const auto& one) {
    return one.find(sentence) != std::string::npos;
  }));
}

/// In generalized-alpha a pulse of stiffness within a step is an impulse -q int k dt, as with short
/// steps. RK4 refuses it: its stages would have large stiffnesses of both signs.
TEST(Transient, aPulseOfStiffnessBetweenEndsOfStepsIsFollowedOrRefused) {
  for (const auto& [from, to] : {std::pair{0.5013, 0.5016}, {0.4997, 0.5003}}) {
    const double middle = 0.5 * (from + to), half = 0.5 * (to - from);
    const auto last = [&, first = from, end = to](const char* integrator, double step,
                                                  double pulse) {
      auto o = options(integrator, 1.0, step, 0.1);
      o.ledger = false;
      o.stepErrorLimit = 0.9;
      auto model = oscillator(1.0, 1.0, 4.0, 0.1, 0.0);
      const int law =
          model.lawIndex({"kick",
                          [=](double t) { return std::max(0.0, 1 - std::abs(t - middle) / half); },
                          {first, middle, end}});
      model.stiffness.push_back({"kick", scalar(pulse / half).sparseView(), law});
      Keep samples;
      integrate(model, o, samples);
      return samples.q.back()[0];
    };
    const char* alpha = "Generalized-alpha";
    const double without = last(alpha, 1e-2, 0.0), fine = last(alpha, 1e-5, 1.5);
    EXPECT_GT(std::abs(fine - without), 0.01) << from;
    EXPECT_NEAR(last(alpha, 1e-2, 1.5), fine, 0.02 * std::abs(fine - without)) << from;
    const auto text = errorText([&] { last("RK4", 1e-2, 1.5); });
    EXPECT_NE(text.find("too large for the law \"kick\""), std::string::npos) << from << text;
  }
}

/// A load released at the start is nonzero at that time only: its integral is zero, and no part of
/// it is lost.
TEST(Transient, aLoadThatIsLetGoIsNotRefused) {
  auto model = oscillator(1.0, 1.0, 4.0, 0.0, 0.0);
  const int law = model.lawIndex({"let go", [](double t) { return t > 0 ? 0.0 : 1.0; }});
  model.loads.push_back({"pull", Vector::Ones(1), law});
  model.initialDisplacement[0] = 0.25;
  Keep samples;
  EXPECT_NO_THROW(integrate(model, options("Generalized-alpha", 1.0, 1e-2, 0.1), samples));
}

/// q_{n+1} = q_n + h v_n; has no error estimate and repeats no step.
class Drift final : public Integrator {
 public:
  std::string advice() const override { return "Reduce Transient/Step"; }
  void prepare(CompiledModel&, const Window& window, State& state) override {
    h_ = window.step;
    state.a.setZero();
  }
  void advance(const State& from, State& to) override {
    to = from;
    to.t = from.t + h_;
    to.q += h_ * from.v;
    counters_.accept(h_);
  }
  void save(std::vector<double>&) const override {}
  void restore(const double*&) override {}

 private:
  double h_ = 0;
};

TEST(Transient, theAccuracyOfStepsThatNobodyMeasuresIsNotKnown) {
  IntegratorRegistry::instance().add("Drift",
                                     {"Constant velocity.", {}, [](const Teuchos::ParameterList&) {
                                        return std::make_unique<Drift>();
                                      }});
  const auto model = oscillator(1, 0, 0, 0, 1);
  const auto said = [&](const std::string& integrator) {
    Keep samples;
    auto o = options(integrator, 1.0, 0.125, 0.5);
    o.ledger = false;
    ::testing::internal::CaptureStdout();
    integrate(model, o, samples);
    EXPECT_EQ(samples.q.back()[0], 1.0);
    return ::testing::internal::GetCapturedStdout();
  };
  auto text = said("Drift");
  for (auto wrap = text.find("\n  "); wrap != std::string::npos; wrap = text.find("\n  "))
    text.replace(wrap, text.find_first_not_of(" \n", wrap) - wrap, " ");
  EXPECT_NE(text.find("accuracy    not known: the integrator \"Drift\" does not measure"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("half the step."), std::string::npos) << text;
  EXPECT_EQ(said("Generalized-alpha").find("not known"), std::string::npos);
}

// Interrupt
// -------------------------------------------------------------------------------------------------

TEST(Transient, anInterruptStopsCleanly) {
  const auto model = oscillator(1, 0, 400, 0.1, 0);
  Keep samples;
  requestInterrupt();
  const auto report = integrate(model, options("RK4", 1.0, 1e-3, 0.1), samples);
  requestInterrupt(false);
  EXPECT_TRUE(report.interrupted);
  EXPECT_EQ(report.end, 0.0);
  EXPECT_EQ(samples.time.size(), 1u);
}

// Cost
// -------------------------------------------------------------------------------------------------

#ifdef COUNTS_ALLOCATIONS
/// Counter of allocations at the first sample and at the last.
class AllocationProbe final : public SampleSink {
 public:
  void sample(double, const Vector&, const Vector&, const Vector&) override {
    if (first < 0) first = last = allocations;
    if (allocations != last) ++samples;
    last = allocations;
  }
  long first = -1, last = -1;
  long samples = 0;  ///< number of samples with allocations before them
};

TEST(Cost, theStepLoopAllocatesNothing) {
  auto model = eventful();
  auto ways = allIntegrators;
  ways.push_back(controlledAlpha);
  for (const auto& integrator : ways) {
    AllocationProbe probe;
    auto o = wayToStep(integrator, 0.2);
    const auto report = integrate(model, o, probe);
    EXPECT_GT(report.counters.steps, 100);
    EXPECT_EQ(probe.last - probe.first, 0) << integrator;
  }
  const long before = allocations;
  auto* something = new std::vector<double>(100);  // the probe itself works
  delete something;
  EXPECT_GT(allocations, before);
}
#endif

#ifdef COUNTS_ALLOCATIONS
TEST(Cost, statesOfPointLawsAllocateNothingInTheStepLoop) {
  auto model = eventful();
  addStatefulLaws(model);
  for (const std::string integrator : {"Generalized-alpha", controlledAlpha, "RK4"}) {
    AllocationProbe probe;
    const auto report = integrate(model, wayToStep(integrator, 0.2), probe);
    EXPECT_GT(report.counters.steps, 100);
    EXPECT_EQ(probe.last - probe.first, 0) << integrator;
  }
  // every hundredth step recomputes the rate of the laws
  AllocationProbe probe;
  const auto report = integrate(model, wayToStep("RK4 adaptive", 0.2), probe);
  EXPECT_GT(report.counters.steps, 100);
  EXPECT_GT(probe.samples, 0);
  EXPECT_LE(probe.samples, report.counters.steps / 100);
}
#endif

TEST(Cost, onlyPointsNearTheFloorAreEvaluated) {
  auto model = droppedBalls(10, 1e6, 2e3, 7e11);
  for (int i = 0; i < 5; ++i)
    model.initialDisplacement[i] = 10.0 + i;  // five do not come down in time
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 0.2, 1e-3, 0.05), samples);
  EXPECT_GT(report.contactEvaluations, 0);
  // Five balls, at most a dozen evaluations per step and ball.
  EXPECT_LT(report.contactEvaluations, 5 * 12 * report.counters.steps);
  model.initialDisplacement.setConstant(10.0);
  EXPECT_EQ(
      integrate(model, options("Generalized-alpha", 0.2, 1e-3, 0.05), samples).contactEvaluations,
      0);
}

TEST(Cost, reportAddsUp) {
  const auto model = eventful();
  Keep samples;
  const auto report = integrate(model, options("Generalized-alpha", 0.3, 1e-3, 0.005), samples);
  EXPECT_EQ(report.integrator, "Generalized-alpha");
  EXPECT_EQ(report.size, 6);
  EXPECT_GE(report.counters.newtonIterations, report.counters.steps / 2);
  EXPECT_GE(report.counters.factorisations, 2);
  EXPECT_GT(report.wall, 0);
  EXPECT_GT(report.cpu, 0);
  EXPECT_NEAR(report.realTimeFactor, 0.3 / report.wall, 1e-6 / report.wall);
  EXPECT_FALSE(report.interrupted);
}

}  // namespace TransientTest
}  // namespace tooljoint::transient::testing
