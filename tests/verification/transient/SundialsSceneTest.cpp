// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// ARKODE and CVODE against RK4 adaptive on the full model of the reference scene.
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "tests/support/Scenes.hpp"

namespace tooljoint::transient::testing {
namespace SundialsSceneTest {

using namespace testing_;

const std::vector<std::string> common = {"Transient/End Time=0.2", "Transient/Progress=false",
                                         "Transient/Energy Ledger=false"};

std::vector<Vector> motion(const model::SecondOrderModel& model,
                           std::vector<std::string> overrides) {
  overrides.insert(overrides.end(), common.begin(), common.end());
  return move(reference(overrides), model);
}

TEST(SundialsScene, theReferenceSceneMovesAsWithRungeKutta) {
  const auto scene = reference(common);
  const auto model = drillstring::fullModel(drillstring::solveStatic(scene));
  // eps0 = 1e-2 has an error below 1e-4 of the vibration, far below the compared differences.
  const auto exact = motion(model, {"Transient/Integrator=RK4 adaptive", "Transient/Step=1e-5"});
  ASSERT_EQ(exact.size(), 41u);
  std::vector<std::vector<Vector>> found;
  try {
    for (const char* name : {"ARKODE", "CVODE"})
      for (const char* tolerance : {"1e-3", "1e-5"})
        found.push_back(motion(
            model, {"Transient/Integrator=SUNDIALS " + std::string(name),
                    "Transient/SUNDIALS " + std::string(name) + "/Relative Tolerance=" + tolerance,
                    "Transient/Step=1e-6"}));
  } catch (const DeckError& error) {
    if (std::string(error.what()).find("built without SUNDIALS") == std::string::npos) throw;
    GTEST_SKIP() << error.what();
  }
  for (std::size_t i = 0; i < found.size(); i += 2) {
    // The tolerance applies to a step: the error of the motion is below ten tolerances, and
    // decreases with a smaller one.
    EXPECT_LT(testing_::largestError(found[i], exact), 1e-2);
    EXPECT_LT(testing_::largestError(found[i + 1], exact), 1e-4);
    EXPECT_LT(testing_::largestError(found[i + 1], exact),
              0.3 * testing_::largestError(found[i], exact));
  }
}

}  // namespace SundialsSceneTest
}  // namespace tooljoint::transient::testing
