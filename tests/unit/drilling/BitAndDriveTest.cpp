// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Laws of bit and drive on the string: their frame, steady drilling, gains that match the pipe.
#include <algorithm>
#include <cmath>
#include <complex>
#include <gtest/gtest.h>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "model/laws/StatefulPointLaw.hpp"
#include "substructures/drilling/BitLaw.hpp"
#include "substructures/drilling/TopDrive.hpp"

namespace BitAndDriveTest {

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

/// T = W b_0 [tanh(b_1 w) + b_2 w/(1 + b_3 w^2)] at some speeds, odd in w.
TEST(BitOnString, ResistsByASmoothCurve) {
  Teuchos::ParameterList own("Tanh");
  const auto law = bitNamed("Tanh", own).law->make(100e3);
  for (const double w : {0.0, 0.1, 0.43, 3.0, 12.0}) {
    const double still = 0.0,
                 T = 100e3 * 0.0239 * (std::tanh(1.91 * w) + 8.5 * w / (1 + 5.47 * w * w));
    for (const double sign : {1.0, -1.0}) {
      const double speeds = sign * w;
      double f = 0.0;
      law->evaluate(0.0, {0}, &still, &speeds, &f);
      EXPECT_NEAR(f, -sign * T, 1e-9 * 100e3);
    }
  }
}

/// W(v, w) is the inverse of v = Z^2 (a_2 W - a_1) + a_3 Z w, T = v a_4 Z^2/w + a_5 Z; at
/// standstill W has the slope 1/(a_2 Z_0^2).
TEST(BitOnString, PenetratesAsItsWeightSays) {
  Teuchos::ParameterList own("Tucker-Wang");
  const auto law = bitNamed("Tucker-Wang", own).law->make(0.0);
  const double still[2] = {0.0, 0.0};
  for (const double w : {1.0, 5.0, 11.0, -4.0})
    for (const double W : {100e3, 180e3, 250e3}) {
      const double Z = w / std::sqrt(w * w + 4.0);
      const double v = Z * Z * (5.672e-8 * W - 3.429e-3) + 1.374e-4 * Z * w;
      const double rates[2] = {v, w};
      double f[2];
      law->evaluate(0.0, {0}, still, rates, f);
      EXPECT_NEAR(f[0], -W, 1e-9 * W);
      EXPECT_NEAR(f[1], -(v * 9.537e6 * Z * Z / w + 1475.0 * Z), 1e-9 * 1e4);
    }
  double f[2], g[2];
  const double slow[2] = {1e-4, 0.0}, stands[2] = {0.0, 0.0};
  law->evaluate(0.0, {0}, still, slow, f);
  law->evaluate(0.0, {0}, still, stands, g);
  EXPECT_NEAR(g[0] - f[0], 1e-4 / (5.672e-8 * 1e-2), 1e-3);
  EXPECT_EQ(f[1], 0.0);
}

TEST(BitOnString, FindsTheFeedOfAWeight) {
  const auto bit = cutting();
  const double W = 50e3, found = feedFor(bit, turning(), 0.0, W);
  EXPECT_NEAR(steadyLoad(bitOnString(bit, 7, turning(), found, 0.0), 0.0).weight, W, 1e-6 * W);
  EXPECT_THROW(feedFor(bit, turning(), 0.0, 1e12), DeckError);
}

Autodriller driller() {
  Autodriller settings;
  settings.weight = 80e3;
  settings.proportionalGain = 1e-7;
  settings.integralGain = 1e-8;
  settings.lineStiffness = 5e6;
  settings.fastest = 6e-3;
  return settings;
}

/// x' = k_p (W_set - W) + k_i e between 0 and the limit of the block, W = W_0 - k (w - x).
TEST(Autodriller, MovesTheBlockByWhatTheWeightLacks) {
  const auto hook = autodrillerOnString(driller(), feed, -300e3, 70e3);
  const auto& law = *model::stateful(*hook.law);
  ASSERT_EQ(hook.components, std::vector<int>{2});
  ASSERT_EQ(law.states(), 2);
  const double v = 0.0;
  double f = 0.0;
  const auto speedAt = [&](double w, double integral) {
    const double x[2] = {1e-3, integral};
    double g[2];
    law.forces(0.0, {0}, &w, &v, x, &f, g);
    double out[2];
    law.recordState(0.0, &w, &v, x, out);
    EXPECT_NEAR(out[0], 70e3 - 5e6 * (w - 1e-3), 1e-6);
    EXPECT_NEAR(out[1], feed + g[0], 1e-15);
    return g[0];
  };
  EXPECT_NEAR(speedAt(1e-3, 0.0), 1e-7 * 10e3, 1e-15);
  EXPECT_NEAR(f, -300e3, 1e-6);
  EXPECT_NEAR(speedAt(0.0, 3e4), 1e-7 * 5e3 + 1e-8 * 3e4, 1e-12);
  EXPECT_NEAR(f, -300e3 + 5e3, 1e-6);
  EXPECT_NEAR(speedAt(2e-2, 0.0), 6e-3 - feed, 1e-15);
  EXPECT_NEAR(speedAt(-2e-2, 0.0), -feed, 1e-15);
  EXPECT_THROW(autodrillerOnString(driller(), 7e-3, -300e3, 70e3), ModelError);
}

/// f v = drive - d/dt k (w - x)^2/2.
TEST(Autodriller, CountsThePowerOfTheBlock) {
  const auto hook = autodrillerOnString(driller(), feed, -300e3, 70e3);
  const auto& law = *model::stateful(*hook.law);
  const double w = 4e-3, v = 2e-3, x[2] = {1e-3, 5e3}, rates[2] = {1.5e-3, 7.0};
  double f = 0.0, g[2];
  law.forces(0.0, {0}, &w, &v, x, &f, g);
  const auto p = law.powers(0.0, {0}, &w, &v, x, rates);
  const double change = 5e6 * (w - x[0]) * (v - rates[0]);
  EXPECT_NEAR(p.drive - change, f * v, 1e-9 * std::abs(f * v));
  EXPECT_NEAR(p.stored, 0.5 * 5e6 * 9e-6, 1e-9);
}

/// f v in the frame is the power of the drive less that taken by the rock: T Omega + W V - T (Omega
/// + theta_z') - W (V + w').
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

/// Without inertia Z = zeta (1 + w_h/s), so that |r| = w_h/sqrt(w_h^2 + 4 w^2): full reflection at
/// low frequencies, none at high ones.
TEST(TopDrive, HoldsItsSpeedBelowItsHighPass) {
  TopDrive drive;
  drive.control = DriveControl::ImpedanceMatched;
  drive.highPass = 0.05;
  const double zeta = 340.0, corner = constants::twoPi * 0.05;
  drive = tuned(drive, zeta);
  EXPECT_DOUBLE_EQ(drive.proportionalGain, zeta);
  for (const double w : {0.01, 0.3, 1.0, 20.0}) {
    const std::complex<double> s(0.0, w), Z = drive.proportionalGain + drive.integralGain / s;
    EXPECT_NEAR(std::abs((zeta - Z) / (zeta + Z)), corner / std::hypot(corner, 2 * w), 1e-12);
  }
}

/// The band with |r(f)| below one half, and the frequency of least reflection.
TEST(TopDrive, SaysWhichWavesItSendsBack) {
  const double zeta = 340.0;
  struct Drive {
    double kp, ki, J;
    const char* text;
  };
  const double infinite = std::numeric_limits<double>::infinity();
  for (const auto& one : std::vector<Drive>{
           {340, 2368.7, 1500, "sends back 0 % at least, at 0.2 Hz; less than half from 0.18"},
           {680, 2368.7, 1500,
            "sends back 33 % at least, at 0.2 Hz; less than half from 0.178 Hz to"},
           {1360, 2368.7, 1500, "sends back 60 % at least, at 0.2 Hz"},
           {340, 200, 0, "sends back 0 % at least, at high frequencies; less than half above 0.08"},
           {310, 0, 1500,
            "sends back 4.6 % at least, at low frequencies; less than half below 0.0"}}) {
    TopDrive drive;
    drive.control = DriveControl::Speed;
    drive.proportionalGain = one.kp, drive.integralGain = one.ki, drive.inertia = one.J;
    const auto reflected = [&](double frequency) {
      const double w = constants::twoPi * std::clamp(frequency, 1e-9, 1e9);
      const std::complex<double> Z(one.kp, one.J * w - one.ki / w);
      return std::abs((zeta - Z) / (zeta + Z));
    };
    const auto found = waveReflection(tuned(drive, zeta));
    EXPECT_NEAR(reflected(found.frequency), found.least, 1e-6);
    if (found.from < found.to) {
      EXPECT_TRUE(found.from == 0 || std::abs(reflected(found.from) - 0.5) < 1e-9);
      EXPECT_TRUE(found.to == infinite || std::abs(reflected(found.to) - 0.5) < 1e-9);
      EXPECT_LT(reflected(found.to == infinite ? 2 * found.from : 0.5 * (found.from + found.to)),
                0.5);
    } else {
      EXPECT_GE(found.least, 0.5);
    }
    EXPECT_NE(describeWaves(tuned(drive, zeta)).find(one.text), std::string::npos)
        << describeWaves(tuned(drive, zeta));
  }
}

/// 2500 kg m2 resonate with the integral gain of a high-pass of 0.1 Hz at 0.047 Hz.
TEST(TopDrive, WarnsOfAHighPassThatItsInertiaUndoes) {
  TopDrive drive;
  drive.control = DriveControl::ImpedanceMatched;
  drive.highPass = 0.1;
  const auto said = [&](double inertia) {
    const log::Hearing heard;
    drive.inertia = inertia;
    tuned(drive, 340.0);
    return heard.lines().empty() ? std::string() : heard.lines().front();
  };
  EXPECT_EQ(said(0.0), "");
  EXPECT_EQ(said(500.0), "");  // 0.13 Hz
  EXPECT_NE(said(2500.0).find("more than half of all above 0.06"), std::string::npos)
      << said(2500.0);
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

}  // namespace BitAndDriveTest
