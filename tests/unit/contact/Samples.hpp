// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Points and states used by the contact tests.
#pragma once

#include <cmath>
#include <gtest/gtest.h>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

#include "model/laws/Friction.hpp"
#include "substructures/contact/ContactLaw.hpp"

namespace tooljoint::contact::testing {

inline ContactPoint steelOnRock(double lambda = 2e3) {
  ContactPoint p;
  p.node = 7;
  p.clearance = 0.0285;
  p.contactRadius = 0.0795;
  p.stiffness = 1e7;
  p.damping = 1e4;
  p.lambdaK = lambda;
  p.lambdaC = 0.7 * lambda;
  p.muStatic = 0.2;
  p.muDynamic = 0.1;
  p.regularisationVelocity = 0.1;
  return p;
}

inline ContactPoints batch(const std::vector<ContactPoint>& list) {
  ContactPoints points;
  for (const ContactPoint& p : list) points.add(p);
  return points;
}

/// Laws with their own parameters get default values for them.
std::shared_ptr<const ContactLaw> law(const std::string& name);

/// GoogleTest names hold letters only.
inline std::string testName(const ::testing::TestParamInfo<const char*>& test) {
  return std::string(test.param) == "Hunt-Crossley" ? "HuntCrossley" : test.param;
}

inline std::vector<int> all(const model::PointLaw& law) {
  std::vector<int> active(static_cast<std::size_t>(law.size()));
  std::iota(active.begin(), active.end(), 0);
  return active;
}

struct Answer {
  std::vector<double> f, dfdd, dfdv;
};

inline Answer answer(const model::PointLaw& law, double t, const std::vector<double>& d,
                     const std::vector<double>& v) {
  const auto entries = static_cast<std::size_t>(law.width()) * d.size();
  Answer a{std::vector<double>(d.size()), std::vector<double>(entries),
           std::vector<double>(entries)};
  law.evaluateWithTangent(t, all(law), d.data(), v.data(), a.f.data(), a.dfdd.data(),
                          a.dfdv.data());
  return a;
}

inline std::vector<double> force(const model::PointLaw& law, double t, const std::vector<double>& d,
                                 const std::vector<double>& v) {
  std::vector<double> f(d.size());
  law.evaluate(t, all(law), d.data(), v.data(), f.data());
  return f;
}

/// Power supplied by the imposed motion of all points against their friction.
inline double driveOf(const model::PointLaw& law, double t, const std::vector<double>& d,
                      const std::vector<double>& v) {
  const auto& frictional = dynamic_cast<const model::Frictional&>(law);
  auto friction = force(law, t, d, v);
  const auto normal = force(*frictional.withoutFriction(), t, d, v);
  for (std::size_t i = 0; i < friction.size(); ++i) friction[i] -= normal[i];
  return frictional.drive(t, all(law), friction.data());
}

/// A state at the radius `r` and the angle `angle`, with a general velocity.
struct State {
  std::vector<double> d, v;
  State(double r, double angle)
      : d{r * std::cos(angle), r * std::sin(angle), 0.3}, v{0.07, -0.11, 0.9} {}
  /// With w in between.
  State with(double w, double wDot) const {
    State four = *this;
    four.d.insert(four.d.begin() + 2, w);
    four.v.insert(four.v.begin() + 2, wDot);
    return four;
  }
};

/// Friction along the hole too, of a string that its block moves down at this speed [m/s].
inline AxialSliding along(double feed) { return {feed, true}; }

}  // namespace tooljoint::contact::testing
