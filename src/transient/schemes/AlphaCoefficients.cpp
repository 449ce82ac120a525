// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/AlphaCoefficients.hpp"

#include <algorithm>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

AlphaCoefficients::AlphaCoefficients(double radius, bool phaseCorrection) {
  const double r = radius;
  m = (2 * r - 1) / (r + 1);
  f = r / (r + 1);
  gamma = 0.5 - m + f;
  beta = 0.25 * (1 + f - m) * (1 + f - m);
  if (phaseCorrection) setPhaseCorrection();
}

/// Vibration of frequency w has a relative period error e (w h)^2, where e is the mean of the two
/// local errors of the scheme,
///
///     v: g/2 + g d + k - 1/6,   q: d/2 + b - 1/6,   d = am - af,   k = (af - am)(1/2 - am).
///
/// A mass reduced by 2 e (w h)^2 corrects it. M - k M (I - F), F = s ca (s ca M + K)^-1 M, is this
/// reduced mass for low frequencies and (1 - k) M for high ones, symmetric and positive in between.
/// So the scheme stays unconditionally stable, and a state at rest stays at rest. s keeps k at
/// Tuned::mostPhase or below.
void AlphaCoefficients::setPhaseCorrection() {
  const double d = m - f;
  const double ofVelocity = gamma / 2 + gamma * d + (f - m) * (0.5 - m) - 1.0 / 6;
  const double ofDisplacement = d / 2 + beta - 1.0 / 6;
  const double ca = (1 - m) / ((1 - f) * beta);  // times h^2
  const double whole = (ofVelocity + ofDisplacement) * ca;
  filter = std::min(1.0, Tuned::mostPhase / whole);
  phase = filter * whole;
}

StepScheme AlphaCoefficients::scheme(double h, bool rests) const {
  const double ca = (1 - m) / ((1 - f) * beta * h * h);
  return {h, gamma / (beta * h), ca, filter, phase, rests ? 0.5 * h * h * ca : 1.0};
}

}  // namespace tooljoint::transient
