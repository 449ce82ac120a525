// SPDX-License-Identifier: BSD-3-Clause
// Trajectories and frames against published numbers and theorems.
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "substructures/well/Frames.hpp"

namespace PublishedSurveysTest {

using namespace tooljoint;
using namespace tooljoint::well;

using constants::pi;
const double degree = pi / 180.0;
const double foot = 0.3048;

/// Angle by which the x axis of a frame with vertical tangent is turned from X towards Y.
double spin(const Matrix3& frame) { return std::atan2(frame(1, 0), frame(0, 0)); }

// The textbook leg of the minimum curvature method: from 3500 ft, 15 deg, N20E to 3600 ft, 25 deg,
// N45E the hole goes 27.22 ft north, 19.45 ft east and 94.01 ft down, with a dogleg of 0.22605 rad.
// Printed to two decimals.
TEST(PublishedSurveys, TextbookLegOfMinimumCurvature) {
  const double length = 100.0 * foot;
  const auto well = minimumCurvature(
      {{0.0, 15.0 * degree, 20.0 * degree}, {length, 25.0 * degree, 45.0 * degree}});
  const Vector3 end = well->at(length).position / foot;
  EXPECT_NEAR(end.x(), 27.22, 5e-3);
  EXPECT_NEAR(end.y(), 19.45, 5e-3);
  EXPECT_NEAR(end.z(), 94.01, 5e-3);
  EXPECT_NEAR(well->at(0.5 * length).curvature.norm() * length, 0.22605, 5e-5);
}

// Build-hold-drop in one plane: true vertical depth and displacement in closed form.
TEST(PublishedSurveys, BuildHoldAndDropInClosedForm) {
  const double R1 = 573.0, R2 = 800.0, top = 600.0, hold = 900.0, inclination = 40.0 * degree,
               azimuth = 110.0 * degree;
  const double build = R1 * inclination, drop = R2 * inclination;
  const auto well = minimumCurvature({{0.0, 0.0, azimuth},
                                      {top, 0.0, azimuth},
                                      {top + build, inclination, azimuth},
                                      {top + build + hold, inclination, azimuth},
                                      {top + build + hold + drop, 0.0, azimuth}});
  const Vector3 end = well->at(well->length()).position;
  const double displacement =
      (R1 + R2) * (1.0 - std::cos(inclination)) + hold * std::sin(inclination);
  EXPECT_NEAR(end.z(), top + (R1 + R2) * std::sin(inclination) + hold * std::cos(inclination),
              1e-9);
  EXPECT_NEAR(end.x(), displacement * std::cos(azimuth), 1e-9);
  EXPECT_NEAR(end.y(), displacement * std::sin(azimuth), 1e-9);
}

// A frame carried without spin round a closed loop of tangents comes back turned by the solid angle
// of the loop (Gauss and Bonnet): an octant of the sphere, pi/2.
TEST(BishopFrames, ComeBackTurnedByTheSolidAngleOfTheTangents) {
  const double h = 0.5 * pi;
  const auto well =
      minimumCurvature({{0.0, 0.0, 0.0}, {100.0, h, 0.0}, {170.0, h, h}, {350.0, 0.0, h}});
  const Matrix3 end = bishopFrames(*well, {350.0}).front();
  EXPECT_LT((end.col(2) - Vector3::UnitZ()).norm(), 1e-12);
  EXPECT_NEAR(spin(end), h, 1e-11);
  // the other way round the loop the other way
  const auto back =
      minimumCurvature({{0.0, 0.0, 0.0}, {100.0, h, h}, {170.0, h, 0.0}, {350.0, 0.0, 0.0}});
  EXPECT_NEAR(spin(bishopFrames(*back, {350.0}).front()), -h, 1e-11);
}

// One full turn of a helix: the tangents enclose the solid angle 2 pi (1 - cos inclination).
TEST(BishopFrames, FullTurnOfAHelixTurnsThemByItsSolidAngle) {
  const double a = 60.0, length = 700.0;
  const auto well = helix(a, 2.0 * pi, length);
  const double solid = 2.0 * pi * (1.0 - std::sqrt(1.0 - std::pow(2.0 * pi * a / length, 2)));
  const auto frames = bishopFrames(*well, {0.0, length});
  const Matrix3 turn = frames[0].transpose() * frames[1];
  EXPECT_NEAR(std::atan2(turn(1, 0), turn(0, 0)), solid, 1e-10);
}

}  // namespace PublishedSurveysTest
