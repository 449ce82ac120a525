// SPDX-License-Identifier: BSD-3-Clause
// A model at a constant rotary speed: its laws and its rotating loads.
#include "model/SteadyRotation.hpp"

#include <gtest/gtest.h>

#include "model/SpeedLaw.hpp"

namespace tooljoint::model {
namespace SteadyRotationTest {

using Complex = std::complex<double>;

Sparse scalar(double value) {
  Sparse A(1, 1);
  A.insert(0, 0) = value;
  A.makeCompressed();
  return A;
}

/// c' = 3 Omega, k = 5 + 7 cos t, a rotating load proportional to Omega^2, and a constant one.
SecondOrderModel rotor() {
  SecondOrderModel model;
  model.mass = scalar(1.0);
  const int omega = model.lawIndex(
      {"Omega", SpeedLaw{[](double t) { return 100.0 * t; }, [](double w) { return Complex(w); }}});
  const int wave = model.lawIndex({"wave", [](double t) { return 7.0 * t; }});
  const int turns =
      model.lawIndex({"turns", SpeedLaw{[](double) { return 1.0; },
                                        [](double w) { return Complex(w * w, -w * w); }, 1}});
  model.damping.push_back({"gyroscopic", scalar(3.0), omega});
  model.stiffness.push_back({"structure", scalar(5.0), 0});
  model.stiffness.push_back({"wave", scalar(1.0), wave});
  model.loads.push_back({"unbalance", Vector::Constant(1, 2.0), turns});
  model.loads.push_back({"weight", Vector::Constant(1, 9.0), 0});
  return model;
}

TEST(SteadyRotation, LawsOfTheSpeedHaveItsValueAndOthersTheirTime) {
  const auto steady = atSpeed(rotor(), 4.0, true);
  EXPECT_EQ(steady.dampingAt(0.5).coeff(0, 0), 12.0);
  EXPECT_EQ(steady.stiffnessAt(0.5).coeff(0, 0), 8.5);
  EXPECT_EQ(steady.loadAt(0.5)[0], 9.0);  // a rotating load has no mean
  EXPECT_EQ(rotor().dampingAt(0.5).coeff(0, 0), 150.0);
}

TEST(SteadyRotation, TurningLoadsHaveTheirComplexAmplitude) {
  EXPECT_EQ(turningLoad(rotor(), 4.0)[0], Complex(32.0, -32.0));
}

TEST(SteadyRotation, NamesTheLawsOfMatrices) {
  EXPECT_EQ(matrixLaws(rotor(), true), std::vector<std::string>{"Omega"});
  EXPECT_EQ(matrixLaws(rotor(), false), std::vector<std::string>{"wave"});
}

}  // namespace SteadyRotationTest
}  // namespace tooljoint::model
