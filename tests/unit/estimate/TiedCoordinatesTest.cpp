// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Coordinates that follow others answer no residual: estimates count their vectors as left out.
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

}  // namespace TiedCoordinatesTest
