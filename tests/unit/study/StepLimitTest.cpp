// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The message of a study that the step, not the basis, limits its reduced runs.
#include "study/StepLimit.hpp"

#include <gtest/gtest.h>

namespace StepLimitTest {

using namespace tooljoint;

study::StudyRow row(study::RunKind kind, bool reduced, double error, long dofs) {
  study::StudyRow out;
  out.plan.kind = kind;
  out.plan.reduced = reduced;
  out.status = "done";
  out.dofs = dofs;
  out.counters.maxStep = 1e-3;
  out.errors = study::PointwiseErrors{error, error, error, error};
  return out;
}

study::StudyRow reduced(double error, long dofs) {
  return row(study::RunKind::Method, true, error, dofs);
}
study::StudyRow full(double error) { return row(study::RunKind::Method, false, error, 100); }
study::StudyRow check(double error) { return row(study::RunKind::Check, false, error, 100); }

/// Messages for rows with the same list Transient.
std::vector<std::string> said(const std::vector<study::StudyRow>& rows) {
  return study::stepLimits(rows, std::vector<std::string>(rows.size(), "1 ms"));
}

TEST(StepLimit, ReducedRunsWithTheErrorOfTheFullOneAreLimitedByTheStep) {
  const auto sentences = said({check(1e-5), full(8e-3), reduced(8.2e-3, 20), reduced(8e-3, 60)});
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0],
            "all 2 reduced runs with steps of 1 ms have a vibration error of 0.8 to 0.82 %, the "
            "full model with these steps 0.8 %: the step limits them, not the basis. Reduce "
            "Transient/Step.");
}

TEST(StepLimit, OneRunThatItsBasisLimitsIsEnoughToSayNothing) {
  EXPECT_TRUE(said({check(1e-5), full(8e-3), reduced(2e-2, 20), reduced(8e-3, 60)}).empty());
  EXPECT_TRUE(said({check(1e-5), full(8e-3), reduced(8e-3, 60)}).empty());
}

TEST(StepLimit, ErrorsNearThatOfTheReferenceProveNothing) {
  EXPECT_TRUE(said({check(4e-3), full(8e-3), reduced(8e-3, 20), reduced(8e-3, 60)}).empty());
}

TEST(StepLimit, WithoutAFullRunErrorsAlikeOfThreeSizesAreTold) {
  const auto alike = said({reduced(8.1e-3, 20), reduced(8e-3, 60), reduced(8e-3, 90)});
  ASSERT_EQ(alike.size(), 1u);
  EXPECT_NE(alike[0].find("with 20 as with 90 dofs"), std::string::npos) << alike[0];
  EXPECT_TRUE(said({reduced(9e-3, 20), reduced(8e-3, 60), reduced(8e-3, 90)}).empty());
  EXPECT_TRUE(said({reduced(8e-3, 20), reduced(8e-3, 20), reduced(8e-3, 20)}).empty());
}

TEST(StepLimit, RunsWithOtherStepsAreApart) {
  const std::vector<study::StudyRow> rows{full(8e-3), reduced(8e-3, 20), reduced(8e-3, 60),
                                          full(1e-3), reduced(8e-3, 20), reduced(2e-3, 60)};
  EXPECT_EQ(study::stepLimits(rows, {"a", "a", "a", "b", "b", "b"}).size(), 1u);
}

}  // namespace StepLimitTest
