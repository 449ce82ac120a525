// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A run restarted from a checkpoint takes the same steps as an uninterrupted run, bitwise: every
/// integrator, stopped at many times, twice in a row, on models that depend on all contents of a
/// checkpoint.
#include <functional>
#include <gtest/gtest.h>
#include <optional>

#include "StatefulModels.hpp"
#include "common/Error.hpp"

namespace tooljoint::transient::testing {
namespace RestartTest {

/// A run and its results.
struct Outcome {
  Keep samples;
  TransientReport report;
  std::string error;             ///< if it was refused
  std::vector<Checkpoint> kept;  ///< the first one and the last one, at most
};

/// Runs from `from`, or from the start; stops after this many steps.
Outcome run(const model::SecondOrderModel& model, const TransientOptions& options,
            const Checkpoint* from = nullptr, long stopAfter = -1) {
  Outcome out;
  RunHooks hooks;
  hooks.resume = from;
  long calls = 0;
  hooks.stop = [&] { return stopAfter >= 0 && ++calls > stopAfter; };
  hooks.keep = [&](const Checkpoint& point) {
    if (out.kept.size() > 1) out.kept.pop_back();
    out.kept.push_back(point);
  };
  try {
    out.report = integrate(model, options, out.samples, hooks);
  } catch (const ConvergenceError& error) {
    out.error = error.what();
  }
  return out;
}

/// As written to a file and read again.
Checkpoint reread(const Checkpoint& point) { return Checkpoint::decode(point.encode(), "a test"); }

void expectSameSamples(const Keep& whole, const Keep& later, std::size_t from,
                       const std::string& where) {
  ASSERT_EQ(from + later.time.size(), whole.time.size()) << where;
  for (std::size_t i = 0; i < later.time.size(); ++i) {
    ASSERT_EQ(later.time[i], whole.time[from + i]) << where;
    ASSERT_EQ(later.q[i], whole.q[from + i]) << where << ", sample " << i;
    ASSERT_EQ(later.v[i], whole.v[from + i]) << where << ", sample " << i;
    ASSERT_EQ(later.a[i], whole.a[from + i]) << where << ", sample " << i;
  }
}

void expectSameReport(const TransientReport& whole, const TransientReport& later,
                      const std::string& where) {
  const auto &a = whole.counters, &b = later.counters;
  EXPECT_EQ(a.steps, b.steps) << where;
  EXPECT_EQ(a.rejected, b.rejected) << where;
  EXPECT_EQ(a.halved, b.halved) << where;
  EXPECT_EQ(a.newtonIterations, b.newtonIterations) << where;
  EXPECT_EQ(a.unconvergedSteps, b.unconvergedSteps) << where;
  EXPECT_EQ(a.factorisations, b.factorisations) << where;
  EXPECT_EQ(a.rightHandSides, b.rightHandSides) << where;
  EXPECT_EQ(a.strategies, b.strategies) << where;
  EXPECT_EQ(a.minStep, b.minStep) << where;
  EXPECT_EQ(a.maxStep, b.maxStep) << where;
  EXPECT_EQ(whole.contactEvaluations, later.contactEvaluations) << where;
  EXPECT_EQ(whole.samples, later.samples) << where;
  EXPECT_EQ(whole.end, later.end) << where;
  EXPECT_EQ(whole.stepError, later.stepError) << where;
  const auto &e = whole.energy, &f = later.energy;
  for (const auto& [x, y] : {std::pair(e.kinetic, f.kinetic),
                             {e.strain, f.strain},
                             {e.contact, f.contact},
                             {e.initial, f.initial},
                             {e.loads, f.loads},
                             {e.drive, f.drive},
                             {e.friction, f.friction},
                             {e.contactDamping, f.contactDamping},
                             {e.circulatory, f.circulatory},
                             {e.exchanged, f.exchanged},
                             {e.supplied, f.supplied}})
    EXPECT_EQ(x, y) << where;
  EXPECT_EQ(e.damping, f.damping) << where;
}

/// Stops after this many steps, continues, stops after as many again, continues to the end.
void expectSameAfterStopping(const model::SecondOrderModel& model, const TransientOptions& options,
                             const Outcome& whole, long steps) {
  const std::string where = "stopped after " + std::to_string(steps) + " steps";
  auto first = run(model, options, nullptr, steps);
  if (!first.report.interrupted) return;
  ASSERT_FALSE(first.kept.empty()) << where;
  auto point = reread(first.kept.back());
  auto second = run(model, options, &point, steps);
  if (second.report.interrupted) {
    const auto middle = static_cast<std::size_t>(point.samples);
    for (std::size_t i = 0; i < second.samples.time.size(); ++i)
      ASSERT_EQ(second.samples.q[i], whole.samples.q[middle + i]) << where;
    if (!second.kept.empty()) point = reread(second.kept.back());
    second = run(model, options, &point);
  }
  EXPECT_FALSE(second.report.interrupted) << where;
  expectSameSamples(whole.samples, second.samples, static_cast<std::size_t>(point.samples), where);
  expectSameReport(whole.report, second.report, where);
}

/// Stiffness and damping of two terms each whose law is constant in the second half of the run:
/// products then use the sum of the terms, which rounds differently.
model::SecondOrderModel spinUp() {
  auto model = springChain(7, 1.3, 0.7, 211.0);
  const int law = model.lawIndex({"ramp", [](double t) { return std::min(1.0, t / 0.15); }});
  Matrix skew = Matrix::Zero(7, 7), more = Matrix::Zero(7, 7);
  for (int i = 1; i < 7; ++i) skew(i, i - 1) = 0.37, skew(i - 1, i) = -0.37, more(i, i) = 31.7 / i;
  model.damping.push_back({"spin", skew.sparseView(), law});
  model.stiffness.push_back({"stiffening", more.sparseView(), law});
  model.loads.push_back({"pull", Vector::LinSpaced(7, 1.0, 3.3), law});
  addFloor(model, 3e3, 1.0, 3e3);
  return model;
}

/// Walls so stiff that contacts are impacts, which are part of the memory of points and scheme.
model::SecondOrderModel impacts() { return droppedBalls(5, 1e9, 0, 7e11, 2e5); }

/// wayToStep() with checkpoints.
TransientOptions keeping(const std::string& way, double end) {
  auto o = wayToStep(way, end);
  o.checkpointInterval = 0.07;
  return o;
}

class Restart : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    try {
      IntegratorRegistry::instance().make(options().integrator, options().own)->checkParameters(0);
    } catch (const DeckError& error) {
      GTEST_SKIP() << error.what();  // built without SUNDIALS
    }
  }
  static TransientOptions options(double end = 0.3) { return keeping(GetParam(), end); }
  void expectSameWherever(const model::SecondOrderModel& model, const TransientOptions& o) {
    const auto whole = run(model, o);
    ASSERT_TRUE(whole.error.empty()) << whole.error;
    for (const double part : {0.0, 0.13, 0.31, 0.52, 0.77, 0.96})
      expectSameAfterStopping(
          model, o, whole,
          static_cast<long>(part * static_cast<double>(whole.report.counters.steps)));
  }
};

TEST_P(Restart, takesTheSameSteps) {
  expectSameWherever(eventful(), options());
  const auto whole = run(eventful(), options());
  const bool isMeasured = GetParam() == "Generalized-alpha" || GetParam() == "RK4";
  EXPECT_EQ(whole.report.stepError > 0.0, isMeasured);
}
TEST_P(Restart, takesTheSameStepsOnceTheLawsStandStill) { expectSameWherever(spinUp(), options()); }
TEST_P(Restart, takesTheSameStepsAmongImpacts) {
  auto o = options(0.15);
  if (GetParam() == "RK4") o.step = 1e-5;
  acceptCoarseSteps(o);
  expectSameWherever(impacts(), o);
}

/// Rated and held states, together with impacts.
TEST_P(Restart, carriesTheStatesOfPointLaws) {
  const auto integrator = IntegratorRegistry::instance().make(options().integrator, options().own);
  ASSERT_TRUE(integrator->carriesPointStates());
  for (auto model : {eventful(), impacts()}) {
    addStatefulLaws(model);
    auto o = options(0.15);
    if (GetParam() == "RK4") o.step = 1e-5;
    acceptCoarseSteps(o);
    expectSameWherever(model, o);
    const auto point = run(model, o).kept.back();
    EXPECT_GT(point.state.x.cwiseAbs().minCoeff(), 0.0);
    if (!integrator->goesOnFromAnywhere()) continue;  // keeps nothing when it is stopped
    EXPECT_EQ(run(model, o, &point, 0).kept.back().memory, point.memory);
  }
}

/// A restarted run that is stopped at once writes the checkpoint it started from: no data are lost.
TEST_P(Restart, hasTheMemoryOfItsCheckpoint) {
  for (const auto& model : {eventful(), spinUp(), impacts()}) {
    auto o = options(0.15);
    if (GetParam() == "RK4") o.step = 1e-5;
    acceptCoarseSteps(o);
    if (!IntegratorRegistry::instance().make(o.integrator, o.own)->goesOnFromAnywhere())
      GTEST_SKIP() << "keeps nothing when it is stopped";
    for (long steps = 1; steps < 200; steps += 9) {
      const auto point = run(model, o, nullptr, steps).kept.back();
      const auto again = run(model, o, &point, 0).kept.back();
      ASSERT_EQ(again.memory.size(), point.memory.size());
      for (std::size_t i = 0; i < point.memory.size(); ++i)
        ASSERT_EQ(again.memory[i], point.memory[i])
            << "entry " << i << " of " << point.memory.size() << ", stopped after " << steps;
    }
  }
}

/// A killed run continues from its last checkpoint, whatever it did afterwards.
TEST_P(Restart, goesOnFromAnEarlierCheckpoint) {
  const auto whole = run(eventful(), options());
  ASSERT_EQ(whole.kept.size(), 2u);
  for (const auto& kept : whole.kept) {
    const auto point = reread(kept);
    const auto later = run(eventful(), options(), &point);
    expectSameSamples(whole.samples, later.samples, static_cast<std::size_t>(point.samples),
                      "a checkpoint");
    expectSameReport(whole.report, later.report, "a checkpoint");
  }
}

INSTANTIATE_TEST_SUITE_P(Transient, Restart,
                         ::testing::Values("Generalized-alpha", controlledAlpha, "RK4",
                                           "RK4 adaptive", "SUNDIALS ARKODE", "SUNDIALS CVODE"),
                         [](const auto& tested) {
                           std::string name;
                           for (const char c : tested.param)
                             if (std::isalnum(static_cast<unsigned char>(c)) != 0) name += c;
                           return name;
                         });

/// If Newton's method fails, steps are halved; a run stopped within such a step continues with its
/// halves.
TEST(Restarts, keepTheHalvingsOfAStepUnderWay) {
  auto model = droppedBalls(6, 1e6, 2e3, 7e11, 1e5);
  auto o = options("Generalized-alpha", 0.06, 2e-3, 0.01);
  o.own.set("Max Iterations", 2);
  o.own.set("Max Halvings", 8);
  acceptCoarseSteps(o);
  o.own.set("Resolve Impacts", false);
  const auto whole = run(model, o);
  ASSERT_TRUE(whole.error.empty()) << whole.error;
  ASSERT_GT(whole.report.counters.halved, 0);
  int within = 0;
  for (long steps = 1; steps < whole.report.counters.steps; ++steps) {
    const auto stopped = run(model, o, nullptr, steps);
    const double full = stopped.report.end / 2e-3;
    within += std::abs(full - std::round(full)) > 1e-6 ? 1 : 0;
    expectSameAfterStopping(model, o, whole, steps);
  }
  EXPECT_GT(within, 3);
}

/// A run that is stopped during the comparison with shorter steps is not finished.
TEST(Restarts, compareStepsWhereThatWasStopped) {
  const auto model = oscillator(1.0, 0.0, 100.0, 0.1, 0.0);
  auto o = options("Generalized-alpha", 2.0, 4e-2, 0.2);
  o.stepErrorWarning = 1e-3;  // steps with damping above a fifth of it are compared
  const auto whole = run(model, o);
  ASSERT_TRUE(whole.error.empty()) << whole.error;
  ASSERT_GT(whole.report.stepError, 0.0);
  for (const long compared : {0L, 1L, 33L}) {
    const long steps = whole.report.counters.steps + compared;
    EXPECT_TRUE(run(model, o, nullptr, steps).report.interrupted) << compared;
    expectSameAfterStopping(model, o, whole, steps);
  }
}

/// A step controlled by its error waits before it grows: a restart continues the wait.
TEST(Restarts, keepTheWaitOfStepControl) {
  const auto model = eventful();
  auto o = keeping(controlledAlpha, 0.1);
  o.step = 5e-3;
  o.own.set("Step Tolerance", 1e-6);
  const auto whole = run(model, o);
  ASSERT_GT(whole.report.counters.rejected, 0);
  ASSERT_GT(whole.report.counters.maxStep, whole.report.counters.minStep);
  for (long steps = 1; steps < whole.report.counters.steps; steps += 3)
    expectSameAfterStopping(model, o, whole, steps);
}

/// Generates energy: the force is larger on the way out than on the way in.
class Spender final : public model::PointLaw {
 public:
  int size() const override { return 1; }
  int width() const override { return 1; }
  void evaluate(double, const std::vector<int>& active, const double*, const double* v,
                double* f) const override {
    for (int p : active) f[p] = 2.0 * v[p];
  }
  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override {
    evaluate(t, active, d, v, f);
    for (int p : active) dfdd[p] = 0, dfdv[p] = 2.0;
  }
  void clearanceLeft(const std::vector<int>& points, const double*, double* gap) const override {
    for (int p : points) gap[p] = 0;
  }
  Power power(double, const std::vector<int>&, const double*, const double*) const override {
    return {};
  }
  std::vector<model::Channel> channels() const override { return {}; }
  void record(double, const double*, const double*, double*) const override {}
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>&) const override {
    return nullptr;
  }
};

/// A run that generates energy is refused after some consecutive samples; a restart continues the
/// count.
TEST(Restarts, keepTheWatchForRunawayEnergy) {
  auto model = oscillator(1.0, 0.0, 100.0, 0.1, 0.0);
  model::PointSet set;
  set.name = "spender";
  set.law = std::make_shared<Spender>();
  set.rows.resize(1, 1);
  set.rows.setIdentity();
  set.offset = Vector::Zero(1);
  set.entities = {1};
  model.points.push_back(set);
  const auto o = options("Generalized-alpha", 20.0, 1e-3, 0.01);
  const auto whole = run(model, o);
  ASSERT_NE(whole.error.find("J without work being done"), std::string::npos) << whole.error;
  int counting = 0;
  for (long steps = 20; run(model, o, nullptr, steps).error.empty(); steps += 30) {
    const auto point = reread(run(model, o, nullptr, steps).kept.back());
    counting += point.runawaySamples > 0 ? 1 : 0;
    EXPECT_EQ(run(model, o, &point).error, whole.error) << "stopped after " << steps << " steps";
  }
  EXPECT_GT(counting, 0);
}

/// A sum of terms with constant laws rounds differently from its single terms: a restart uses the
/// same form.
TEST(Restarts, keepHowSumsAreFormed) {
  const auto source = spinUp();
  const Vector x = Vector::LinSpaced(7, 0.137, 1.731);
  const auto products = [&x](CompiledModel& model) {
    Vector y = Vector::Zero(14);
    model.addStiffness(x.data(), y.data());
    model.addDamping(x.data(), y.data() + 7);
    return y;
  };
  CompiledModel formed(source), unformed(source), restored(source);
  formed.setTime(0.2);
  formed.setTime(0.3);
  unformed.setTime(0.3);
  const Vector expected = products(formed);
  ASSERT_NE(products(unformed), expected);
  for (CompiledModel* model : {&formed, &unformed}) {
    std::vector<double> memory;
    model->timed().save(memory);
    const double* at = memory.data();
    restored.timed().restore(at);
    EXPECT_EQ(at, memory.data() + memory.size());
    EXPECT_EQ(restored.timed().time(), 0.3);
    EXPECT_EQ(products(restored), products(*model));
  }
}

/// SUNDIALS begins anew at each checkpoint, so the times of checkpoints change the result, within
/// the tolerance.
TEST(Restarts, ofSundialsDependOnTheIntervalToTheTolerance) {
  for (const auto& integrator : {"SUNDIALS ARKODE", "SUNDIALS CVODE"}) {
    auto o = options(integrator, 0.3, 0, 0.005);
    o.own.set("Relative Tolerance", 1e-7);
    Outcome once, often;
    try {
      once = run(springChain(4, 1, 0.1, 100), o);
    } catch (const DeckError& error) {
      GTEST_SKIP() << error.what();
    }
    auto model = springChain(4, 1, 0.1, 100);
    model.initialVelocity.setConstant(1.0);
    once = run(model, o);
    o.checkpointInterval = 0.05;
    often = run(model, o);
    double difference = 0, size = 0;
    for (std::size_t i = 0; i < once.samples.q.size(); ++i) {
      difference =
          std::max(difference, (once.samples.q[i] - often.samples.q[i]).cwiseAbs().maxCoeff());
      size = std::max(size, once.samples.q[i].cwiseAbs().maxCoeff());
    }
    EXPECT_GT(difference, 0.0) << integrator;
    EXPECT_LT(difference, 1e-4 * size) << integrator;
  }
}

}  // namespace RestartTest
}  // namespace tooljoint::transient::testing
