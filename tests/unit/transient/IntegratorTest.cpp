// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Every integrator against closed forms, and its order of convergence.
#include <gtest/gtest.h>

#include "Models.hpp"
#include "common/Error.hpp"

namespace tooljoint::transient::testing {
namespace {

/// Error at the end of a damped free vibration with step h: m 2, zeta 0.05, omega 10.
double freeVibrationError(const std::string& integrator, double h, Teuchos::ParameterList own = {}) {
  const double m = 2, omega = 10, zeta = 0.05;
  const auto model = oscillator(m, 2 * zeta * omega * m, omega * omega * m, 0.3, -1.0);
  Keep samples;
  auto o = options(integrator, 1.0, h, 0.25);
  o.own = own;
  integrate(model, o, samples);
  const double wd = omega * std::sqrt(1 - zeta * zeta);
  double error = 0;
  for (std::size_t i = 0; i < samples.time.size(); ++i) {
    const double t = samples.time[i];
    const double exact = std::exp(-zeta * omega * t) * (0.3 * std::cos(wd * t) + (-1.0 + zeta * omega * 0.3) / wd * std::sin(wd * t));
    error = std::max(error, std::abs(samples.q[i][0] - exact));
  }
  EXPECT_EQ(samples.time.size(), 5u);
  return error;
}

TEST(Integrators, fixedRungeKuttaIsOfFourthOrder) {
  const double coarse = freeVibrationError("RK4", 0.01);
  const double fine = freeVibrationError("RK4", 0.005);
  EXPECT_NEAR(std::log2(coarse / fine), 4.0, 0.15);
  EXPECT_LT(fine, 1e-6);
}

TEST(Integrators, generalizedAlphaIsOfSecondOrderAtEverySpectralRadius) {
  for (double radius : {0.0, 0.5, 0.8, 1.0}) {
    Teuchos::ParameterList own;
    own.set("Spectral Radius", radius);
    const double coarse = freeVibrationError("Generalized-alpha", 0.002, own);
    const double fine = freeVibrationError("Generalized-alpha", 0.001, own);
    EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.06) << "spectral radius " << radius;
    EXPECT_LT(fine, 1e-3);
  }
}

}  // namespace
}  // namespace tooljoint::transient::testing
