// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Steady cutting with the delay of a pitch, assessed against the roots of its characteristic
/// equation: its states held, the slope of the surface turns the bit as a spring of the wrong sign.
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "model/laws/RegenerativeCutting.hpp"
#include "stability/StateStability.hpp"

namespace FollowingStatesTest {

using namespace tooljoint;
using Pair = Eigen::Matrix2d;

/// A bit of mass m on a spring k, of inertia J on a torsional spring kappa; dampers c, gamma.
struct Bit {
  double c, kappa, gamma, advance, speed;
  static constexpr double m = 2e4, k = 2e6, J = 200.0;

  static model::CuttingParameters blades() {
    model::CuttingParameters p;
    p.blades = 4;
    p.radius = 0.1;
    p.specificEnergy = 30e6;
    p.inclination = 0.6;
    return p;
  }
  static Pair diagonal(double axial, double torsional) {
    return Eigen::Vector2d(axial, torsional).asDiagonal();
  }

  model::SecondOrderModel model() const {
    model::SecondOrderModel bit;
    bit.componentNames = {"w", "theta_z"};
    for (int i = 0; i < 2; ++i) bit.dofs.push_back(model::DofLabel::physical(1, i));
    bit.mass = diagonal(m, J).sparseView();
    bit.damping.push_back({"damping", diagonal(c, gamma).sparseView(), 0});
    bit.stiffness.push_back({"stiffness", diagonal(k, kappa).sparseView(), 0});
    bit.initialDisplacement = Vector::Zero(2);
    bit.initialVelocity = Vector::Zero(2);
    model::PointSet set;
    set.name = "bit";
    set.law = std::make_shared<model::FormulaLaw<model::RegenerativeCutting>>(
        model::RegenerativeCutting(blades()), 1);
    set.rows = Pair::Identity().sparseView();
    set.offset = Vector::Zero(2);
    bit.points.push_back(set);
    bit.initialVelocity = Eigen::Vector2d(advance, speed);
    return bit;
  }

  /// det(s^2 M + s C + K + (1 - e^{-s tau}) [A; B] [1, -V/Omega]) over det(s^2 M + s C + K).
  double residual(Complex s) const {
    const auto p = blades();
    const double A = p.blades * p.radius * p.inclination * p.specificEnergy,
                 B = 0.5 * p.blades * p.radius * p.radius * p.specificEnergy;
    const double tau = constants::twoPi / p.blades / speed;
    const Complex delayed = 1.0 - std::exp(-s * tau);
    const Complex axial = A / (s * s * m + s * c + k),
                  torsional = B * advance / speed / (s * s * J + s * gamma + kappa);
    return std::abs(1.0 + delayed * (axial - torsional));
  }
};

Complex growth(const stability::StateStability& found) {
  return {found.growthRate, constants::twoPi * found.frequency};
}

/// States held: s = 0.453, a divergence. The rightmost root is -0.199 + 1.333 i.
TEST(FollowingStates, ThatStopAGrowthOfHeldOnes) {
  const Bit bit{4e4, 600.0, 400.0, 0.1, 16.0};
  const auto found = stability::assess(bit.model(), 0.0);
  EXPECT_LT(bit.residual({-0.19921, 1.33275}), 1e-3);
  EXPECT_TRUE(found.stable()) << found.growthRate;
  EXPECT_EQ(found.held, std::vector<std::string>{"bit"});
}

/// States held: 1.400, a divergence; the true root is a vibration at 0.377 + 0.925 i. In the second
/// case all modes decay with held states; the true root grows at 0.016 + 3.484 i.
TEST(FollowingStates, GiveTheGrowthOfTheirOwn) {
  for (const auto& [bit, rate] : {std::pair{Bit{1e4, 300.0, 100.0, 0.1, 16.0}, 0.37654},
                                  std::pair{Bit{1e4, 3000.0, 100.0, 0.1, 16.0}, 0.01623}}) {
    const auto found = stability::assess(bit.model(), 0.0);
    ASSERT_FALSE(found.stable()) << rate;
    EXPECT_NEAR(found.growthRate, rate, 1e-4 * rate + 1e-5);
    EXPECT_LT(bit.residual(growth(found)), 1e-5) << rate;
    EXPECT_TRUE(found.refined);
  }
}

}  // namespace FollowingStatesTest
