// SPDX-License-Identifier: BSD-3-Clause
#include <Eigen/Geometry>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "substructures/well/Trajectory.hpp"

namespace TrajectoriesTest {

using namespace tooljoint;
using namespace tooljoint::well;

using constants::pi;
const double degree = pi / 180.0;

/// Tangent and curvature are the derivatives of the position, the tangent has unit length, and
/// nothing jumps.
void expectConsistent(const Trajectory& well, const std::vector<double>& depths) {
  const double h = 1e-3;
  for (const double s : depths) {
    const WellPoint at = well.at(s);
    const WellPoint above = well.at(s - h);
    const WellPoint below = well.at(s + h);
    EXPECT_NEAR(at.tangent.norm(), 1.0, 1e-14) << s;
    EXPECT_NEAR(at.tangent.dot(at.curvature), 0.0, 1e-14) << s;
    EXPECT_LT(((below.position - above.position) / (2.0 * h) - at.tangent).norm(), 1e-8) << s;
    EXPECT_LT(((below.tangent - above.tangent) / (2.0 * h) - at.curvature).norm(), 1e-8) << s;
  }
}

TEST(Helix, HasTheClosedFormCurvatureAndInclination) {
  const double a = 85.1;
  const double alpha = pi / 2.0;
  const double length = 170.2;
  const auto well = helix(a, alpha, length);
  const double b = std::sqrt(std::pow(length / alpha, 2) - a * a);
  EXPECT_DOUBLE_EQ(well->length(), length);
  for (const double s : {0.0, 33.0, 100.0, 170.2}) {
    EXPECT_NEAR(well->at(s).curvature.norm(), a / (a * a + b * b), 1e-15) << s;
    // eq. (44)
    const double p = alpha * s / length;
    EXPECT_LT((well->at(s).position - Vector3(a * std::cos(p) - a, a * std::sin(p), b * p)).norm(),
              1e-12)
        << s;
  }
  EXPECT_NEAR(std::acos(well->at(0.0).tangent.z()) / degree, 51.76, 5e-3);
  EXPECT_NEAR(well->at(0.0).tangent.x(), 0.0, 1e-15);
  EXPECT_GT(well->at(0.0).tangent.y(), 0.0);
  expectConsistent(*well, {1.0, 50.0, 169.0});
}

TEST(Helix, RefusesALengthTooShortForItsAngle) {
  try {
    helix(100.0, 2.0, 150.0);
    FAIL() << "no error";
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("at least 200 m long"), std::string::npos)
        << error.what();
  }
}

TEST(Helix, GoesOnStraightOutsideItsLength) {
  const auto well = helix(85.1, pi / 2.0, 170.2);
  const WellPoint end = well->at(170.2);
  const WellPoint beyond = well->at(170.7);
  EXPECT_LT((beyond.position - end.position - 0.5 * end.tangent).norm(), 1e-13);
  EXPECT_EQ(beyond.curvature.norm(), 0.0);
  EXPECT_LT((well->at(-0.5).position + 0.5 * well->at(0.0).tangent).norm(), 1e-13);
}

TEST(Straight, RunsAlongItsDirection) {
  const auto vertical = straight(100.0);
  EXPECT_EQ(vertical->at(30.0).position, Vector3(0.0, 0.0, 30.0));
  EXPECT_EQ(vertical->at(30.0).curvature.norm(), 0.0);
  const auto inclined = straight(100.0, 30.0 * degree, 90.0 * degree);
  EXPECT_LT(
      (inclined->at(100.0).position - Vector3(0.0, 50.0, 100.0 * std::cos(30.0 * degree))).norm(),
      1e-12);
}

TEST(Arc, IsACircleBetweenStraights) {
  ArcShape shape;
  shape.kickOffDepth = 100.0;
  shape.radius = 200.0;
  shape.endInclination = pi / 2.0;
  shape.azimuth = pi;
  shape.tangentLength = 50.0;
  const auto well = arc(shape);
  const double end = 100.0 + 100.0 * pi;
  EXPECT_NEAR(well->length(), end + 50.0, 1e-10);
  EXPECT_LT((well->at(end).position - Vector3(-200.0, 0.0, 300.0)).norm(), 1e-10);
  EXPECT_LT((well->at(end + 50.0).position - Vector3(-250.0, 0.0, 300.0)).norm(), 1e-10);
  EXPECT_NEAR(well->at(200.0).curvature.norm(), 1.0 / 200.0, 1e-15);
  EXPECT_EQ(well->at(50.0).curvature.norm(), 0.0);
  const std::vector<double> breaks = well->breaks();
  ASSERT_EQ(breaks.size(), 2u);
  EXPECT_NEAR(breaks[0], 100.0, 1e-12);
  EXPECT_NEAR(breaks[1], end, 1e-10);
  expectConsistent(*well, {50.0, 101.0, 300.0, end - 1.0, end + 10.0});
}

TEST(Arc, DropsWhenTheEndInclinationIsSmaller) {
  ArcShape shape;
  shape.radius = 300.0;
  shape.startInclination = 60.0 * degree;
  shape.endInclination = 10.0 * degree;
  const auto well = arc(shape);
  EXPECT_NEAR(well->length(), 300.0 * 50.0 * degree, 1e-10);
  EXPECT_NEAR(std::acos(well->at(well->length()).tangent.z()), 10.0 * degree, 1e-12);
}

TEST(MinimumCurvature, IsExactOnAPlanarArc) {
  ArcShape shape;
  shape.radius = 250.0;
  shape.startInclination = 5.0 * degree;
  shape.endInclination = 85.0 * degree;
  shape.azimuth = 40.0 * degree;
  const auto exact = arc(shape);
  std::vector<Station> stations;
  for (int i = 0; i <= 7; ++i) {
    const double inclination = (5.0 + 80.0 * i / 7.0) * degree;
    stations.push_back({exact->length() * i / 7.0, inclination, shape.azimuth});
  }
  const auto survey = minimumCurvature(stations);
  EXPECT_NEAR(survey->length(), exact->length(), 1e-10);
  for (int i = 0; i <= 50; ++i) {
    const double s = exact->length() * i / 50.0;
    EXPECT_LT((survey->at(s).position - exact->at(s).position).norm(), 1e-10) << s;
    EXPECT_LT((survey->at(s).tangent - exact->at(s).tangent).norm(), 1e-13) << s;
    EXPECT_NEAR(survey->at(s).curvature.norm(), 1.0 / 250.0, 1e-12) << s;
  }
}

// The ratio factor form of the method for one leg: dX = L/2 (sum of the tangents) (2/beta)
// tan(beta/2).
TEST(MinimumCurvature, AgreesWithTheRatioFactorForm) {
  const double i1 = 20.0 * degree, i2 = 35.0 * degree, a1 = 350.0 * degree, a2 = 25.0 * degree,
               length = 90.0;
  const Vector3 t1(std::sin(i1) * std::cos(a1), std::sin(i1) * std::sin(a1), std::cos(i1));
  const Vector3 t2(std::sin(i2) * std::cos(a2), std::sin(i2) * std::sin(a2), std::cos(i2));
  const double beta =
      std::acos(std::cos(i2 - i1) - std::sin(i1) * std::sin(i2) * (1.0 - std::cos(a2 - a1)));
  const Vector3 expected = 0.5 * length * (t1 + t2) * (2.0 / beta) * std::tan(0.5 * beta);
  const auto survey = minimumCurvature({{0.0, i1, a1}, {length, i2, a2}});
  EXPECT_LT((survey->at(length).position - expected).norm(), 1e-11);
  EXPECT_LT((survey->at(length).tangent - t2).norm(), 1e-13);
  EXPECT_NEAR(survey->at(10.0).curvature.norm(), beta / length, 1e-14);
}

TEST(MinimumCurvature, ConvergesToTheHelixWithTheSquareOfTheSpacing) {
  const auto exact = helix(85.1, pi / 2.0, 170.2);
  double before = 0.0;
  for (const int n : {10, 20, 40}) {
    std::vector<Station> stations;
    for (int i = 0; i <= n; ++i) {
      const Vector3 t = exact->at(170.2 * i / n).tangent;
      stations.push_back({170.2 * i / n, std::acos(t.z()), std::atan2(t.y(), t.x())});
    }
    const double error =
        (minimumCurvature(stations)->at(170.2).position - exact->at(170.2).position).norm();
    if (before > 0.0) {
      EXPECT_NEAR(before / error, 4.0, 0.2) << n;
    }
    before = error;
  }
}

TEST(MinimumCurvature, RefusesWhatIsNoSurvey) {
  EXPECT_THROW(minimumCurvature({{0.0, 0.0, 0.0}}), DeckError);
  EXPECT_THROW(minimumCurvature({{10.0, 0.0, 0.0}, {20.0, 0.0, 0.0}}), DeckError);
  EXPECT_THROW(minimumCurvature({{0.0, 0.0, 0.0}, {0.0, 0.1, 0.0}}), DeckError);
  EXPECT_THROW(minimumCurvature({{0.0, 0.5 * pi, 0.0}, {10.0, 0.5 * pi, pi}}), DeckError);
}

}  // namespace TrajectoriesTest
