// SPDX-License-Identifier: BSD-3-Clause
#include <gtest/gtest.h>
#include <limits>

#include "common/Constants.hpp"
#include "common/report/EvaluationCounters.hpp"
#include "model/laws/PointLaw.hpp"
#include "substructures/contact/WallKinematics.hpp"
#include "tests/unit/contact/Samples.hpp"

namespace LawsTest {

using namespace tooljoint;
using namespace tooljoint::contact;
using namespace tooljoint::contact::testing;

using constants::pi;
double still(double) { return 0.0; }
double turning(double) { return 4.0 * pi; }

/// Normal force of one point at the penetration G with the rate of penetration `rate`.
double normal(const std::string& name, const ContactPoint& point, double G, double rate) {
  const auto contact = law(name)->inMotion(batch({point}), still);
  const std::vector<double> d = {point.clearance + G, 0.0, 0.0}, v = {rate, 0.0, 0.0};
  std::vector<double> out(contact->channels().size());
  contact->record(0.0, d.data(), v.data(), out.data());
  return out[0];
}

TEST(NguyenLaw, IsThePrintedOne) {
  const ContactPoint p = steelOnRock();
  for (const double G : {-5e-3, -1e-5, 4e-5, 1e-3, 8e-3})
    for (const double rate : {-0.3, 0.0, 0.2}) {
      const double K = p.stiffness / 2.0 * (2.0 / pi * std::atan(pi * p.lambdaK * G) + 1.0);
      const double C = p.damping / 2.0 * (2.0 / pi * std::atan(pi * p.lambdaC * G) + 1.0);
      EXPECT_NEAR(normal("Nguyen", p, G, rate), K * G + C * rate, 1e-9) << G << " " << rate;
    }
}

// k_c/(pi^2 lambda) at any gap: 1.4e-6 N, 1 N, 338 N
TEST(NguyenLaw, PullsOpenNodesWithItsTail) {
  for (const auto& [lambda, pull] :
       {std::pair{7e11, 1.447e-6}, std::pair{1e6, 1.0132}, std::pair{3e3, 337.7}})
    for (const double gap : {5e-3, 2e-2})
      EXPECT_NEAR(-normal("Nguyen", steelOnRock(lambda), -gap, 0.0), pull, 2e-3 * pull) << lambda;
}

TEST(NguyenLaw, PullsOnReboundWhereTheOthersDoNot) {
  const ContactPoint p = steelOnRock(7e11);
  EXPECT_LT(normal("Nguyen", p, 1e-5, -0.5), 0.0);
  EXPECT_EQ(normal("Clamped", p, 1e-5, -0.5), 0.0);
  EXPECT_EQ(normal("Hunt-Crossley", p, 1e-5, -0.6), 0.0);
}

TEST(Laws, AsymptoteOfTheArcTangentIsExactToRounding) {
  // the seam between atan2 and the asymptote is at pi lambda |G| = 32
  ContactPoint p = steelOnRock(1e4);
  p.damping = 0.0;
  for (const double x : {-1e6, -100.0, -32.1, -31.9, 31.9, 32.1, 100.0, 1e6}) {
    const double G = x / (pi * 1e4);
    p.clearance = 40.0;
    const double r = p.clearance + G;  // what is left of G after rounding
    const double seen = std::sqrt(r * r + axisRadius * axisRadius) - p.clearance;
    const double expected = p.stiffness / pi * std::atan2(1.0, -pi * 1e4 * seen) * seen;
    EXPECT_NEAR(normal("Nguyen", p, G, 0.0) / expected, 1.0, 1e-14) << x;
  }
}

TEST(ClampedLaw, ActsOnlyInThePenetrationAndNeverPulls) {
  for (const double lambda : {2e3, 1e6, 7e11}) {
    const ContactPoint p = steelOnRock(lambda);
    EXPECT_EQ(normal("Clamped", p, -1e-6, 1.0), 0.0);
    EXPECT_EQ(normal("Clamped", p, -1e-2, 1.0), 0.0);
    for (double G = 1e-8; G < 1e-2; G *= 3.0)
      for (const double rate : {-2.0, 0.0, 0.5}) EXPECT_GE(normal("Clamped", p, G, rate), 0.0);
  }
}

TEST(ClampedLaw, BecomesTheLinearSpringAndDamper) {
  const ContactPoint p = steelOnRock(7e11);
  EXPECT_NEAR(normal("Clamped", p, 2e-4, 0.05), 1e7 * 2e-4 + 1e4 * 0.05, 1e-3);
}

TEST(HuntCrossleyLaw, IsAPowerLawWithDampingByPenetration) {
  const ContactPoint p = steelOnRock();
  EXPECT_NEAR(normal("Hunt-Crossley", p, 4e-4, 0.1), 1e7 * std::pow(4e-4, 1.5) * (1.0 + 2.0 * 0.1),
              1e-6);
  EXPECT_EQ(normal("Hunt-Crossley", p, -1e-9, 1.0), 0.0);
}

TEST(Friction, AtASpeedIsThatOfTheSpeed) {
  const ContactPoint p = steelOnRock();
  const auto slow = law("Nguyen")->inMotion(batch({p}), [](double) { return 0.02; });
  const auto fast = law("Nguyen")->inMotion(batch({p}), [](double) { return 9.0; });
  const std::vector<double> d = {p.clearance + 1e-4, 0.0, 0.0}, v = {0.0, 0.0, 0.0};
  EXPECT_EQ(force(*model::atSpeed(slow, 9.0), 0.0, d, v), force(*fast, 0.0, d, v));
  EXPECT_NE(force(*slow, 0.0, d, v), force(*fast, 0.0, d, v));
}

TEST(Friction, ForcesAndTorqueOpposeTheSliding) {
  const ContactPoint p = steelOnRock(7e11);
  const auto contact = law("Nguyen")->inMotion(batch({p}), turning);
  const std::vector<double> d = {p.clearance + 1e-4, 0.0, 0.0}, v = {0.0, 0.0, 0.0};
  const auto f = force(*contact, 0.0, d, v);
  const double slip = turning(0.0) * p.contactRadius;
  const double xi = std::sqrt(0.5), q = 1.0 + (1.0 - xi) / (2.0 * 0.1 * 0.1) * slip;
  const double mu = slip / 0.2 * ((1.0 - xi) / q + (1.0 + xi) / (q * q));
  EXPECT_NEAR(f[0], -1000.0, 1e-4);
  EXPECT_NEAR(f[1], -mu * 1000.0,
              1e-4);  // at u > 0 the wall drags a string with positive rotation along -y
  EXPECT_NEAR(f[2], -mu * 1000.0 * p.contactRadius, 1e-5);
  const auto back =
      force(*law("Nguyen")->inMotion(batch({p}), [](double) { return -4.0 * pi; }), 0.0, d, v);
  EXPECT_NEAR(back[1], -f[1], 1e-9);
  EXPECT_NEAR(back[2], -f[2], 1e-9);
}

// Rolling backwards round the hole without sliding: whirl -Omega R_c/j0.
TEST(Friction, VanishesInBackwardRolling) {
  const ContactPoint p = steelOnRock(7e11);
  const auto contact = law("Nguyen")->inMotion(batch({p}), turning);
  const double r = p.clearance + 1e-4;
  const double whirl = -turning(0.0) * p.contactRadius / r;
  const auto f = force(*contact, 0.0, {r, 0.0, 0.0}, {0.0, r * whirl, 0.0});
  EXPECT_NEAR(f[1], 0.0, 1e-9);
  EXPECT_NEAR(f[2], 0.0, 1e-10);
}

TEST(Friction, OmittedAtPointsWithoutItAndCounted) {
  ContactPoint slippery = steelOnRock(7e11);
  slippery.muStatic = slippery.muDynamic = 0.0;
  const ContactPoint rough = steelOnRock(7e11);
  const double r = rough.clearance + 1e-4;
  const std::vector<double> d = {r, 0.0, 0.0, r, 0.0, 0.0}, v(6, 0.0);

  resetEvaluationCounters();
  const auto none = law("Clamped")->inMotion(batch({slippery, slippery}), [](double) -> double {
    throw std::logic_error("speed asked for");
  });
  EXPECT_EQ(force(*none, 0.0, d, v)[2], 0.0);
  EXPECT_EQ(answer(*none, 0.0, d, v).f[2], 0.0);
  EXPECT_EQ(counted("contact evaluations"), 4);
  EXPECT_EQ(counted("friction evaluations"), 0);
  EXPECT_EQ(none->channels().size(), 2u);

  const auto mixed = law("Clamped")->inMotion(batch({slippery, rough}), turning);
  const auto f = force(*mixed, 0.0, d, v);
  EXPECT_EQ(f[2], 0.0);
  EXPECT_LT(f[5], -1.0);
  EXPECT_EQ(counted("friction evaluations"), 1);
  EXPECT_EQ(mixed->channels().size(), 4u);
}

TEST(Friction, DynamicAboveStaticIsRefused) {
  ContactPoint p = steelOnRock();
  p.muDynamic = 0.3;
  ContactPoints points;
  EXPECT_THROW(points.add(p), DeckError);
  p.muDynamic = p.muStatic;
  EXPECT_NO_THROW(points.add(p));
}

TEST(Batch, LeavesPointsThatAreNotActiveUntouched) {
  const ContactPoint p = steelOnRock();
  const auto contact = law("Nguyen")->inMotion(batch({p, p, p}), turning);
  const double r = p.clearance + 1e-4;
  const std::vector<double> d = {r, 0.0, 0.0, 0.0, r, 0.0, -r, 0.0, 0.0}, v(9, 0.1);
  std::vector<double> f(9, -77.0), a(27, -77.0), b(27, -77.0);
  contact->evaluateWithTangent(0.0, {1}, d.data(), v.data(), f.data(), a.data(), b.data());
  for (const std::size_t i : {0u, 1u, 2u, 6u, 7u, 8u}) EXPECT_EQ(f[i], -77.0);
  EXPECT_EQ(a[0], -77.0);
  EXPECT_EQ(b[26], -77.0);
  const auto whole = force(*contact, 0.0, d, v);
  for (const std::size_t i : {3u, 4u, 5u}) EXPECT_EQ(f[i], whole[i]);
}

TEST(Batch, SubsetIsTheSameLawForSomePoints) {
  ContactPoint p = steelOnRock(), q = steelOnRock();
  q.node = 9;
  q.clearance = 0.0;
  q.muStatic = 0.4;
  const auto whole = law("Hunt-Crossley")->inMotion(batch({p, q}), turning);
  const auto part = whole->subset({1});
  ASSERT_EQ(part->size(), 1);
  const State state(1e-3, 0.4);
  std::vector<double> d = state.d, v = state.v;
  const auto f = force(*part, 0.3, d, v);
  d.insert(d.begin(), {0.0, 0.0, 0.0});
  v.insert(v.begin(), {0.0, 0.0, 0.0});
  const auto g = force(*whole, 0.3, d, v);
  for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(f[i], g[i + 3]);
  EXPECT_EQ(std::dynamic_pointer_cast<const BoreholeContact>(part)->points().node.front(), 9);
}

TEST(ClearanceLeft, IsTheGapUnlessTheLawHasATail) {
  const ContactPoint step = steelOnRock(7e11), soft = steelOnRock(1e6);
  const std::vector<double> d = {0.01, 0.0, 0.0, 0.0, 0.0286, 0.0};
  double gap[2];
  for (const char* name : {"Nguyen", "Clamped", "Hunt-Crossley"}) {
    law(name)->inMotion(batch({step, step}), still)->clearanceLeft({0, 1}, d.data(), gap);
    EXPECT_NEAR(gap[0], 0.0185, 1e-5) << name;
    EXPECT_LE(gap[1], 0.0) << name;
  }
  law("Nguyen")->inMotion(batch({soft, soft}), still)->clearanceLeft({0, 1}, d.data(), gap);
  EXPECT_EQ(gap[0], 0.0);
  law("Clamped")->inMotion(batch({soft, soft}), still)->clearanceLeft({0, 1}, d.data(), gap);
  EXPECT_NEAR(gap[0], 0.0185, 1e-12);
}

// Skipped forces must be negligible, also with a fast approach.
TEST(ClearanceLeft, LeavesOutOnlyWhatIsNegligible) {
  const ContactPoint p = steelOnRock(7e11);
  for (const char* name : {"Nguyen", "Clamped", "Hunt-Crossley"}) {
    const auto contact = law(name)->inMotion(batch({p}), still);
    for (double G = -1e-2; G < -1e-9; G *= 0.5) {
      double gap = 0.0;
      const std::vector<double> d = {p.clearance + G, 0.0, 0.0};
      contact->clearanceLeft({0}, d.data(), &gap);
      if (gap > 0.0) {
        EXPECT_LT(std::abs(normal(name, p, G, 1.0)), 1.01 * negligibleForce) << name << " " << G;
      }
    }
  }
}

TEST(Axis, ForcesAndTangentsAreFiniteAndContinuousWithoutClearance) {
  ContactPoint gauge = steelOnRock(7e11);
  gauge.clearance = 0.0;
  for (const char* name : {"Nguyen", "Clamped", "Hunt-Crossley"}) {
    const auto contact = law(name)->inMotion(batch({gauge}), turning);
    const std::vector<double> v = {0.02, -0.01, 0.5};
    for (const double x : {0.0, 1e-300, 1e-12}) {
      const Answer at = answer(*contact, 0.0, {x, -x, 0.0}, v);
      for (const auto* list : {&at.f, &at.dfdd, &at.dfdv})
        for (const double value : *list) EXPECT_TRUE(std::isfinite(value)) << name << " " << x;
    }
    // no jump across the axis: steps of e/100 change the force by at most 2 % of the damping force
    // at hand
    double before = force(*contact, 0.0, {-2e-9, 0.0, 0.0}, v)[0];
    for (double x = -2e-9; x < 2e-9; x += 1e-11) {
      const double now = force(*contact, 0.0, {x, 0.0, 0.0}, v)[0];
      EXPECT_NEAR(now, before, 0.02 * gauge.damping * 0.03) << name << " " << x;
      before = now;
    }
  }
}

// e = 1e-9 m must have no effect in contact.
TEST(Axis, RegularisationDoesNotShowInRealContact) {
  ContactPoint gauge = steelOnRock(7e11);
  gauge.clearance = 0.0;
  gauge.muStatic = gauge.muDynamic = 0.0;
  const auto contact = law("Clamped")->inMotion(batch({gauge}), still);
  const auto f = force(*contact, 0.0, {1e-5, 0.0, 0.0}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(f[0], -100.0, 100.0 * 1e-7);
  // for the elastic force alone the axis is a spring k: f = -k u to first order
  const Answer at = answer(*contact, 0.0, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(at.dfdd[0], -1e7, 1e4);
  EXPECT_NEAR(at.dfdd[4], -1e7, 1e4);
}

TEST(StaticContact, IsTheMotionsLimitForFastSlidingWithTheStaticCoefficient) {
  ContactPoint p = steelOnRock(7e11);
  p.muDynamic = p.muStatic;
  const double r = p.clearance + 3e-4;
  const double uv[2] = {r * std::cos(0.8), r * std::sin(0.8)};
  double f[StaticContact::kForces], N = 0.0;
  const auto rest = law("Nguyen")->atRest(batch({p}));
  rest->evaluate({}, uv, f);
  rest->normalForce({}, uv, &N);
  EXPECT_NEAR(N, 3000.0, 1e-3);
  const auto fast = force(*law("Nguyen")->inMotion(batch({p}), [](double) { return 1e9; }), 0.0,
                          {uv[0], uv[1], 0.0}, {0.0, 0.0, 0.0});
  EXPECT_NEAR(f[0], fast[0], 1e-4);
  EXPECT_NEAR(f[1], fast[1], 1e-4);
  EXPECT_EQ(f[2], 0.0) << "a string that only turns has no drag";
  EXPECT_NEAR(f[3], fast[2], 1e-4);
  EXPECT_NEAR(f[3], -0.2 * N * p.contactRadius, 1e-9);
}

TEST(StaticContact, OptionsOverrideLambdaFrictionAndDirection) {
  const ContactPoint p = steelOnRock(7e11);
  const auto rest = law("Nguyen")->atRest(batch({p}));
  const double uv[2] = {0.0185, 0.0};
  double N = 0.0, f[StaticContact::kForces], g[StaticContact::kForces];
  StaticContact::Options options;
  rest->normalForce(options, uv, &N);
  EXPECT_NEAR(N, -1.447e-6, 1e-9);
  options.lambda = 3e3;
  rest->normalForce(options, uv, &N);
  EXPECT_NEAR(N, -337.7, 0.5);
  const double touching[2] = {0.0287, 0.0};
  options.frictionScale = 0.25;
  rest->evaluate(options, touching, f);
  rest->normalForce(options, touching, &N);
  EXPECT_NEAR(f[1], -0.05 * N, 1e-9);
  options.sliding = {0.0, -1.0};
  rest->evaluate(options, touching, g);
  EXPECT_EQ(g[1], -f[1]);
  EXPECT_EQ(g[3], -f[3]);
  options.sliding = {0.0, 0.0};
  rest->evaluate(options, touching, g);
  EXPECT_EQ(g[1], 0.0);
  EXPECT_EQ(g[3], 0.0);
}

/// Friction has the size mu N whatever the direction of sliding, and points against it.
TEST(StaticContact, FrictionOpposesSlidingAlongAndAroundTheWall) {
  const ContactPoint p = steelOnRock(7e11);
  const auto rest = law("Nguyen")->atRest(batch({p}));
  const double touching[2] = {0.0287, 0.0};  // n = x, t = y
  StaticContact::Options options;
  double N = 0.0, f[StaticContact::kForces];
  rest->normalForce(options, touching, &N);
  for (const Sliding sliding : {Sliding{0.3, 0.0}, {-0.3, 0.0}, {0.3, 5.0}, {-0.2, -9.0}}) {
    options.sliding = sliding;
    rest->evaluate(options, touching, f);
    const double around = sliding.rotarySpeed * p.contactRadius;
    EXPECT_NEAR(std::hypot(f[1], f[2]), p.muStatic * N, 1e-9 * N);
    EXPECT_NEAR(f[1] * sliding.axialSpeed, f[2] * around, 1e-9 * N) << "along the velocity";
    EXPECT_LT(f[1] * around + f[2] * sliding.axialSpeed, 0.0) << "against it";
    EXPECT_NEAR(f[3], f[1] * p.contactRadius, 1e-9 * N);
  }
}

TEST(StaticContact, WithoutItsPullALawOnlyPushes) {
  const ContactPoint p = steelOnRock(3e3);
  const double largest = 1e7 / (constants::pi * constants::pi * 3e3);
  const auto rest = law("Nguyen")->atRest(batch({p}));
  EXPECT_NEAR(rest->largestPull(), largest, 1e-9 * largest);
  EXPECT_EQ(law("Clamped")->atRest(batch({p}))->largestPull(), 0.0);
  StaticContact::Options whole, half, none;
  half.pull = 0.5;
  none.pull = 0.0;
  double last = 0.0;
  for (const double penetration : {-0.02, -1e-3, -1e-4, 0.0, 1e-4, 1e-3}) {
    const double uv[2] = {p.clearance + penetration, 0.0};
    double N[3];
    rest->normalForce(whole, uv, &N[0]);
    rest->normalForce(half, uv, &N[1]);
    rest->normalForce(none, uv, &N[2]);
    EXPECT_GT(N[2], last) << penetration;  // it grows from nearly zero
    EXPECT_NEAR(N[2] - N[0], largest, 1e-9 * largest) << penetration;
    EXPECT_NEAR(2.0 * N[1], N[0] + N[2], 1e-9 * largest) << penetration;
    last = N[2];
  }
}

TEST(Registry, UnknownLawNamesTheKnownOnes) {
  try {
    makeLaw("Hertz");
    FAIL() << "no error";
  } catch (const DeckError& error) {
    EXPECT_NE(std::string(error.what()).find("\"Clamped\", \"Hunt-Crossley\", \"Nguyen\""),
              std::string::npos)
        << error.what();
  }
}

}  // namespace LawsTest
