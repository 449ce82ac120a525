// SPDX-License-Identifier: BSD-3-Clause
// Dry friction that weakens with speed: belts, brakes, bits.
#include <cmath>

#include "deck/RequireAtMost.hpp"
#include "model/laws/Coulomb.hpp"
#include "model/laws/PointLawRegistry.hpp"

namespace tooljoint::model {
namespace {

/// f = -c v - [F_d + (F_s - F_d) exp(-|v|/v_s)] sign(v), with the sign smoothed over +-v_r: a
/// sticking point creeps at less than v_r.
struct Stribeck : Formula<1> {
  static constexpr bool walls = false;
  double c, Fs, Fd, vs, vr;
  explicit Stribeck(const Teuchos::ParameterList& list)
      : c(list.get<double>("Viscous Damping")),
        Fs(list.get<double>("Static Force")),
        Fd(list.get<double>("Dynamic Force")),
        vs(list.get<double>("Decay Velocity")),
        vr(list.get<double>("Slip Velocity")) {
    deck::requireAtMost(list, "Dynamic Force", "Static Force",
                        "Friction that weakens with speed needs it at or below.");
  }

  template <class T>
  T dry(const T& v) const {
    using std::abs;
    using std::exp;
    return (Fd + (Fs - Fd) * exp(T(-abs(v) / vs))) * smoothedSign(v, vr);
  }
  template <class T>
  void operator()(const PointAt<T>& at, T* f, T*) const {
    f[0] = -c * at.v[0] - dry(at.v[0]);
  }
  Power power(const PointAt<double>& at, const double*) const {
    const double v = at.v[0];
    Power p;
    p.damping = c * v * v;
    p.friction = dry(v) * v;
    return p;
  }
};

const bool stribeckRegistered = registerFormula<Stribeck>(
    deck::ListSpec("Stribeck",
                   "Dry friction that weakens exponentially with speed, and viscous friction "
                   "(E. M. Navarro-Lopez and D. Cortes, J. Sound Vib. 307 (2007) 152-171, for the "
                   "torque on a bit).")
        .real("Static Force", "N", deck::Required{}, deck::Range::positive(),
              "Friction F_s at the slowest sliding, or moment about a rotation.")
        .real("Dynamic Force", "N", deck::Required{}, deck::Range::nonNegative(),
              "Friction F_d of fast sliding; at most the static one.")
        .real("Decay Velocity", "m/s", deck::Required{}, deck::Range::positive(),
              "Velocity v_s over which friction falls from the one to the other by e.")
        .real("Viscous Damping", "N s/m", 0.0, deck::Range::nonNegative(),
              "Coefficient c of the viscous part.")
        .real("Slip Velocity", "m/s", 1e-3, deck::Range::positive(),
              "Regularisation velocity v_r: dry friction is full from there on.")
        .expert());

}  // namespace
}  // namespace tooljoint::model
