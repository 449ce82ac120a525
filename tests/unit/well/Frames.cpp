// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/well/Frames.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "substructures/well/Well.hpp"

namespace FramesTest {

using namespace tooljoint;
using namespace tooljoint::well;

using constants::pi;

std::vector<double> depths(double length, int n) {
  std::vector<double> s;
  for (int i = 0; i <= n; ++i) s.push_back(length * i / n);
  return s;
}

void expectOrthonormal(const std::vector<Matrix3>& frames, const Trajectory& well,
                       const std::vector<double>& s) {
  for (std::size_t i = 0; i < s.size(); ++i) {
    EXPECT_LT((frames[i].transpose() * frames[i] - Matrix3::Identity()).norm(), 1e-14) << s[i];
    EXPECT_NEAR(frames[i].determinant(), 1.0, 1e-14) << s[i];
    EXPECT_LT((frames[i].col(2) - well.at(s[i]).tangent).norm(), 1e-15) << s[i];
  }
}

TEST(SmallestRotation, TurnsOneDirectionIntoAnotherAboutTheirCommonNormal) {
  const Vector3 to = Vector3(1.0, 2.0, 0.5).normalized();
  const Matrix3 R = smallestRotation(Vector3::UnitZ(), to);
  EXPECT_LT((R * Vector3::UnitZ() - to).norm(), 1e-15);
  EXPECT_LT((R.transpose() * R - Matrix3::Identity()).norm(), 1e-15);
  const Vector3 axis = Vector3::UnitZ().cross(to);
  EXPECT_LT((R * axis - axis).norm(), 1e-15);
  EXPECT_THROW(smallestRotation(Vector3::UnitZ(), -Vector3::UnitZ()), ModelError);
}

TEST(BishopFrames, VerticalWellKeepsTheGlobalAxes) {
  for (const Matrix3& frame : bishopFrames(*straight(1000.0), {0.0, 10.0, 1000.0}))
    EXPECT_EQ(frame, Matrix3(Matrix3::Identity()));
}

TEST(BishopFrames, PlanarArcTurnsAboutTheNormalOfItsPlane) {
  ArcShape shape;
  shape.kickOffDepth = 30.0;
  shape.radius = 100.0;
  shape.endInclination = 0.5 * pi;
  shape.azimuth = 0.3;
  const auto well = arc(shape);
  const auto s = depths(well->length(), 17);
  const auto frames = bishopFrames(*well, s);
  expectOrthonormal(frames, *well, s);
  const Vector3 normal(-std::sin(0.3), std::cos(0.3), 0.0);  // axis of the turn
  for (std::size_t i = 0; i < s.size(); ++i) {
    const double angle = std::max(0.0, s[i] - 30.0) / 100.0;
    const Matrix3 expected = Eigen::AngleAxisd(angle, normal).toRotationMatrix();
    EXPECT_LT((frames[i] - expected).norm(), 1e-12) << s[i];
  }
}

// Against the Frenet frame of a helix a Bishop frame turns back by the integral of the torsion
// b/(a^2+b^2).
TEST(BishopFrames, TurnAgainstTheFrenetFrameByTheTorsionIntegral) {
  const double a = 85.1;
  const double alpha = 0.5 * pi;
  const double length = 170.2;
  const auto well = helix(a, alpha, length);
  const double c = length / alpha;
  const double torsion = std::sqrt(c * c - a * a) / (c * c);
  for (const int n : {2, 162}) {
    const auto s = depths(length, n);
    const auto frames = bishopFrames(*well, s);
    expectOrthonormal(frames, *well, s);
    double start = 0.0;
    for (std::size_t i = 0; i < s.size(); ++i) {
      const Vector3 normal = well->at(s[i]).curvature.normalized();
      const double angle = std::atan2(frames[i].col(1).dot(normal),
                                      frames[i].col(0).dot(normal));  // of the normal in the frame
      if (i == 0) start = angle;
      EXPECT_NEAR(std::remainder(angle - start - torsion * s[i], 2.0 * pi), 0.0, 1e-10) << s[i];
    }
  }
}

// The spin x'.y of the frames is zero to second order of the spacing, for any spacing of the
// depths.
TEST(BishopFrames, DoNotDependOnTheDepthsAskedFor) {
  const auto well = minimumCurvature(
      {{0.0, 0.1, 0.0}, {30.0, 0.3, 1.0}, {47.0, 0.5, 0.2}, {90.0, 0.2, -1.0}, {120.0, 0.9, 2.0}});
  const Matrix3 direct = bishopFrames(*well, {120.0}).front();
  const auto s = depths(120.0, 1000);
  const auto fine = bishopFrames(*well, s);
  expectOrthonormal(fine, *well, s);
  EXPECT_LT((direct - fine.back()).norm(), 1e-11);
}

// On circular arcs parallel transport is the smallest rotation from station to station: an exact
// reference for surveys.
TEST(BishopFrames, AreExactOnASurvey) {
  const std::vector<Station> stations = {
      {0.0, 0.1, 0.0}, {30.0, 0.3, 1.0}, {47.0, 0.5, 0.2}, {90.0, 0.2, -1.0}, {120.0, 0.9, 2.0}};
  const auto well = minimumCurvature(stations);
  Matrix3 expected = smallestRotation(Vector3::UnitZ(), well->at(0.0).tangent);
  for (std::size_t i = 1; i < stations.size(); ++i)
    expected = smallestRotation(well->at(stations[i - 1].depth).tangent,
                                well->at(stations[i].depth).tangent) *
               expected;
  EXPECT_LT((bishopFrames(*well, {120.0}).front() - expected).norm(), 1e-11);
}

/// Nodes that differ by rounding from a depth where the curvature jumps: the chord between them has
/// no direction.
TEST(BishopFrames, PassAJumpOfCurvatureAtANode) {
  const Well whole(
      minimumCurvature(
          {{0.0, 0.0, 0.0}, {4894.7, 0.0, 0.0}, {4909.7, 0.05, 1.0}, {5000.0, 0.05, 1.0}}),
      0.1);
  const Well lower = whole.below(4850.0);
  const auto* well = &lower.trajectory();
  ASSERT_GE(well->breaks().size(), 2u);
  for (const double jump : well->breaks())
    for (const double off : {-1e-9, -1e-12, -4e-13, -1e-13, 0.0, 1e-13, 4e-13, 1e-12, 1e-9}) {
      const auto frames = bishopFrames(*well, {jump - 1.0, jump + off, jump + 1.0});
      for (const Matrix3& frame : frames)
        EXPECT_LT((frame.transpose() * frame - Matrix3::Identity()).norm(), 1e-10) << off;
      EXPECT_GT(frames[0].col(1).dot(frames[1].col(1)), 0.999) << off;
      EXPECT_GT(frames[1].col(1).dot(frames[2].col(1)), 0.999) << off;
    }
}

TEST(BishopFrames, RefuseDecreasingDepths) {
  EXPECT_THROW(bishopFrames(*straight(10.0), {5.0, 4.0}), ModelError);
}

TEST(HighSide, LooksUpAcrossTheHoleAndTheRightSideLiesClockwiseLookingDown) {
  const double inclination = 0.7, azimuth = 2.1;
  const Vector3 tangent(std::sin(inclination) * std::cos(azimuth),
                        std::sin(inclination) * std::sin(azimuth), std::cos(inclination));
  const Vector3 high = highSide(tangent);
  EXPECT_NEAR(high.norm(), 1.0, 1e-15);
  EXPECT_NEAR(high.dot(tangent), 0.0, 1e-15);
  EXPECT_NEAR(high.z(), -std::sin(inclination), 1e-15) << "Z is down";
  // looking along the azimuth the right hand points to azimuth + 90 deg, level
  const Vector3 right = tangent.cross(high);
  EXPECT_NEAR(right.x(), -std::sin(azimuth), 1e-15);
  EXPECT_NEAR(right.y(), std::cos(azimuth), 1e-15);
  EXPECT_NEAR(right.z(), 0.0, 1e-15);
}

TEST(HighSide, OfAVerticalHoleIsNorth) {
  EXPECT_EQ(highSide(Vector3::UnitZ()), Vector3::UnitX());
  const double slight = 1e-3;  // rad, azimuth 0
  EXPECT_NEAR(highSide({std::sin(slight), 0.0, std::cos(slight)}).x(), 1.0, 1e-6);
}

}  // namespace FramesTest
