// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The smoothed Coulomb friction coefficient, Nguyen et al. 2020, eq. (9).
#pragma once

#include <cmath>

namespace tooljoint::contact {

/// mu(v) = v/(2 v_r) [ (1-xi) q + (1+xi) q^2 ],  q = 1/(1 + c |v|),  xi = sqrt(1 - mu_d/mu_s),  c =
/// (1-xi)/(2 v_r mu_d).
///
/// Odd in v; slope 1/v_r at zero, peak mu_s at 2 v_r mu_d/(xi (1-xi)), limit mu_d for fast sliding.
struct FrictionCurve {
  double c = 0.0;  ///< [s/m]
  double h = 0.0;  ///< 1/(2 v_r) [s/m]; 0 without friction
  double xi = 0.0;

  FrictionCurve() = default;
  /// Needs 0 <= muDynamic <= muStatic and velocity v_r > 0 [m/s].
  FrictionCurve(double muStatic, double muDynamic, double velocity) {
    if (muStatic == 0.0) return;
    xi = std::sqrt(1.0 - muDynamic / muStatic);
    h = 0.5 / velocity;
    c = h / (muStatic * (1.0 + xi));  // (1-xi)/mu_d = 1/(mu_s (1+xi)), finite at mu_d = 0 too
  }

  double value(double v) const {
    const double q = 1.0 / (1.0 + c * std::abs(v));
    return h * v * q * ((1.0 - xi) + (1.0 + xi) * q);
  }

  /// mu(v), and its derivative mu'(v) = q^2 ((1+xi) q - xi)/v_r in `slope`.
  double value(double v, double& slope) const {
    const double q = 1.0 / (1.0 + c * std::abs(v));
    slope = 2.0 * h * q * q * ((1.0 + xi) * q - xi);
    return h * v * q * ((1.0 - xi) + (1.0 + xi) * q);
  }
};

}  // namespace tooljoint::contact
