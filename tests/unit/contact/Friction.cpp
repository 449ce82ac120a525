// SPDX-License-Identifier: BSD-3-Clause
#include <cmath>
#include <gtest/gtest.h>

#include "model/laws/Coulomb.hpp"
#include "substructures/contact/ContactPoints.hpp"

namespace FrictionTest {

using tooljoint::model::FrictionCurve;

// Nguyen et al. 2020, eq. (9), as printed.
static double printed(double v, double muS, double muD, double vr) {
  const double xi = std::sqrt(1.0 - muD / muS);
  const double q = 1.0 + (1.0 - xi) / (2.0 * vr * muD) * std::abs(v);
  return v / (2.0 * vr) * ((1.0 - xi) / q + (1.0 + xi) / (q * q));
}

TEST(FrictionCurve, IsThePrintedOne) {
  const FrictionCurve mu(0.2, 0.1, 0.1);
  for (const double v : {-3.0, -0.2, 1e-6, 0.05, 0.3, 2.0, 100.0})
    EXPECT_NEAR(mu.value(v), printed(v, 0.2, 0.1, 0.1), 1e-15) << v;
}

TEST(FrictionCurve, StartsWithTheSlopeOneOverTheRegularisationVelocity) {
  for (const double vr : {0.01, 0.1, 0.5}) {
    const FrictionCurve mu(0.35, 0.25, vr);
    double slope = 0.0;
    EXPECT_EQ(mu.value(0.0, slope), 0.0);
    EXPECT_NEAR(slope, 1.0 / vr, 1e-12 / vr);
  }
}

TEST(FrictionCurve, PeaksAtTheStaticCoefficientWhereThePaperSays) {
  const double muS = 0.2, muD = 0.1, vr = 0.1;
  const FrictionCurve mu(muS, muD, vr);
  const double xi = std::sqrt(1.0 - muD / muS);
  const double peak = 2.0 * vr * muD / (xi * (1.0 - xi));
  double slope = 1.0;
  EXPECT_NEAR(mu.value(peak, slope), muS, 1e-15);
  EXPECT_NEAR(slope, 0.0, 1e-14);
  EXPECT_LT(mu.value(0.99 * peak), muS);
  EXPECT_LT(mu.value(1.01 * peak), muS);
}

TEST(FrictionCurve, TendsToTheDynamicCoefficientAndIsOdd) {
  const FrictionCurve mu(0.2, 0.1, 0.1);
  EXPECT_NEAR(mu.value(1e7), 0.1, 1e-6);
  for (const double v : {0.01, 0.4, 7.0}) EXPECT_EQ(mu.value(-v), -mu.value(v));
}

TEST(FrictionCurve, SlopeIsTheDerivative) {
  const FrictionCurve mu(0.3, 0.12, 0.05);
  for (const double v : {-2.0, -0.1, 0.01, 0.2, 5.0}) {
    const double h = 1e-6;
    double slope = 0.0;
    mu.value(v, slope);
    EXPECT_NEAR(slope, (mu.value(v + h) - mu.value(v - h)) / (2.0 * h), 1e-8) << v;
  }
}

TEST(FrictionCurve, EqualCoefficientsRiseMonotonicallyToTheOne) {
  const FrictionCurve mu(0.2, 0.2, 0.1);
  double before = 0.0;
  for (double v = 0.01; v < 1e4; v *= 2.0) {
    EXPECT_GT(mu.value(v), before);
    before = mu.value(v);
  }
  EXPECT_NEAR(before, 0.2, 1e-5);
}

TEST(SlidingAt, TakesTheCoefficientOfTheSpeedOfEachPoint) {
  tooljoint::contact::ContactPoints points;
  tooljoint::contact::ContactPoint point;
  point.stiffness = 1e7;
  point.muStatic = 0.3;
  point.muDynamic = 0.2;
  point.contactRadius = 0.08;
  points.add(point);
  point.contactRadius = 0.1;
  point.regularisationVelocity = 0.02;
  points.add(point);
  point.muStatic = point.muDynamic = 0.0;
  points.add(point);
  for (const double omega : {0.5, -0.5, 12.0}) {
    const tooljoint::contact::ContactPoints sliding = points.slidingAt(omega);
    EXPECT_NEAR(sliding.muStatic[0], printed(std::abs(omega) * 0.08, 0.3, 0.2, 0.1), 1e-12);
    EXPECT_NEAR(sliding.muStatic[1], printed(std::abs(omega) * 0.1, 0.3, 0.2, 0.02), 1e-12);
    EXPECT_EQ(sliding.muStatic[2], 0.0);
    const tooljoint::contact::ContactPoints both = points.slidingAt(omega, -0.3);
    EXPECT_NEAR(both.muStatic[0], printed(std::hypot(omega * 0.08, 0.3), 0.3, 0.2, 0.1), 1e-12)
        << "along the hole too";
    EXPECT_EQ(sliding.muDynamic, points.muDynamic);
  }
}

TEST(FrictionCurve, NoDynamicFrictionFallsToZeroAndNoFrictionIsZero) {
  const FrictionCurve falling(0.2, 0.0, 0.1);
  // limit of eq. (9) for mu_d -> 0: (v/v_r)/(1 + v/(4 v_r mu_s))^2, its peak mu_s at 4 v_r mu_s
  EXPECT_NEAR(falling.value(4.0 * 0.1 * 0.2), 0.2, 1e-15);
  EXPECT_LT(falling.value(1e6), 1e-6);
  EXPECT_NEAR(falling.value(0.3), printed(0.3, 0.2, 1e-7, 0.1), 1e-6);
  const FrictionCurve none(0.0, 0.0, 0.1);
  EXPECT_EQ(none.value(5.0), 0.0);
}

}  // namespace FrictionTest
