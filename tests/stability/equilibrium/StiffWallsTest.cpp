// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static equilibrium with stiff walls, sharp contact laws or both: a kilometre of string
/// hanging over inclined collars and one lying in an inclined well. It converges to the limit of
/// softer walls; if it cannot, the error states the reason.
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "tests/support/Scenes.hpp"
#include "tests/support/SourceFolder.hpp"

namespace StiffWallsTest {

using namespace tooljoint;

equilibrium::StaticState settled(const std::string& deck,
                                 const std::vector<std::string>& overrides) {
  return drillstring::solveStatic(
             drillstring::readScene(testing_::sourceFolder() + "/xml/" + deck + ".xml", overrides))
      .state;
}

constexpr double tolerance = 1e-9;

/// Nodes with more than a thousandth of all contact force, the error with a wall of 1e8 N/m:
/// whether grazing nodes touch depends on micrometres.
int carrying(const equilibrium::StaticState& state) {
  return static_cast<int>((state.normalForce.array() > 1e-3 * state.totalNormalForce).count());
}

TEST(StiffWalls, AKilometreOfStringComesToRest) {
  const auto soft = settled("vertical_1000m", {"Contact/Stiffness=1e8"});
  for (const char* stiffness : {"1e9", "1e10", "1e11"}) {
    const auto stiff = settled("vertical_1000m", {std::string("Contact/Stiffness=") + stiffness});
    EXPECT_LE(stiff.report.residual, tolerance) << stiffness;
    EXPECT_EQ(carrying(stiff), carrying(soft)) << stiffness;
    // a wall of 1e8 N/m yields 0.03 mm, a thousandth of the clearance: about as much of the forces
    EXPECT_NEAR(stiff.totalNormalForce, soft.totalNormalForce, 1e-2 * soft.totalNormalForce)
        << stiffness;
    // F_n = k_c (G - 1/(pi^2 lambda)) well inside the wall
    const double k = std::stod(stiffness),
                 force = k * (stiff.gap(stiff.maxNormalForceNode - 1) -
                              1.0 / (constants::pi * constants::pi * 7e11));
    EXPECT_NEAR(stiff.maxNormalForce, force, 1e-6 * force) << stiffness;
  }
}

/// Iterations measure the cost: with soft or stiff walls no stage oscillates about its solution.
TEST(StiffWalls, TakeAboutAsManyIterationsAsSoftOnes) {
  for (const char* deck : {"vertical_1000m", "inclined_1000m", "helical_170m"})
    for (const char* stiffness : {"1e7", "1e10"})
      EXPECT_LT(settled(deck, {std::string("Contact/Stiffness=") + stiffness}).report.iterations,
                200)
          << deck << ' ' << stiffness;
}

/// The law of the paper pulls every open point to the wall with k/(pi^2 lambda), here 101 N: it
/// lies on the wall as far as possible.
TEST(StiffWalls, AStringThatTheLawPullsToTheWallComesToRest) {
  const auto state =
      settled("inclined_1000m", {"Contact/Stiffness=1e9", "Contact/Stiffness Regularisation=1e6"});
  EXPECT_LE(state.report.residual, tolerance);
  EXPECT_GT(state.contactNodes, 180);  // number at rest on the wall without pull
  EXPECT_GE(state.normalForce.minCoeff(), -1e9 / (constants::pi * constants::pi * 1e6));
}

/// Friction drives points that the law pulls to the wall in the sense opposite to that of points
/// lying there: with little friction a hanging string still rests, with more it must whirl.
TEST(StiffWalls, AHangingStringThatIsPulledAndTurnedIsReported) {
  const std::vector<std::string> pulled{"Contact/Stiffness Regularisation=1e6",
                                        "Contact/Friction/Dynamic=0.1"};
  auto little = pulled, much = pulled;
  little.push_back("Contact/Friction/Static=0.1");
  EXPECT_LE(settled("vertical_1000m", little).report.residual, tolerance);
  much.push_back("Static/Max Iterations=60");
  try {
    settled("vertical_1000m", much);
    FAIL() << "it rests";
  } catch (const ConvergenceError& error) {
    EXPECT_NE(
        std::string(error.what()).find("attracts every open point to the wall with up to 1.01 N"),
        std::string::npos)
        << error.what();
  }
}

}  // namespace StiffWallsTest
