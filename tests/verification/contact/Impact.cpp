// SPDX-License-Identifier: BSD-3-Clause
// A mass on the wall of the hole: restitution, rolling whirl and the energy balance, integrated
// with the contact laws alone.
#include <Teuchos_ParameterList.hpp>
#include <array>
#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace ImpactTest {

using namespace tooljoint;
using namespace tooljoint::contact;

using constants::pi;

/// u, v, theta_z and their rates.
using Motion = std::array<double, 6>;

/// A free body of mass m [kg] and inertia J [kg m2] in the hole, by classical Runge-Kutta steps.
class Body {
 public:
  Body(std::shared_ptr<const model::PointLaw> contact, double mass, double inertia)
      : contact_(std::move(contact)),
        inverse_{1.0 / mass, 1.0 / mass, inertia > 0.0 ? 1.0 / inertia : 0.0} {}

  Motion step(const Motion& x, double h) const {
    const Motion a = rate(x), b = rate(moved(x, a, 0.5 * h)), c = rate(moved(x, b, 0.5 * h)),
                 d = rate(moved(x, c, h));
    Motion next = x;
    for (std::size_t i = 0; i < 6; ++i)
      next[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
    return next;
  }

  model::PointLaw::Power power(const Motion& x) const {
    return contact_->power(0.0, {0}, x.data(), x.data() + 3);
  }

 private:
  static Motion moved(Motion x, const Motion& rate, double h) {
    for (std::size_t i = 0; i < 6; ++i) x[i] += h * rate[i];
    return x;
  }
  Motion rate(const Motion& x) const {
    double f[3];
    contact_->evaluate(0.0, {0}, x.data(), x.data() + 3, f);
    return {x[3], x[4], x[5], f[0] * inverse_[0], f[1] * inverse_[1], f[2] * inverse_[2]};
  }

  std::shared_ptr<const model::PointLaw> contact_;
  std::array<double, 3> inverse_;
};

ContactPoint wall(double damping, double mu) {
  ContactPoint p;
  p.node = 1;
  p.clearance = 0.0285;
  p.contactRadius = 0.0795;
  p.stiffness = 1e7;
  p.damping = damping;
  p.lambdaK = p.lambdaC = 7e11;
  p.muStatic = p.muDynamic = mu;
  p.regularisationVelocity = 0.01;
  return p;
}

std::shared_ptr<const model::PointLaw> touching(const ContactLaw& law, const ContactPoint& point,
                                                double speed) {
  ContactPoints points;
  points.add(point);
  return law.inMotion(points, [speed](double) { return speed; });
}

/// Rebound speed over impact speed of a mass that meets the wall head on; `duration` is the time of
/// contact.
double restitution(const ContactLaw& law, const ContactPoint& point, double mass, double impact,
                   double* duration = nullptr) {
  const Body body(touching(law, point, 0.0), mass, 0.0);
  Motion x{point.clearance, 0.0, 0.0, impact, 0.0, 0.0};
  const double h = 1e-6;
  double t = 0.0;
  while (x[0] >= point.clearance && t < 0.1) {
    x = body.step(x, h);
    t += h;
  }
  if (duration != nullptr) *duration = t;
  return -x[3] / impact;
}

// Without damping: half a period of the oscillator m, k, and nothing lost.
TEST(Impact, ElasticWallReturnsEverythingAfterHalfAPeriod) {
  for (const char* name : {"Nguyen", "Clamped", "Hunt-Crossley"}) {
    double duration = 0.0;
    EXPECT_NEAR(restitution(*makeLaw(name), wall(0.0, 0.0), 50.0, 0.3, &duration), 1.0, 1e-4)
        << name;
    EXPECT_NEAR(duration, pi * std::sqrt(50.0 / 1e7), 4e-6) << name;
  }
}

// Spring and dashpot, beta = c/2m, omega^2 = k/m - beta^2. Until G = 0, pull included: exp(-pi
// beta/omega). With a wall that cannot pull: exp(-(beta/omega)(pi - atan(2 beta omega/(omega^2 -
// beta^2)))) (Schwager and Poeschel, Granular Matter 9, 2007).
TEST(Impact, RestitutionOfSpringAndDashpot) {
  const double mass = 50.0, stiffness = 1e7;
  for (const double damping : {2e3, 1e4, 2e4}) {
    const double beta = damping / (2.0 * mass);
    const double omega = std::sqrt(stiffness / mass - beta * beta);
    ASSERT_LT(beta, omega);
    EXPECT_NEAR(restitution(*makeLaw("Nguyen"), wall(damping, 0.0), mass, 0.3),
                std::exp(-pi * beta / omega), 1e-3)
        << damping;
    const double angle = pi - std::atan(2.0 * beta * omega / (omega * omega - beta * beta));
    EXPECT_NEAR(restitution(*makeLaw("Clamped"), wall(damping, 0.0), mass, 0.3),
                std::exp(-angle * beta / omega), 1e-3)
        << damping;
  }
}

// 1 - (2/3) chi v for slow impacts, whatever the exponent (Hunt and Crossley 1975); the next term
// is of order (chi v)^2.
TEST(Impact, RestitutionOfHuntAndCrossley) {
  for (const double exponent : {1.0, 1.5, 2.0}) {
    Teuchos::ParameterList own;
    own.set("Exponent", exponent).set("Dissipation", 0.2);
    ContactPoint point = wall(0.0, 0.0);
    point.stiffness = exponent == 1.0 ? 1e7 : 1e9;
    const auto law = LawRegistry::instance().make("Hunt-Crossley", own);
    for (const double v : {0.1, 0.3})
      EXPECT_NEAR(restitution(*law, point, 50.0, v), 1.0 - 2.0 / 3.0 * 0.2 * v,
                  std::pow(0.2 * v, 2))
          << exponent << " " << v;
  }
}

// Friction on a string turned by the drive moves it round the hole backwards until it rolls: whirl
// -Omega R_c/r, which is -Omega R_c/j0 except for the penetration m whirl^2 r/k.
TEST(Whirl, FrictionEndsInBackwardRolling) {
  const double speed = 12.0;
  const ContactPoint point = wall(1e4, 0.2);
  const Body body(touching(*makeLaw("Clamped"), point, speed), 50.0, 0.0);
  Motion x{point.clearance, 0.0, 0.0, 0.0, -0.3, 0.0};
  for (int i = 0; i < 100000; ++i) x = body.step(x, 1e-5);
  const double r = std::hypot(x[0], x[1]);
  const double whirl = (x[0] * x[4] - x[1] * x[3]) / (r * r);
  EXPECT_NEAR(whirl / (-speed * point.contactRadius / r), 1.0, 1e-6);
  EXPECT_NEAR(r - point.clearance, 50.0 * whirl * whirl * r / 1e7, 1e-8);
}

// Kinetic and stored energy plus losses minus the work of the drive are constant in a bouncing,
// sliding motion.
TEST(Energy, LedgerCloses) {
  const double mass = 50.0, inertia = 0.2;
  for (const char* name : {"Nguyen", "Clamped", "Hunt-Crossley"}) {
    Teuchos::ParameterList own;
    if (std::string(name) == "Hunt-Crossley") own.set("Dissipation", 0.5);
    ContactPoint point = wall(std::string(name) == "Hunt-Crossley" ? 0.0 : 5e3, 0.3);
    point.muDynamic = 0.1;
    point.lambdaK = point.lambdaC = 1e5;
    const Body body(touching(*LawRegistry::instance().make(name, own), point, 12.0), mass, inertia);
    Motion x{0.01, 0.02, 0.0, 0.5, 0.2, -1.0};
    const auto energy = [&](const Motion& at) {
      return 0.5 * mass * (at[3] * at[3] + at[4] * at[4]) + 0.5 * inertia * at[5] * at[5] +
             body.power(at).stored;
    };
    const double start = energy(x);
    const double h = 1e-6;
    double lost = 0.0, fed = 0.0;
    const auto rates = [&](const Motion& at) {
      const auto p = body.power(at);
      return std::pair{p.damping + p.friction, p.drive};
    };
    auto before = rates(x);
    for (int i = 0; i < 300000; ++i) {
      x = body.step(x, h);
      const auto now = rates(x);
      lost += 0.5 * h * (before.first + now.first);
      fed += 0.5 * h * (before.second + now.second);
      before = now;
    }
    EXPECT_GT(fed, 1.0) << name;  // it did touch and slide
    EXPECT_NEAR(energy(x) + lost - fed, start, 1e-4 * (start + lost + fed)) << name;
  }
}

}  // namespace ImpactTest
