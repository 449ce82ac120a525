// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Dependent coordinates do not respond to a residual: estimates treat their vectors as truncated.
#include <algorithm>
#include <cmath>
#include <gtest/gtest.h>

#include "estimate/FrequencyEstimate.hpp"
#include "tests/support/CoupledChecks.hpp"
#include "tests/support/SampleParts.hpp"

namespace TiedCoordinatesTest {

using namespace tooljoint;

TEST(TiedCoordinates, EstimatesStayNearTheTrueErrors) {
  const auto parts = samples::loopFrame(10, false);
  const Vector full = checks::eigenvalues(coupling::couple(parts));
  for (const std::string choice : {"Tied", "Free"}) {
    const auto synthesis = checks::synthesise(
        parts, "Enhanced Craig-Bampton", 2,
        [&](Teuchos::ParameterList& list) { list.set("Residual Coordinates", choice); });
    const Vector coupled = checks::eigenvalues(synthesis.coupled.model);
    estimate::FrequencyWindow window;
    window.count = 6;
    const auto estimates = estimate::estimateFrequencies(parts, synthesis, window);
    ASSERT_EQ(estimates.size(), 6u);
    int counted = 0;
    for (std::size_t k = 0; k < estimates.size(); ++k) {
      const auto i = static_cast<Eigen::Index>(k);
      const double error = std::sqrt(coupled[i] / full[i]) - 1;
      if (error < 1e-9) continue;  // rounding of what is compared
      ++counted;
      EXPECT_LT(estimates[k].error, 3 * error) << choice << ", mode " << k + 1;
      EXPECT_GT(3 * estimates[k].error, error) << choice << ", mode " << k + 1;
    }
    EXPECT_GE(counted, 3) << choice;
  }
}

/// A velocity of the interior leaves the boundary at rest, even with dependent coordinates.
TEST(TiedCoordinates, KeepTheBoundaryOfTheStart) {
  auto parts = samples::loopFrame(10, false);
  for (auto& part : parts) part.model.initialVelocity.setZero();
  parts[0].model.initialVelocity[parts[0].interior().front()] = 0.01;
  const auto synthesis = checks::synthesise(parts, "Enhanced Craig-Bampton", 2, [](auto& list) {
    list.set("Residual Coordinates", std::string("Tied"));
  });
  const auto& model = synthesis.coupled.model;
  ASSERT_GT(synthesis.coupled.dependent, 0);
  EXPECT_GT(model.initialVelocity.norm(), 0.0);
  for (int i = 0; i < model.size(); ++i)
    if (model.dofs[static_cast<std::size_t>(i)].kind == model::DofLabel::Kind::Physical) {
      EXPECT_EQ(model.initialVelocity[i], 0.0) << i;
    }
}

}  // namespace TiedCoordinatesTest
