// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Laws of bit and drive on the string: the frame they are in, steady drilling, gains that match
/// the pipe.
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <memory>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "model/laws/StatefulPointLaw.hpp"
#include "substructures/drilling/BitLaw.hpp"
#include "substructures/drilling/TopDrive.hpp"

namespace {

using namespace tooljoint;
using namespace tooljoint::drilling;

constexpr double speed = 12.0, feed = 2e-3;

loads::RotarySpeed turning() {
  Teuchos::ParameterList own("Constant");
  own.set("Speed", speed);
  return loads::RotarySpeed(loads::SpeedLaws::instance().make("Constant", own));
}

BitSettings bitNamed(const std::string& name, const Teuchos::ParameterList& own) {
  return {name, BitLaws::instance().make(name, own)};
}

BitSettings cutting() {
  Teuchos::ParameterList own("Cutting");
  own.set("Blades", 4).set("Radius", 0.1).set("Specific Energy", 50e6).set("Wear Flat", 1e-3);
  return bitNamed("Cutting", own);
}

BitSettings friction() {
  Teuchos::ParameterList own("Stribeck");
  own.set("Radius", 0.1).set("Viscous Damping", 5.0);
  return bitNamed("Stribeck", own);
}

/// W = n a zeta eps d + n a l sigma, T = n a^2 eps d/2 + n mu gamma a^2 l sigma/2, d = 2 pi V/(n
/// Omega), whatever the time and wherever the bit stands in its frame.
TEST(BitOnString, DrillsSteadilyInTheFrameOfDriveAndBlock) {
  const double d = constants::twoPi * feed / (4 * speed);
  const double W = 4 * 0.1 * (0.6 * 50e6 * d + 1e-3 * 60e6),
               T = 0.5 * 4 * 0.01 * (50e6 * d + 0.6 * 1e-3 * 60e6);
  const auto bit = bitOnString(cutting(), 7, turning(), feed, 0.0);
  EXPECT_EQ(bit.components, (std::vector<int>{2, 5}));
  for (const double t : {0.0, 100.0}) {
    const auto load = steadyLoad(bit, t);
    EXPECT_NEAR(load.weight, W, 1e-6 * W);
    EXPECT_NEAR(load.torque, T, 1e-6 * T);
  }
}

/// T = c Omega + W R [mu_d + (mu_s - mu_d) exp(-Omega/w_s)].
TEST(BitOnString, RubsUnderTheWeightOfTheDeck) {
  const auto bit = bitOnString(friction(), 7, turning(), 0.0, 50e3);
  const auto load = steadyLoad(bit, 3.0);
  EXPECT_EQ(bit.components, std::vector<int>{5});
  EXPECT_EQ(load.weight, 0.0);
  const double T = 5 * speed + 50e3 * 0.1 * (0.5 + 0.3 * std::exp(-speed / 1.1));
  EXPECT_NEAR(load.torque, T, 1e-9 * T);
}

/// f v in the frame is what the drive gives less what the rock takes: T Omega + W V - T (Omega +
/// theta_z') - W (V + w').
TEST(BitOnString, CountsThePowerOfItsFrame) {
  const auto bit = bitOnString(cutting(), 7, turning(), feed, 0.0);
  const auto& law = *model::stateful(*bit.law);
  const std::vector<double> d{-1e-4, 0.3}, v{5e-4, -2.0};
  std::vector<double> x(static_cast<std::size_t>(law.states())), f(2);
  law.initialState(1.0, d.data(), v.data(), x.data());
  const std::vector<double> rates(x.size());
  law.forces(1.0, {0}, d.data(), v.data(), x.data(), f.data(), nullptr);
  const auto p = law.powers(1.0, {0}, d.data(), v.data(), x.data(), rates.data());
  EXPECT_NEAR(p.drive, -f[0] * feed - f[1] * speed, 1e-9 * p.drive);
  EXPECT_NEAR(p.drive - p.friction, f[0] * v[0] + f[1] * v[1], 1e-9 * p.drive);
  EXPECT_GT(p.drive, 1e3);
}

/// zeta = I_p sqrt(rho G) of one pipe; of two pieces of equal length the means of rho I_p and of
/// 1/(G J).
TEST(TopDrive, KnowsTheImpedanceOfThePipe) {
  const beam::Material steel;
  const auto body = beam::Section::hollow(0.0635, 0.054, steel),
             joint = beam::Section::hollow(0.08, 0.045, steel);
  const double zeta = body.polar() * std::sqrt(steel.density * steel.shearModulus());
  EXPECT_NEAR(torsionalImpedance({{body, 9.0}}), zeta, 1e-9 * zeta);
  const double I = body.polar(), K = joint.polar();
  EXPECT_NEAR(torsionalImpedance({{body, 2.0}, {joint, 2.0}}),
              std::sqrt(steel.density * steel.shearModulus() * 0.5 * (I + K) / (0.5 / I + 0.5 / K)),
              1e-9 * zeta);
}

/// (zeta - Z)/(zeta + Z) vanishes at the tuning frequency, Z = k_p + k_i/s + J s.
TEST(TopDrive, ReflectsNothingAtItsFrequency) {
  TopDrive drive;
  drive.control = DriveControl::ImpedanceMatched;
  drive.inertia = 1500.0;
  drive.tuningFrequency = 0.2;
  const double zeta = 340.0;
  drive = tuned(drive, zeta);
  const auto reflected = [&](double frequency) {
    const std::complex<double> s(0.0, constants::twoPi * frequency);
    const auto Z = drive.proportionalGain + drive.integralGain / s + drive.inertia * s;
    return std::abs((zeta - Z) / (zeta + Z));
  };
  EXPECT_LT(reflected(0.2), 1e-12);
  EXPECT_GT(reflected(0.1), 0.5);
  EXPECT_GT(reflected(0.4), 0.5);
}

TEST(TopDrive, RefusesAStaticTorqueAboveItsLimit) {
  TopDrive drive;
  drive.control = DriveControl::Speed;
  drive.proportionalGain = 10.0;
  drive.torqueLimit = 100.0;
  EXPECT_THROW(driveOnString(drive, 101.0), ModelError);
  const auto law = driveOnString(drive, 99.0);
  const double still = 0.0;
  double torque = 0.0;
  law.law->evaluate(0.0, {0}, &still, &still, &torque);
  EXPECT_DOUBLE_EQ(torque, 99.0);
}

}  // namespace
