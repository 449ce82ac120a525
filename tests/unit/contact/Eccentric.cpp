// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/contact/Eccentric.hpp"

#include <gtest/gtest.h>

#include "model/laws/Friction.hpp"
#include "tests/unit/contact/Samples.hpp"

namespace EccentricTest {

using namespace tooljoint;
using namespace tooljoint::contact;
using namespace tooljoint::contact::testing;

const Offsets offsets{{0.0, 0.0}, {0.004, -0.003}};

/// One concentric point and one whose centre of contact lies 5 mm beside the axis.
ContactPoints points(double mu) {
  ContactPoint point = steelOnRock();
  point.muStatic = mu;
  point.muDynamic = 0.5 * mu;
  return batch({point, point});
}

std::shared_ptr<const model::PointLaw> moving(double mu) {
  return law("Clamped")->inMotion(points(mu), [](double) { return 12.0; });
}

/// Both points touch.
const std::vector<double> d{0.0286, 0.001, 0.1, 0.0245, 0.0075, -0.2};
const std::vector<double> v{0.07, -0.11, 0.9, -0.05, 0.2, 0.4};

std::vector<double> shifted(std::vector<double> where) {
  where[3] += offsets[1].x();
  where[4] += offsets[1].y();
  return where;
}

TEST(Eccentric, HasTheForcesOfTheLawAtTheCentreOfContactAndTheirTorque) {
  for (const double mu : {0.0, 0.2}) {
    const auto concentric = moving(mu);
    const auto contact = eccentric(concentric, offsets);
    const auto f = force(*contact, 0.5, d, v), at = force(*concentric, 0.5, shifted(d), v);
    for (const std::size_t i : {0U, 1U, 2U, 3U, 4U}) EXPECT_EQ(f[i], at[i]) << i;
    EXPECT_NE(f[3], 0.0);
    EXPECT_DOUBLE_EQ(f[5], at[5] + 0.004 * at[4] + 0.003 * at[3]);
  }
}

TEST(Eccentric, TangentsAgreeWithDifferences) {
  const auto contact = eccentric(moving(0.2), offsets);
  const Answer exact = answer(*contact, 0.5, d, v);
  for (std::size_t column = 3; column < 6; ++column)
    for (const bool velocity : {false, true}) {
      const double h = velocity ? 1e-5 : 1e-8;
      auto plusD = d, minusD = d, plusV = v, minusV = v;
      (velocity ? plusV : plusD)[column] += h;
      (velocity ? minusV : minusD)[column] -= h;
      const auto fp = force(*contact, 0.5, plusD, plusV), fm = force(*contact, 0.5, minusD, minusV);
      for (std::size_t row = 3; row < 6; ++row) {
        const auto& tangent = velocity ? exact.dfdv : exact.dfdd;
        const double found = tangent[9 + 3 * (row - 3) + (column - 3)];
        // differences of forces of 1e4 N over 2e-8 m have a rounding error of 1e-4 N/m times 1e4
        EXPECT_NEAR(found, (fp[row] - fm[row]) / (2.0 * h), 2e-7 * 1e7)
            << row << " " << column << (velocity ? " velocity" : "");
      }
    }
}

TEST(Eccentric, TakesFrictionAlongTheHole) {
  const auto concentric = law("Clamped")->inMotion(
      points(0.2), [](double) { return 12.0; }, along(0.3));
  const auto contact = eccentric(concentric, offsets);
  ASSERT_EQ(contact->width(), 4);
  const std::vector<double> d4{0.0286, 0.001, 0.5, 0.1, 0.0245, 0.0075, 0.6, -0.2},
      v4{0.07, -0.11, 0.2, 0.9, -0.05, 0.2, 0.1, 0.4};
  auto there = d4;
  there[4] += offsets[1].x(), there[5] += offsets[1].y();
  const Answer own = answer(*contact, 0.5, d4, v4), at = answer(*concentric, 0.5, there, v4);
  for (const std::size_t i : {0U, 1U, 2U, 3U, 4U, 5U, 6U}) EXPECT_EQ(own.f[i], at.f[i]) << i;
  EXPECT_NE(own.f[6], 0.0);
  EXPECT_DOUBLE_EQ(own.f[7], at.f[7] + 0.004 * at.f[5] + 0.003 * at.f[4]);
  for (std::size_t c = 0; c < 4; ++c)
    EXPECT_DOUBLE_EQ(own.dfdv[28 + c],
                     at.dfdv[28 + c] + 0.004 * at.dfdv[20 + c] + 0.003 * at.dfdv[16 + c]);
}

TEST(Eccentric, AtRestIsTheSameShift) {
  const auto concentric = law("Clamped")->atRest(points(0.2));
  const auto contact = eccentric(concentric, offsets);
  const std::vector<double> uv{d[0], d[1], d[3], d[4]};
  const auto there = shifted(d);
  const std::vector<double> centre{there[0], there[1], there[3], there[4]};
  constexpr std::size_t n = StaticContact::kForces;
  std::vector<double> f(2 * n), at(2 * n), tangent(4 * n), tangentAt(4 * n), normal(2), normalAt(2);
  contact->evaluate({}, uv.data(), f.data(), tangent.data());
  concentric->evaluate({}, centre.data(), at.data(), tangentAt.data());
  contact->normalForce({}, uv.data(), normal.data());
  concentric->normalForce({}, centre.data(), normalAt.data());
  EXPECT_EQ(normal, normalAt);
  EXPECT_GT(normal[1], 0.0);
  EXPECT_EQ(f[n], at[n]);
  EXPECT_DOUBLE_EQ(f[n + 3], at[n + 3] + 0.004 * at[n + 1] + 0.003 * at[n]);
  const double *own = tangent.data() + 2 * n, *law = tangentAt.data() + 2 * n;
  for (std::size_t c = 0; c < 2; ++c)
    EXPECT_DOUBLE_EQ(own[6 + c], law[6 + c] + 0.004 * law[2 + c] + 0.003 * law[c]);
  EXPECT_EQ(contact->offset(1), offsets[1]);
  EXPECT_EQ(concentric->offset(1), Eigen::Vector2d(0.0, 0.0));
}

TEST(Eccentric, PartsAndVariantsKeepTheirOffsets) {
  const auto contact = eccentric(moving(0.2), offsets);
  const auto second = contact->subset({1});
  const std::vector<double> own(d.begin() + 3, d.end()), ownV(v.begin() + 3, v.end());
  EXPECT_EQ(force(*second, 0.5, own, ownV)[2], force(*contact, 0.5, d, v)[5]);
  const auto smooth = model::withoutFriction(contact);
  ASSERT_NE(smooth, contact);
  EXPECT_EQ(force(*smooth, 0.5, d, v), force(*eccentric(moving(0.0), offsets), 0.5, d, v));
  EXPECT_EQ(model::withoutFriction(smooth), smooth);
  EXPECT_EQ(force(*model::atSpeed(contact, 12.0), 0.5, d, v), force(*contact, 0.5, d, v));
  EXPECT_NE(force(*model::atSpeed(contact, -12.0), 0.5, d, v), force(*contact, 0.5, d, v));
}

TEST(Eccentric, TheDriveIsThatOfTheTractionAtTheSection) {
  const auto contact = eccentric(moving(0.2), offsets);
  const double drive = contact->power(0.5, {0, 1}, d.data(), v.data()).drive;
  EXPECT_GT(std::abs(drive), 1.0);
  EXPECT_NEAR(driveOf(*contact, 0.5, d, v), drive, 1e-9 * std::abs(drive));
}

TEST(Eccentric, RecordsTheGapOfTheCentreOfContact) {
  const auto contact = eccentric(moving(0.2), offsets);
  std::vector<double> recorded(4 * 2), there(4 * 2), gap(2);
  contact->record(0.5, d.data(), v.data(), recorded.data());
  moving(0.2)->record(0.5, shifted(d).data(), v.data(), there.data());
  EXPECT_EQ(recorded, there);
  EXPECT_LT(recorded[3], 0.0) << "the gap of a point that touches";
  contact->clearanceLeft({0, 1}, d.data(), gap.data());
  EXPECT_LT(gap[1], 0.0);
}

}  // namespace EccentricTest
