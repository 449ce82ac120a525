// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Modes chosen by a tolerance: it is met, without more modes than needed, and requested numbers
/// are returned; estimates of motions on a frame.
#include "estimate/AdaptiveReduction.hpp"

#include <Teuchos_ParameterList.hpp>
#include <cmath>
#include <cstdio>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "estimate/ModeComparison.hpp"
#include "tests/support/SampleParts.hpp"
#include "transient/Transient.hpp"

namespace AdaptiveReductionTest {

using namespace tooljoint;

std::unique_ptr<reduction::ReductionMethod> craigBampton() {
  return reduction::makeBasis("Craig-Bampton", Teuchos::ParameterList());
}

reduction::ReductionOptions tolerance(double frequency, double motion = 0) {
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::Tolerance;
  options.modes.frequencyTolerance = frequency;
  options.modes.motionTolerance = motion;
  return options;
}

estimate::EstimateOptions lowest(int count) {
  estimate::EstimateOptions options;
  options.frequencies = true;
  options.window.count = count;
  return options;
}

TEST(FrequencyTolerance, IsMetAndTighterOnesTakeMoreModes) {
  const auto parts = samples::loopFrame(16, false);
  const auto full = coupling::couple(parts);
  int before = 0;
  for (double wanted : {1e-1, 1e-2, 1e-3, 1e-4, 1e-6}) {
    const auto outcome =
        estimate::synthesise(parts, *craigBampton(), tolerance(wanted), lowest(10));
    for (const auto& mode : estimate::compareModes(full, parts, outcome.synthesis, 10))
      EXPECT_LE(std::abs(mode.error), wanted);
    EXPECT_GE(outcome.rounds.back().modes, before);
    EXPECT_LE(1.5 * outcome.rounds.back().frequencyError, wanted);
    before = outcome.rounds.back().modes;
    std::printf("%s", estimate::roundTable(outcome.rounds).c_str());
  }
  EXPECT_LT(before, full.size() - 9) << "even the tightest one leaves modes out";
}

/// A small part between two grounds; the request exceeds the number of frequencies of its first
/// reduction.
TEST(FrequencyTolerance, GivesAllFrequenciesThatAreAskedFor) {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 10, 100.0, 1.0, {1}),
                                         samples::bar("right", 11, 8, 90.0, 1.0, {19})};
  for (auto& part : parts) samples::classify(part, {11});
  const auto full = coupling::couple(parts);
  const auto outcome = estimate::synthesise(parts, *craigBampton(), tolerance(0.5), lowest(12));
  ASSERT_GE(outcome.frequencies.size(), 12u);
  for (const auto& mode : estimate::compareModes(full, parts, outcome.synthesis, 12))
    EXPECT_LE(std::abs(mode.error), 0.5);
  // All existing frequencies, and no more.
  const auto all = estimate::synthesise(parts, *craigBampton(), tolerance(0.5), lowest(100));
  EXPECT_EQ(static_cast<int>(all.frequencies.size()), full.size());
}

/// Guyan reduction has masters instead of modes.
TEST(FrequencyTolerance, TakesMoreMastersOfGuyanReduction) {
  std::vector<model::Substructure> parts{samples::bar("left", 1, 30, 100.0, 1.0, {1}),
                                         samples::bar("right", 31, 25, 90.0, 1.0, {56})};
  for (auto& part : parts) samples::classify(part, {31});
  const auto full = coupling::couple(parts);
  const auto guyan = reduction::makeBasis("Guyan", Teuchos::ParameterList());
  int before = 0;
  for (const double allowed : {3e-2, 3e-3}) {
    const auto outcome = estimate::synthesise(parts, *guyan, tolerance(allowed), lowest(4));
    for (const auto& mode : estimate::compareModes(full, parts, outcome.synthesis, 4))
      EXPECT_LE(std::abs(mode.error), allowed);
    const int masters = outcome.synthesis.coupled.model.size() - 1;
    EXPECT_EQ(outcome.rounds.back().modes, masters);
    EXPECT_GT(masters, before);
    EXPECT_LT(masters, full.size());
    before = masters;
  }
}

TEST(FrequencyTolerance, PartsThatDoNotMatterGetNoModes) {
  // A stiff short bar between two soft ones.
  std::vector<model::Substructure> parts{samples::bar("soft", 1, 20, 100.0, 1.0, {1}),
                                         samples::bar("stiff", 21, 20, 1e6, 0.01),
                                         samples::bar("also soft", 41, 20, 90.0, 1.0)};
  samples::classify(parts[0], {21});
  samples::classify(parts[1], {21, 41});
  samples::classify(parts[2], {41});
  const auto outcome = estimate::synthesise(parts, *craigBampton(), tolerance(1e-4), lowest(5));
  EXPECT_LE(outcome.synthesis.parts[1].modes, 2);
  EXPECT_GT(outcome.synthesis.parts[0].modes, 4);
  EXPECT_GT(outcome.synthesis.parts[2].modes, 4);
}

TEST(FrequencyTolerance, OnlyWhatChangesIsReducedAgain) {
  std::vector<model::Substructure> parts;
  for (int p = 0; p < 6; ++p) {
    parts.push_back(samples::bar("bar " + std::to_string(p + 1), 1 + 12 * p, 12, 100.0, 1.0,
                                 p == 0 ? std::vector<int>{1} : std::vector<int>{}));
    std::vector<int> ends;
    if (p > 0) ends.push_back(1 + 12 * p);
    if (p < 5) ends.push_back(13 + 12 * p);
    samples::classify(parts.back(), ends);
  }
  resetEvaluationCounters();
  const auto outcome = estimate::synthesise(parts, *craigBampton(), tolerance(1e-5), lowest(12));
  // Three different bars (first, inner, last), each reduced at most once per number of modes.
  EXPECT_GT(outcome.rounds.size(), 1u);
  EXPECT_LE(counted("parts reduced"), 3 * static_cast<long>(outcome.rounds.size()) + 4);
  EXPECT_LT(counted("parts reduced"), 6 * static_cast<long>(outcome.rounds.size()));
}

TEST(MotionTolerance, NeedsAMotion) {
  EXPECT_THROW(
      estimate::synthesise(samples::loopFrame(6, false), *craigBampton(), tolerance(0, 1e-2), {}),
      DeckError);
}

/// Samples of a motion of recovered dofs.
struct Motion : transient::SampleSink {
  explicit Motion(const model::SecondOrderModel& m, estimate::MotionEstimator* watching = nullptr)
      : model(m), estimator(watching) {}
  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override {
    columns.push_back(model.recoveryOffset + model.recovery * q);
    if (estimator != nullptr) estimator->sample(t, q, qDot, qDDot);
  }
  const model::SecondOrderModel& model;
  estimate::MotionEstimator* estimator;
  std::vector<Vector> columns;
};

/// The frame under a step load on the cantilever's tip, with cubic springs inside two members.
std::vector<model::Substructure> hitFrame(bool spinning) {
  auto parts = samples::loopFrame(12, spinning);
  samples::addCubicSprings(parts[0], {106}, 1e11, 50.0);
  samples::addCubicSprings(parts[2], {303, 306}, 1e11, 50.0);
  Vector tip = Vector::Zero(parts[3].model.size());
  tip[samples::find(parts[3].model, model::DofLabel::physical(5, 1))] = -2e4;
  parts[3].model.loads.push_back({"tip", tip, 0});
  return parts;
}

transient::TransientOptions steps() {
  transient::TransientOptions options;
  options.integrator = "Generalized-alpha";
  options.end = 0.5;
  options.step = 2.5e-4;
  options.sampling = 1e-3;
  options.progress = false;
  options.ledger = false;
  return options;
}

double difference(const std::vector<Vector>& a, const std::vector<Vector>& b) {
  double error = 0, size = 0;
  for (std::size_t i = 0; i < b.size(); ++i)
    for (Eigen::Index row = 0; row < b[i].size(); ++row)
      if (row % 3 < 2) error += std::pow(a[i][row] - b[i][row], 2), size += std::pow(b[i][row], 2);
  return std::sqrt(error / size);
}

// Exception: if a part lacks a mode that the motion excites, its response is not static, and the
// estimate is too large; it is then above 5 %.
TEST(MotionEstimate, IsWithinAFactorOfThreeOnAFrameWithSprings) {
  int counted = 0;
  for (bool spinning : {false, true}) {
    const auto parts = hitFrame(spinning);
    const auto whole = coupling::couple(parts);
    Motion reference(whole);
    transient::integrate(whole, steps(), reference);
    for (int modes : {0, 1, 2, 4, 8}) {
      reduction::ReductionOptions options;
      options.modes.kind = reduction::ModeRule::Kind::PerPart;
      options.modes.counts = {modes};
      const auto synthesis = coupling::synthesise(parts, *craigBampton(), options);
      estimate::MotionEstimator estimator(
          parts, synthesis, Vector::Zero(synthesis.coupled.model.recoveryOffset.size()));
      Motion motion(synthesis.coupled.model, &estimator);
      transient::integrate(synthesis.coupled.model, steps(), motion);
      const double truth = difference(motion.columns, reference.columns);
      const double estimated = estimator.result().error;
      std::printf("%s frame, %d modes: error %.2e, estimated %.2e (%.2f times)\n",
                  spinning ? "spinning" : "still", modes, truth, estimated, estimated / truth);
      EXPECT_GT(estimated, truth / 3.0);
      if (estimated > 0.05) continue;
      EXPECT_LT(estimated, truth * 3.0);
      ++counted;
    }
  }
  EXPECT_GE(counted, 5);
}

TEST(MotionEstimate, IsNothingWithAllModes) {
  const auto parts = hitFrame(true);
  const auto synthesis = coupling::synthesise(parts, *craigBampton(), {});
  estimate::MotionEstimator estimator(parts, synthesis,
                                      Vector::Zero(synthesis.coupled.model.recoveryOffset.size()));
  transient::integrate(synthesis.coupled.model, steps(), estimator);
  EXPECT_EQ(estimator.result().error, 0.0);
}

TEST(WatchMotion, GivesUpWhatIsTooFarOff) {
  const auto parts = hitFrame(false);
  reduction::ReductionOptions options;
  options.modes.kind = reduction::ModeRule::Kind::PerPart;
  options.modes.counts = {1};
  const auto synthesis = coupling::synthesise(parts, *craigBampton(), options);
  const auto& model = synthesis.coupled.model;
  const auto watched = [&](const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(parts, synthesis,
                                        Vector::Zero(model.recoveryOffset.size()));
    return estimate::watchMotion(estimator, model, steps(), limit);
  };
  const auto whole = watched({});
  EXPECT_EQ(whole.reached, 1.0);
  EXPECT_GT(whole.motion, 0.0);
  const auto allowed = watched({1.01 * whole.error, whole.motion});
  EXPECT_EQ(allowed.reached, 1.0);
  EXPECT_EQ(allowed.error, whole.error);
  double before = 1.0;
  for (double part : {0.8, 0.4, 0.1}) {
    const auto stopped = watched({part * whole.error, whole.motion});
    EXPECT_LT(stopped.reached, before) << "the tighter the limit, the earlier";
    EXPECT_GT(stopped.samples, 9);
    EXPECT_GE(stopped.error * std::sqrt(stopped.reached), 0.999 * part * whole.error)
        << "above the limit already";
    EXPECT_LT(stopped.error, 10 * whole.error);
    before = stopped.reached;
  }
}

TEST(MotionTolerance, IsMetAndPartsThatNeedNearlyAllTheirModesStayWhole) {
  const auto parts = hitFrame(false);
  const auto full = coupling::couple(parts);
  Motion reference(full);
  transient::integrate(full, steps(), reference);
  int trials = 0, stopped = 0;
  const estimate::MotionProbe probe = [&](const coupling::Synthesis& synthesis,
                                          const estimate::MotionLimit& limit) {
    estimate::MotionEstimator estimator(
        parts, synthesis, Vector::Zero(synthesis.coupled.model.recoveryOffset.size()));
    const auto estimate = estimate::watchMotion(estimator, synthesis.coupled.model, steps(), limit);
    ++trials;
    if (estimate.reached < 1) ++stopped;
    return estimate;
  };
  for (double wanted : {3e-2, 1e-3, 1e-7}) {
    const auto outcome =
        estimate::synthesise(parts, *craigBampton(), tolerance(0, wanted), {}, probe);
    Motion motion(outcome.synthesis.coupled.model);
    transient::integrate(outcome.synthesis.coupled.model, steps(), motion);
    std::printf("%s", estimate::roundTable(outcome.rounds).c_str());
    EXPECT_LE(difference(motion.columns, reference.columns), wanted);
    EXPECT_LE(outcome.rounds.back().motionError, wanted / 3.0);
    EXPECT_EQ(outcome.rounds.back().reached, 1.0) << "what is taken was looked at to its end";
    if (wanted > 1e-2) {
      EXPECT_LT(outcome.synthesis.coupled.model.size(), full.size());
    }
    if (wanted > 1e-5) continue;
    EXPECT_EQ(outcome.rounds.back().whole, static_cast<int>(parts.size()));
    EXPECT_EQ(outcome.rounds.back().motionError, 0.0);
    EXPECT_EQ(outcome.synthesis.coupled.model.size(), full.size());
  }
  EXPECT_GT(stopped, 0);
  EXPECT_LT(stopped, trials);
}

// An estimate that is not a number, or to which no part contributes, gives modes to every part.
TEST(MotionTolerance, IsNotMetByWhatIsNoNumber) {
  const auto parts = samples::loopFrame(6, false);
  int trials = 0;
  const auto outcome =
      estimate::synthesise(parts, *craigBampton(), tolerance(0, 1e-2), {},
                           [&](const coupling::Synthesis&, const estimate::MotionLimit&) {
                             estimate::MotionEstimate none;
                             none.error = ++trials < 3 ? std::nan("") : 1e-9;
                             none.byPart = Vector::Zero(static_cast<Eigen::Index>(parts.size()));
                             return none;
                           });
  EXPECT_EQ(trials, 3);
  EXPECT_GT(outcome.rounds.back().modes, outcome.rounds.front().modes);
}

}  // namespace AdaptiveReductionTest
