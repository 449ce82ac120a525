// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The enhanced Craig-Bampton method against its definition (J.-G. Kim, P.-S. Lee 2015), closed
/// forms, and Craig-Bampton with as many coordinates.
#include <Eigen/Dense>
#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "tests/support/CoupledChecks.hpp"
#include "tests/support/SampleParts.hpp"

namespace EnhancedCraigBamptonTest {

using namespace tooljoint;
using namespace tooljoint::reduction;

Vector omegas(const model::SecondOrderModel& m) { return checks::eigenvalues(m).cwiseSqrt(); }

/// J. L. Humar, Dynamics of Structures, example 19.1: a bar clamped on the left, two components of
/// four consistent elements each.
std::vector<model::Substructure> humarBar() {
  const double l = 1.0 / 8;
  std::vector<model::Substructure> parts{samples::bar("component 1", 0, 4, 1 / l, l, {0}),
                                         samples::bar("component 2", 4, 4, 1 / l, l)};
  samples::classify(parts[0], {4});
  samples::classify(parts[1], {4});
  return parts;
}

// Printed here: T_1 = T_0 + T_a M^-1 K, F_rs, as in (21)-(32) of the paper, formed with numpy and
// scipy on the assembled matrices of the bar; Craig-Bampton from the same script gives
// the 1.57342778 and so on of Humar's example.
TEST(EnhancedCraigBampton, FollowsItsDefinition) {
  const double oneMode[3] = {1.5733210093, 4.7814512631, 8.3127688797};
  const double twoModes[5] = {1.5733208283, 4.7807879966, 8.172356254, 11.8771273161,
                              16.4301540201};
  const Vector one =
      omegas(checks::synthesise(humarBar(), "Enhanced Craig-Bampton", 1).coupled.model);
  const Vector two =
      omegas(checks::synthesise(humarBar(), "Enhanced Craig-Bampton", 2).coupled.model);
  ASSERT_EQ(one.size(), 3) << "no coordinates are added";
  ASSERT_EQ(two.size(), 5);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(one[i], oneMode[i], 1e-9);
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(two[i], twoModes[i], 1e-9);
}

// The bar of eight consistent elements in closed form, omega = sqrt(6 (1 - cos theta) / (2 + cos
// theta)) / l, theta = (2 n - 1) pi / 16: errors fall by two to four orders, as in the tables of
// the paper.
TEST(EnhancedCraigBampton, OrderOfAccuracyAgainstTheClosedForm) {
  const Vector plain = omegas(checks::synthesise(humarBar(), "Craig-Bampton", 2).coupled.model);
  const Vector enhanced =
      omegas(checks::synthesise(humarBar(), "Enhanced Craig-Bampton", 2).coupled.model);
  const double factors[3] = {1e4, 1e2, 1e1};
  for (int n = 1; n <= 3; ++n) {
    const double theta = (2 * n - 1) * constants::pi / 16;
    const double exact = 8 * std::sqrt(6 * (1 - std::cos(theta)) / (2 + std::cos(theta)));
    const double before = plain[n - 1] / exact - 1, after = enhanced[n - 1] / exact - 1;
    EXPECT_GT(after, -1e-12);
    EXPECT_LT(after * factors[n - 1], before) << "mode " << n;
  }
}

/// Largest relative error of the lowest `count` eigenvalues.
double error(const std::vector<model::Substructure>& parts, const std::string& basis, int modes,
             int count, bool free = false) {
  const auto set = [&](Teuchos::ParameterList& list) {
    if (free) list.set("Residual Coordinates", "Free");
  };
  const Vector full = checks::eigenvalues(coupling::couple(parts)),
               small =
                   checks::eigenvalues(checks::synthesise(parts, basis, modes, set).coupled.model);
  return (small.head(count).array() / full.head(count).array() - 1).maxCoeff();
}

// A spring at the joint, as a constant term and under a law of time: M^-1 K contains it.
TEST(EnhancedCraigBampton, ASpringAtTheJointCountsHoweverItIsGiven) {
  const double stiffness = 50.0;
  const auto errorsOf = [&](const std::function<void(model::Substructure&)>& add) {
    auto parts = humarBar();
    add(parts[1]);
    return error(parts, "Enhanced Craig-Bampton", 2, 3);
  };
  const auto spring = [&](model::Substructure& part, int law) {
    Sparse K(part.model.size(), part.model.size());
    K.insert(0, 0) = stiffness;
    part.model.stiffness.push_back({"spring", K, law});
  };
  const double constant = errorsOf([&](auto& part) { spring(part, 0); });
  EXPECT_LT(constant, 1e-3);
  EXPECT_NEAR(errorsOf([&](auto& part) {
                spring(part, part.model.lawIndex({"spring", [](double) { return 1.0; }}));
              }),
              constant, 1e-9);
}

TEST(EnhancedCraigBampton, BeatsCraigBamptonOnAFrameWithALoop) {
  for (const bool retain : {false, true}) {
    const auto parts = samples::loopFrame(10, false, retain);
    for (const int modes : {1, 3, 5})
      EXPECT_LT(error(parts, "Enhanced Craig-Bampton", modes, 4),
                0.1 * error(parts, "Craig-Bampton", modes, 4))
          << modes;
  }
}

// Free coordinates span the space of the tied ones: by Rayleigh and Ritz they are at least as
// accurate.
TEST(EnhancedCraigBampton, FreeCoordinatesAreAtLeastAsGoodAsTiedOnes) {
  const auto parts = samples::loopFrame(10, false);
  for (const int modes : {1, 3, 5})
    EXPECT_LE(error(parts, "Enhanced Craig-Bampton", modes, 6, true),
              error(parts, "Enhanced Craig-Bampton", modes, 6) * (1 + 1e-6) + 1e-12)
        << modes;
}

TEST(EnhancedCraigBampton, TiedCoordinatesAddNoDofs) {
  const auto parts = samples::loopFrame(8, false);
  const auto plain = checks::synthesise(parts, "Craig-Bampton", 3),
             tied = checks::synthesise(parts, "Enhanced Craig-Bampton", 3);
  EXPECT_EQ(tied.coupled.model.size(), plain.coupled.model.size());
  EXPECT_GT(tied.parts[0].modes, plain.parts[0].modes);
  for (std::size_t p = 0; p < parts.size(); ++p)
    EXPECT_EQ(tied.coupled.maps[p].cols(), tied.coupled.model.size());
  tied.coupled.model.validate();
}

TEST(EnhancedCraigBampton, TheStateOfThePartsIsThatOfTheCoupledModel) {
  // recovery of the coupled model and of each part from its coordinates agree for any state
  const auto parts = samples::loopFrame(8, false);
  const auto tied = checks::synthesise(parts, "Enhanced Craig-Bampton", 3);
  const Vector z = Vector::LinSpaced(tied.coupled.model.size(), -1.0, 2.0);
  const Vector whole = tied.coupled.model.recovery * z;
  for (std::size_t p = 0; p < parts.size(); ++p) {
    const Vector part = tied.parts[p].model.recovery * (tied.coupled.maps[p] * z);
    const auto& nodes = tied.parts[p].model.recoveryNodes;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const auto& all = tied.coupled.model.recoveryNodes;
      const auto at = std::find(all.begin(), all.end(), nodes[n]) - all.begin();
      EXPECT_LT(
          (part.segment<3>(3 * static_cast<Eigen::Index>(n)) - whole.segment<3>(3 * at)).norm(),
          1e-9 * (1 + whole.norm()));
    }
  }
}

TEST(EnhancedCraigBampton, UnknownChoiceIsRefused) {
  Teuchos::ParameterList list("Reduction");
  list.sublist("Enhanced Craig-Bampton").set("Residual Coordinates", "Loose");
  EXPECT_THROW(makeBasis("Enhanced Craig-Bampton", list), DeckError);
}

}  // namespace EnhancedCraigBamptonTest
