// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/softstring/SoftString.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <memory>

#include "common/Constants.hpp"
#include "common/Error.hpp"

namespace tooljoint::softstring {
namespace SoftStringTest {

using constants::degree;
using constants::pi;

constexpr double weight = 250.0, radius = 0.08, mu = 0.25, exact = 1e-6;

beam::Section pipe() { return beam::Section::hollow(0.0635, 0.0543, beam::Material{}); }

std::vector<Stretch> stringOf(double length, double w = weight) {
  return {{length, pipe(), w, radius}};
}

Hole holeOf(std::shared_ptr<const well::Trajectory> curve, double friction = mu) {
  Hole hole;
  hole.at = [curve](double s) { return curve->at(s); };
  hole.radius = [](double) { return 0.108; };
  hole.friction = [friction](double) { return friction; };
  hole.breaks = curve->breaks();
  return hole;
}

Operation sliding(double speed, double weightOnBit = 0.0) {
  return {"slide", speed, 0.0, weightOnBit, 0.0};
}
Operation rotating(double weightOnBit = 0.0, double torqueOnBit = 0.0) {
  return {"rotate", 0.0, 12.0, weightOnBit, torqueOnBit};
}

TEST(SoftString, HangsByItsWeight) {
  const auto loads = march(stringOf(1000), holeOf(well::straight(1000)), 1000, sliding(0.3));
  EXPECT_NEAR(loads.tension.back(), weight * 1000, exact * weight * 1000);
  EXPECT_EQ(loads.torque.back(), 0.0);
  // stretch of a bar under its own weight, w L^2/(2 E S)
  const double stretch = weight * 1e6 / (2 * pipe().axialRigidity());
  EXPECT_NEAR(loads.stretching, stretch, exact * stretch);
}

TEST(SoftString, SlidesAndTurnsInAStraightInclinedHole) {
  const double inclination = 60 * degree, length = 2000, wob = 5e4, tob = 4e3;
  const auto hole = holeOf(well::straight(length, inclination, 0.7));
  const double along = weight * length * std::cos(inclination);
  const double drag = mu * weight * length * std::sin(inclination);
  const auto end = [&](const Operation& operation) {
    return march(stringOf(length), hole, length, operation, false);
  };
  EXPECT_NEAR(end(sliding(-0.3)).tension.back(), along + drag, exact * along);
  EXPECT_NEAR(end(sliding(0.3)).tension.back(), along - drag, exact * along);
  EXPECT_NEAR(end(sliding(0.3, wob)).tension.back(), along - drag - wob, exact * along);
  const auto turning = end(rotating(wob, tob));
  EXPECT_NEAR(turning.tension.back(), along - wob, exact * along);
  EXPECT_NEAR(-turning.torque.back(), tob + drag * radius, exact * tob);
  // linear torque: mean of both ends
  const double twist = (tob + 0.5 * drag * radius) * length / pipe().torsionalRigidity();
  EXPECT_NEAR(-turning.twist, twist, exact * twist);
  // both at once: friction is shared as the speeds are
  const Operation reaming{"ream", 0.05, 12.0, 0.0, 0.0};
  const double v = std::hypot(0.05, 12.0 * radius);
  const auto both = end(reaming);
  EXPECT_NEAR(both.tension.back(), along - drag * 0.05 / v, exact * along);
  EXPECT_NEAR(-both.torque.back(), drag * radius * 12.0 * radius / v, exact * drag * radius);
}

/// Without weight, T2 = T1 exp(mu psi) (Euler and Eytelwein), in every plane.
TEST(SoftString, FollowsTheCapstanFormula) {
  const double R = 400, psi = 100 * degree, pull = -1e5;
  for (const double azimuth : {0.0, 1.0, 359 * degree}) {
    const auto curve = well::arc({0, R, 0, psi, azimuth, 0});
    const double length = curve->length();
    const auto loads = march(
        stringOf(length, 0.0),
        holeOf(std::shared_ptr<const well::Trajectory>(well::arc({0, R, 0, psi, azimuth, 0}))),
        length, sliding(-0.3, pull));
    EXPECT_NEAR(loads.tension.back(), -pull * std::exp(mu * psi), exact * -pull);
  }
}

/// dT/da = -w R cos a + sign mu (T - w R sin a) while N = T/R - w sin a > 0 in a build, and its
/// mirror image in a drop: linear equations with the solutions C exp(+-sign mu a) + A sin a + B cos
/// a.
TEST(SoftString, FollowsTheClosedFormsOfBuildAndDrop) {
  const double R = 500, from = 10 * degree, to = 50 * degree, bit = -6e5;
  for (const double sign : {-1.0, 1.0}) {
    const double wR = weight * R, A = -wR * (1 - mu * mu) / (1 + mu * mu),
                 B = sign * 2 * mu * wR / (1 + mu * mu);
    const auto particular = [&](double a) { return A * std::sin(a) + B * std::cos(a); };
    const double build =
        particular(from) + (-bit - particular(to)) * std::exp(sign * mu * (from - to));
    const double length = R * (to - from);
    const auto up =
        march(stringOf(length),
              holeOf(std::shared_ptr<const well::Trajectory>(well::arc({0, R, from, to, 2.0, 0}))),
              length, sliding(0.3 * sign, bit));
    EXPECT_NEAR(up.tension.back(), build, exact * std::abs(build));

    // inclination falls downwards: N = T/R + w sin a, and s runs against a
    const double A2 = wR * (1 - mu * mu) / (1 + mu * mu), B2 = sign * 2 * mu * wR / (1 + mu * mu);
    const auto other = [&](double a) { return A2 * std::sin(a) + B2 * std::cos(a); };
    const double drop = other(to) + (-bit - other(from)) * std::exp(sign * mu * (from - to));
    const auto down =
        march(stringOf(length),
              holeOf(std::shared_ptr<const well::Trajectory>(well::arc({0, R, to, from, 2.0, 0}))),
              length, sliding(0.3 * sign, bit));
    EXPECT_NEAR(down.tension.back(), drop, exact * std::abs(drop));
  }
}

/// On a helix about a vertical axis without weight the curvature is uniform: T exp(mu kappa s).
TEST(SoftString, FollowsAHelix) {
  const double a = 30, turns = 4 * pi, length = 900;
  const std::shared_ptr<const well::Trajectory> curve = well::helix(a, turns, length);
  const double kappa = curve->at(400).curvature.norm();
  const auto loads = march(stringOf(length, 0.0), holeOf(curve), length, sliding(-0.3, -1e5));
  EXPECT_NEAR(loads.tension.back(), 1e5 * std::exp(mu * kappa * length), exact * 1e5);
}

std::vector<well::Station> survey(double turn, bool inserted) {
  const std::vector<well::Station> coarse{{0, 0, turn},
                                          {300, 0, turn},
                                          {700, 30 * degree, turn},
                                          {1100, 55 * degree, 30 * degree + turn},
                                          {1600, 40 * degree, 10 * degree + turn}};
  if (!inserted) return coarse;
  const auto curve = well::minimumCurvature(coarse);
  std::vector<well::Station> fine;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    fine.push_back(coarse[i]);
    if (i + 1 == coarse.size()) break;
    const double s = 0.5 * (coarse[i].depth + coarse[i + 1].depth);
    const Vector3 t = curve->at(s).tangent;
    fine.push_back({s, std::acos(std::clamp(t.z(), -1.0, 1.0)), std::atan2(t.y(), t.x())});
  }
  return fine;
}

TEST(SoftString, KnowsNeitherNorthNorStations) {
  const auto ends = [&](double turn, bool inserted) {
    const std::shared_ptr<const well::Trajectory> curve =
        well::minimumCurvature(survey(turn, inserted));
    const auto out = march(stringOf(1600), holeOf(curve), 1600, sliding(-0.3));
    const auto turning = march(stringOf(1600), holeOf(curve), 1600, rotating(5e4, 3e3));
    return std::make_pair(out.tension.back(), turning.torque.back());
  };
  const auto [tension, torque] = ends(0.0, false);
  for (const double turn : {90 * degree, 345 * degree, 355 * degree}) {
    const auto [turnedTension, turnedTorque] = ends(turn, false);
    EXPECT_NEAR(turnedTension, tension, 1e-8 * tension) << turn;
    EXPECT_NEAR(turnedTorque, torque, 1e-8 * std::abs(torque)) << turn;
  }
  const auto [fineTension, fineTorque] = ends(0.0, true);
  EXPECT_NEAR(fineTension, tension, exact * tension);
  EXPECT_NEAR(fineTorque, torque, exact * std::abs(torque));
}

TEST(SoftString, HangsThePartBelowTheSurface) {
  const std::vector<Stretch> string{{900, pipe(), weight, radius},
                                    {100, pipe(), 4 * weight, radius}};
  const auto hole = holeOf(well::straight(1000));
  EXPECT_NEAR(march(string, hole, 500, sliding(0.3)).tension.back(),
              400 * weight + 100 * 4 * weight, 1e-3);
  EXPECT_NEAR(march(string, hole, 60, sliding(0.3)).tension.back(), 60 * 4 * weight, 1e-3);
  EXPECT_THROW(march(string, hole, 1001, sliding(0.3)), ModelError);
}

/// Horizontal, pushed at the bit with less than the helical limit F* = 2 sqrt(2) sqrt(E I w/r): F
/// grows by mu w to F*, then dF/ds = mu (w + r F^2/(4 E I)), wherever the steps begin.
TEST(SoftString, BucklesIntoAHelixWhereItDoesWithinAStep) {
  const double r = 0.108 - 0.0635, EI = pipe().youngModulus() * pipe().inertiaX();
  const double limit = 2 * std::sqrt(2.0) * std::sqrt(EI * weight / r);
  const double k = std::sqrt(r / (4 * EI * weight)), friction = 0.4;
  for (const double straight : {100.0, 100.7, 101.4, 102.9}) {
    const double length = 1000;
    const auto hole = holeOf(well::straight(length, 90 * degree), friction);
    const double wob = limit - friction * weight * straight;
    const auto loads = march(stringOf(length), hole, length, sliding(0.3, wob));
    const double angle = std::atan(k * limit) + k * weight * friction * (length - straight);
    const double top = std::tan(angle) / k;
    EXPECT_NEAR(-loads.tension.back(), top, exact * top) << straight;
    // integral of F over the helix: log(cos(a)/cos(b))/(k^2 mu w)
    const double pushed =
        straight * 0.5 * (wob + limit) +
        std::log(std::cos(std::atan(k * limit)) / std::cos(angle)) / (k * k * friction * weight);
    const double shorter = pushed / pipe().axialRigidity();
    EXPECT_NEAR(-loads.stretching, shorter, exact * shorter) << straight;
  }
}

TEST(SoftString, LocksUpWhereTheHelixHoldsIt) {
  // horizontal, pushed at the bit: dF/ds = mu (w + r F^2/(4 E I)) beyond the helical limit
  const double length = 30000;
  const auto hole = holeOf(well::straight(length, 90 * degree), 0.4);
  const auto loads = march(stringOf(length), hole, length, sliding(0.3, 2.5e5));
  ASSERT_GE(loads.lockUpDepth, 0.0);
  const double r = 0.108 - 0.0635, EI = pipe().youngModulus() * pipe().inertiaX();
  const double k = std::sqrt(r / (4 * EI * weight));
  const double F1 = 0.01 * pipe().axialRigidity();
  // integral of dF/(w (1 + k^2 F^2)) from 2.5e5 (above the limit) to F1
  const double way = (std::atan(k * F1) - std::atan(k * 2.5e5)) / (k * weight * 0.4);
  EXPECT_NEAR(length - loads.lockUpDepth, way, 0.01 * way);
  EXPECT_GT(loads.depth.back(), loads.lockUpDepth);
  EXPECT_LE(loads.depth.back() - loads.lockUpDepth, 3.0 + 1e-9);
  EXPECT_LT(-loads.tension.back(), F1);
  EXPECT_LT(march(stringOf(length), hole, length, sliding(0.3, 2.5e5), false).lockUpDepth, 0.0);
}

}  // namespace SoftStringTest
}  // namespace tooljoint::softstring
