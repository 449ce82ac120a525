// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Samples of a motion divided among ranks: rank 0 has the samples that one rank would recover.
#include "cases/recording/SampleRecovery.hpp"

#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/Parallel.hpp"
#include "tests/unit/transient/Models.hpp"

namespace tooljoint::cases {
namespace SampleRecoveryTest {

/// Every node between two masses, at a third of the way.
model::SecondOrderModel betweenMasses() {
  constexpr int masses = 41;
  auto model = transient::testing::springChain(masses, 1.0, 0.5, 2e4);
  model.componentNames = {"u"};
  Triplets entries;
  for (int i = 0; i + 1 < masses; ++i) {
    entries.emplace_back(i, i, 2.0 / 3.0);
    entries.emplace_back(i, i + 1, 1.0 / 3.0);
    model.recoveryNodes.push_back(i + 1);
  }
  model.recovery = Sparse(masses - 1, masses);
  model.recovery.setFromTriplets(entries.begin(), entries.end());
  model.recoveryOffset = Vector::LinSpaced(masses - 1, 1.0, 2.0);
  for (int i = 0; i < masses; ++i) model.initialDisplacement[i] = 0.01 * std::sin(0.3 * i);
  return model;
}

/// Five divided samples per step of 1 ms.
transient::TransientOptions manySamples() {
  auto options = transient::testing::options("Generalized-alpha", 0.01, 1e-3, 2e-4);
  options.ranks = transient::RankUse::Divide;
  transient::testing::acceptCoarseSteps(options);
  return options;
}

void expectNear(const Vector& a, const Vector& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_LE((a - b).cwiseAbs().maxCoeff(), 1e-14 * b.cwiseAbs().maxCoeff());
}

/// Both ways of the same samples.
class Both final : public transient::ShareSink {
 public:
  explicit Both(const model::SecondOrderModel& model) : model_(model), gathered_(model) {}
  void sample(double, const Vector&, const Vector&, const Vector&) override { ++alike; }
  void sampleShare(const transient::SampleShare& mine) override {
    Vector q, v, a;
    mine.share.gather(mine.q, q);
    mine.share.gather(mine.qDot, v);
    mine.share.gather(mine.qDDot, a);
    const auto sample = gathered_.gather(mine);
    ++divided;
    ASSERT_EQ(sample.has_value(), parallel::rank() == 0);
    if (!sample) return;
    EXPECT_EQ(sample->q, q);
    EXPECT_EQ(sample->qDot, v);
    expectNear(sample->displacement, model_.recoveryOffset + model_.recovery * q);
    expectNear(sample->velocity, model_.recovery * v);
    expectNear(sample->acceleration, model_.recovery * a);
  }
  int alike = 0, divided = 0;

 private:
  const model::SecondOrderModel& model_;
  SampleRecovery gathered_;
};

TEST(SampleRecovery, RankZeroHasTheSamplesOfADividedMotion) {
  const auto model = betweenMasses();
  Both sink(model);
  integrate(model, manySamples(), sink);
  const bool one = parallel::size() == 1;
  EXPECT_EQ(sink.alike, one ? 51 : 0);
  EXPECT_EQ(sink.divided, one ? 0 : 51);
}

/// Rank 0 cannot store samples; the next samples of the step still reach all ranks.
class FullDisk final : public transient::ShareSink {
 public:
  explicit FullDisk(const model::SecondOrderModel& model) : recovery_(model) {}
  void sample(double t, const Vector&, const Vector&, const Vector&) override { keep(t); }
  void sampleShare(const transient::SampleShare& mine) override {
    if (const auto sample = recovery_.gather(mine)) keep(sample->t);
  }

 private:
  static void keep(double t) {
    if (t > 0.0041) throw FileError("No space is left after " + std::to_string(t) + " s.");
  }
  SampleRecovery recovery_;
};

TEST(SampleRecovery, AnErrorOfRankZeroIsThrownOnAll) {
  const auto model = betweenMasses();
  FullDisk disk(model);
  std::string sentence;
  try {
    integrate(model, manySamples(), disk);
  } catch (const FileError& error) {
    sentence = error.what();
  }
  EXPECT_EQ(sentence, "No space is left after 0.004200 s.");
}

}  // namespace SampleRecoveryTest
}  // namespace tooljoint::cases
