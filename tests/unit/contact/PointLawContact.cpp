// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A user's point law in the bore: separation, sliding around and along, with a state. Forces and
/// tangents at a node against the law itself and against differences.
#include "substructures/contact/PointLawContact.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Error.hpp"
#include "common/Types.hpp"
#include "deck/Deck.hpp"
#include "model/laws/PointLawRegistry.hpp"
#include "substructures/contact/ContactParameters.hpp"

namespace PointLawContactTest {

using namespace tooljoint;
using namespace tooljoint::contact;

constexpr double radius = 0.08, clearance = 0.03, omega = 7.0;

/// A viscoelastic wall with drag in all directions: N = -k (s - x) - c s', x' = a (s - x) + b slip,
/// tractions proportional to velocity and state.
struct Sticky : model::Formula<3, 1> {
  double k = 900.0, c = 3.0, a = 20.0, b = 0.7, drag = 5.0;
  explicit Sticky(const Teuchos::ParameterList&) {}
  template <class T>
  void operator()(const model::PointAt<T>& at, T* f, T* g) const {
    f[0] = -k * (at.d[0] - at.x[0]) - c * at.v[0];
    f[1] = -drag * at.v[1] * (1.0 + at.x[0] * at.x[0]);
    f[2] = -2.0 * drag * at.v[2] - 40.0 * at.d[2];
    g[0] = a * (at.d[0] - at.x[0]) + b * at.v[1];
  }
  Power power(const model::PointAt<double>& at, const double*) const {
    double f[3], g[1];
    (*this)(at, f, g);
    Power p;  // all power taken up by the law
    p.friction = -(f[0] * at.v[0] + f[1] * at.v[1] + f[2] * at.v[2]);
    return p;
  }
};

const bool registered =
    model::registerFormula<Sticky>(deck::ListSpec("Sticky", "A law of the tests."));

std::shared_ptr<const model::PointLaw> inBore(const AxialSliding& axial = {}) {
  ContactPoints points;
  ContactPoint point;
  point.node = 3;
  point.stiffness = 1.0;
  point.clearance = clearance;
  point.contactRadius = radius;
  points.add(point);
  return pointLawContact("Sticky", {})
      ->inMotion(
          points, [](double) { return omega; }, axial);
}

using Vector4 = Eigen::Vector4d;
const Vector4 place(0.011, -0.02, 0.4, 0.9), speed(0.3, 0.5, -0.2, 1.1);
constexpr double state = 0.004;

Vector4 force(const model::StatefulPointLaw& law, const Vector4& d, const Vector4& v, double x,
              double& rate) {
  Vector4 f;
  law.forces(0.0, {0}, d.data(), v.data(), &x, f.data(), &rate);
  return f;
}

TEST(PointLawContact, ActsInTheDirectionsOfTheWall) {
  const auto shared = inBore();
  const auto& law = *model::stateful(*shared);
  ASSERT_EQ(law.width(), 4);
  EXPECT_EQ(contactComponents(law.width()), (std::vector<int>{0, 1, 2, 5}));
  double rate = 0;
  const Vector4 f = force(law, place, speed, state, rate);
  const double r = std::hypot(place[0], place[1]), nu = place[0] / r, nv = place[1] / r;
  const double y[] = {clearance - r, 0.0, place[2]};
  const double yDot[] = {-(nu * speed[0] + nv * speed[1]),
                         nu * speed[1] - nv * speed[0] + (omega + speed[3]) * radius, speed[2]};
  double own[3], ownRate = 0;
  Sticky({})(model::PointAt<double>{0, y, yDot, &state, nullptr}, own, &ownRate);
  EXPECT_NEAR(f[0], -own[0] * nu - own[1] * nv, 1e-9);
  EXPECT_NEAR(f[1], -own[0] * nv + own[1] * nu, 1e-9);
  EXPECT_NEAR(f[2], own[2], 1e-9);
  EXPECT_NEAR(f[3], own[1] * radius, 1e-9);
  EXPECT_NEAR(rate, ownRate, 1e-9);
}

/// Sliding along the hole is relative to the wall: it includes the speed of the block, and the
/// power its force.
TEST(PointLawContact, SlidesAlongWithTheBlock) {
  constexpr double feed = 0.3, t = 2.0;
  const auto shared = inBore({feed, false});
  const auto& law = *model::stateful(*shared);
  Vector4 f;
  double rate = 0;
  law.forces(t, {0}, place.data(), speed.data(), &state, f.data(), &rate);
  EXPECT_NEAR(f[2], -10.0 * (speed[2] + feed) - 40.0 * (place[2] + feed * t), 1e-9);
  double xDot = 0;
  const auto power = law.powers(t, {0}, place.data(), speed.data(), &state, &xDot);
  EXPECT_NEAR(power.friction - power.drive, -f.dot(speed), 1e-9);
}

TEST(PointLawContact, TangentsAreTheDerivatives) {
  const auto shared = inBore();
  const auto& law = *model::stateful(*shared);
  Vector4 f, fx, gd, gv;
  Eigen::Matrix<double, 4, 4, Eigen::RowMajor> fd, fv;
  double g = 0, gx = 0;
  law.forcesWithTangents(0, {0}, place.data(), speed.data(), &state, f.data(), &g,
                         {fd.data(), fv.data(), fx.data(), gd.data(), gv.data(), &gx});
  constexpr double h = 1e-6;
  for (int i = 0; i < 4; ++i) {
    const Vector4 step = h * Vector4::Unit(i);
    double plus = 0, minus = 0;
    const Vector4 byD = (force(law, place + step, speed, state, plus) -
                         force(law, place - step, speed, state, minus)) /
                        (2 * h);
    EXPECT_LT((byD - fd.col(i)).norm(), 1e-5 * fd.norm()) << "column " << i;
    EXPECT_NEAR((plus - minus) / (2 * h), gd[i], 1e-6 * (1 + gd.norm()));
    const Vector4 byV = (force(law, place, speed + step, state, plus) -
                         force(law, place, speed - step, state, minus)) /
                        (2 * h);
    EXPECT_LT((byV - fv.col(i)).norm(), 1e-6 * fv.norm()) << "column " << i;
    EXPECT_NEAR((plus - minus) / (2 * h), gv[i], 1e-6 * (1 + gv.norm()));
  }
  double plus = 0, minus = 0;
  const Vector4 byX =
      (force(law, place, speed, state + h, plus) - force(law, place, speed, state - h, minus)) /
      (2 * h);
  EXPECT_LT((byX - fx).norm(), 1e-6 * fx.norm());
  EXPECT_NEAR((plus - minus) / (2 * h), gx, 1e-6 * std::abs(gx));
}

/// The power taken up by the law comes from the node and from the rotary drive.
TEST(PointLawContact, BooksTheWorkOfTheDrive) {
  const auto shared = inBore();
  const auto& law = *model::stateful(*shared);
  double rate = 0;
  const Vector4 f = force(law, place, speed, state, rate);
  const auto power = law.powers(0, {0}, place.data(), speed.data(), &state, &rate);
  EXPECT_NE(power.drive, 0.0);
  EXPECT_NEAR(power.friction - power.drive, -f.dot(speed), 1e-9 * std::abs(power.friction));
}

TEST(PointLawContact, RecordsAsOtherContact) {
  const auto shared = inBore();
  const auto channels = shared->channels();
  ASSERT_EQ(channels.size(), 5u);
  EXPECT_EQ(channels[0].name, "normal_force");
  double out[5], rate = 0;
  model::record(*shared, 0, place.data(), speed.data(), &state, out);
  const Vector4 f = force(*model::stateful(*shared), place, speed, state, rate);
  const double r = std::hypot(place[0], place[1]);
  EXPECT_NEAR(out[0], -(f[0] * place[0] + f[1] * place[1]) / r, 1e-9);
  EXPECT_NEAR(out[1], clearance - r, 1e-9);
  EXPECT_NEAR(out[2], (-f[0] * place[1] + f[1] * place[0]) / r, 1e-9);
  EXPECT_NEAR(out[3], f[3], 1e-12);
  EXPECT_NEAR(out[4], f[2], 1e-12);
}

TEST(PointLawContact, PushesAtRestAsTheLawInItsInitialState) {
  ContactPoints points;
  ContactPoint point;
  point.stiffness = 1.0;
  point.clearance = clearance;
  points.add(point);
  Teuchos::ParameterList own;
  own.set("Gap", 0.0).set("Stiffness", 1e6).set("Damping", 0.0).set("Smoothing", 1e-3);
  own.set("Friction", 0.3).set("Slip Velocity", 1e-3);
  const auto rest = pointLawContact("Stop", own)->atRest(points);
  const double r = clearance + 0.002;
  const double uv[] = {0.6 * r, 0.8 * r};
  constexpr int n = StaticContact::kForces;
  double f[n], tangent[2 * n], normal = 0;
  rest->evaluate({}, uv, f, tangent);
  rest->normalForce({}, uv, &normal);
  EXPECT_NEAR(normal, 2000.0, 1e-6);
  EXPECT_NEAR(f[0], -0.6 * normal, 1e-6);
  EXPECT_NEAR(f[1], -0.8 * normal, 1e-6);
  EXPECT_EQ(f[2], 0.0);
  constexpr double h = 1e-8;
  for (int i = 0; i < 2; ++i) {
    double plus[n], minus[n], at[] = {uv[0], uv[1]};
    at[i] += h;
    rest->evaluate({}, at, plus, nullptr);
    at[i] -= 2 * h;
    rest->evaluate({}, at, minus, nullptr);
    for (int row = 0; row < n; ++row)
      EXPECT_NEAR((plus[row] - minus[row]) / (2 * h), tangent[2 * row + i], 10.0);
  }
}

TEST(PointLawContact, IsChosenByNameInTheDeck) {
  auto list = deck::defaults(
      deck::ListSpec("Contact", "").real("Stiffness", "N/m", 1e6, deck::Range::any(), "k"));
  list.set("Law", std::string("Sticky"));
  const auto settings = readContact(list);
  ContactPoints points;
  points.add(settings.pointAt(1.0, 1, clearance, radius));
  EXPECT_EQ(settings.law->inMotion(points, [](double) { return 0.0; })->width(), 4);
  list.sublist("Friction");
  EXPECT_THROW(readContact(list), DeckError);
}

}  // namespace PointLawContactTest
