// SPDX-License-Identifier: BSD-3-Clause
// A motor with a speed controller: top drives, rotary tables, spindles.
#include <cmath>
#include <complex>
#include <limits>
#include <optional>

#include "common/Error.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

/// f = F_0 + k_p (V - v) + k_i e, limited to +-F_max, where e is the integral of the speed error V
/// - v. With the start at (t_0, d_0) it is known except for the correction x of the limit:
///
///     e = V (t - t_0) - (d - d_0) + x,   x' = (limited f - f)/k_p
///
/// (anti-windup by back-calculation with the tracking time k_p/k_i; K. J. Astrom and T. Hagglund,
/// Advanced PID Control, 2006, section 3.5). The states are x, and the held d_0 and t_0.
struct SpeedControl : Formula<1, 1, 2> {
  static constexpr bool walls = false;
  double V, kp, ki, F0, Fmax;
  explicit SpeedControl(const Teuchos::ParameterList& list)
      : V(list.get<double>("Speed")),
        kp(list.get<double>("Proportional Gain")),
        ki(list.get<double>("Integral Gain")),
        F0(list.get<double>("Initial Force")),
        Fmax(list.isParameter("Force Limit") ? list.get<double>("Force Limit")
                                             : std::numeric_limits<double>::infinity()) {
    if (ki > 0.0 && kp == 0.0 && std::isfinite(Fmax))
      throw DeckError(list.name() +
                      "/Force Limit with an Integral Gain needs a positive Proportional Gain, "
                      "which keeps the integral within the limit.");
  }

  void initial(double t, const double* d, const double*, double* x) const {
    x[0] = 0.0;
    x[1] = d[0];
    x[2] = t;
  }
  template <class T>
  T demand(const PointAt<T>& at) const {
    const T error = V * (at.t - at.held[1]) - (at.d[0] - at.held[0]) + at.x[0];
    return F0 + kp * (V - at.v[0]) + ki * error;
  }
  template <class T>
  void operator()(const PointAt<T>& at, T* f, T* g) const {
    const T wanted = demand(at);
    f[0] = wanted > Fmax ? T(Fmax) : wanted < -Fmax ? T(-Fmax) : wanted;
    g[0] = ki > 0.0 && kp > 0.0 ? T((f[0] - wanted) / kp) : T(0.0);
  }
  /// The held states are constants of the start.
  std::optional<std::complex<double>> heldFactor(std::complex<double>, const double*,
                                                 const double*) const {
    return 1.0;
  }
  Power power(const PointAt<double>& at, const double*) const {
    double f = 0.0, g = 0.0;
    (*this)(at, &f, &g);
    Power p;
    p.drive = f * at.v[0];
    return p;
  }
};

const bool speedControlRegistered = registerFormula<SpeedControl>(
    deck::ListSpec("Speed Control",
                   "Motor with a PI speed controller and a limit of its force; without gains a "
                   "constant force. Its inertia belongs to the part.")
        .real("Speed", "m/s", deck::Required{}, deck::Range::any(), "Set speed V.")
        .real("Proportional Gain", "N s/m", 0.0, deck::Range::nonNegative(),
              "Gain k_p on the speed error.")
        .real("Integral Gain", "N/m", 0.0, deck::Range::nonNegative(),
              "Gain k_i on the integral of the speed error, zero at the start.")
        .real("Initial Force", "N", 0.0, deck::Range::any(),
              "Force F_0 without any speed error, or moment about a rotation.")
        .expert()
        .real("Force Limit", "N", deck::Optional{}, deck::Range::positive(),
              "Largest force either way; no limit without it.")
        .expert());

}  // namespace
}  // namespace tooljoint::model
