// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Regenerative cutting by blades: the depth of cut of a blade is measured from the surface left by
/// the previous blade, so forces depend on earlier motion.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <optional>

#include "common/Constants.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "model/laws/Coulomb.hpp"
#include "model/laws/DelayLine.hpp"
#include "model/laws/FormulaLaw.hpp"

namespace tooljoint::model {

/// A drag bit of blades with wear flats (E. Detournay and P. Defourny, Int. J. Rock Mech. Min. Sci.
/// 29 (1992) 13-23).
struct CuttingParameters {
  int blades = 1;                 ///< n
  double radius = 0;              ///< a [m]
  double specificEnergy = 0;      ///< eps [J/m3]: energy to remove a volume of rock
  double inclination = 0;         ///< zeta: axial over tangential cutting force
  double wearFlat = 0;            ///< l, width of the wear flat of one blade [m]
  double contactStress = 0;       ///< sigma at the wear flats [Pa]
  double friction = 0;            ///< mu gamma: friction coefficient times bit geometry
  double axialVelocity = 1e-5;    ///< advance above which the wear flats carry fully [m/s]
  double angularVelocity = 1e-2;  ///< rotary speed above which rock resists fully [rad/s]
  int samples = 256;              ///< of the surface between two blades
};

/// T. Richard, C. Germay and E. Detournay, J. Sound Vib. 305 (2007) 432-456, in the advance U
/// (first coordinate, positive into the rock) and the angle phi of the bit (second one). With the
/// surface S(phi) left by the previous blade,
///
///     delta = max(0, U - S'),  S(phi) = max(U, S'),  S' = S(phi - 2 pi/n),  v = U',  w = phi'
///     W = c(w) n a zeta eps delta + g(v) n a l sigma
///     T = s+(w) n a^2 eps delta/2 + s(w) g(v) n mu gamma a^2 l sigma/2
///
/// and the forces -W, -T. The surface is stored over the angle and not over time, so the delay t_n
/// of phi(t) - phi(t - t_n) = 2 pi/n need not be solved for, and a bit off bottom (U < S') cuts
/// nothing and does not change the surface. g: 0 for a retreating bit, rising to 1 at the axial
/// velocity of the parameters; in between the wear flats carry any share. s: the sign of w,
/// smoothed over the angular velocity; s+: its positive part; c: 1 for w >= 0, falling to 0 over
/// the same width for w < 0. A bit that turns backward does not cut and does not change the
/// surface. When it turns forward again, it meets its own cut: behind the foremost angle S' =
/// max(S(phi), S(phi - 2 pi/n)), with transitions within two samples.
class RegenerativeCutting : public Formula<2> {
 public:
  /// Throws ModelError for parameters out of their range.
  explicit RegenerativeCutting(const CuttingParameters& p)
      : p_(p),
        pitch_(constants::twoPi / p.blades),
        surface_(1, 2 * pitch_, 2 * p.samples, DelayLine::Shape::Monotone),
        cutting_(p.blades * p.radius * p.specificEnergy),
        wear_(p.blades * p.radius * p.wearFlat * p.contactStress) {}

  int held() const { return Track::size + surface_.states(); }

  /// Before the start: steady drilling at the speeds of the start, or a flat bottom at the bit if
  /// it does not turn.
  void initial(double, const double* d, const double* v, double* x) const {
    const double slope = v[1] > p_.angularVelocity ? std::max(0.0, v[0] / v[1]) : 0.0;
    std::fill(x, x + Track::size, 0.0);
    x[Track::U] = d[0];
    x[Track::phi] = d[1];
    surface_.start(d[1], d, &slope, x + Track::size);
  }

  /// Extends the surface if the bit is beyond its foremost angle. A cut behind that angle is added
  /// to the surface at the end of the forward motion.
  void accept(double, const double* d, const double* v, double* held) const {
    double before = 0, slope = 0;
    behind(d[1], held, before, slope);
    double* surface = held + Track::size;
    const double newest = surface_.newest(surface);
    followAgain(d, held, newest);
    held[Track::U] = d[0];
    held[Track::phi] = d[1];
    const bool cuts = d[0] > before;
    const double S = cuts ? d[0] : before;
    if (d[1] > newest) {
      if (cuts) slope = v[1] > p_.angularVelocity ? v[0] / v[1] : 0.0;
      surface_.append(d[1], &S, &slope, surface);
    } else if (d[1] > newest - surface_.spacing() && v[1] > -p_.angularVelocity) {
      surface_.raise(newest, &S, newest, &S, surface);  // same angle, deeper
    }
  }

  template <class T>
  void operator()(const PointAt<T>& at, T* f, T*) const {
    const T chip = depth(at), g = contact(at.v[0]), s = smoothedSign(at.v[1], p_.angularVelocity);
    const T forward = s > 0.0 ? s : T(0.0);
    const T faces = s < 0.0 ? T(1.0 + s) : T(1.0);
    f[0] = -(faces * cutting_ * p_.inclination * chip + wear_ * g);
    f[1] = -0.5 * p_.radius * (forward * cutting_ * chip + s * p_.friction * wear_ * g);
  }

  /// The bit cuts the surface it left one pitch before: 1 - e^{-s tau}, tau = (2 pi/n) / w.
  std::optional<std::complex<double>> heldFactor(std::complex<double> s, const double*,
                                                 const double* v) const {
    if (v[1] <= p_.angularVelocity) return 1.0;
    return 1.0 - std::exp(-s * pitch_ / v[1]);
  }

  /// All work on the rock is dissipated in cutting and friction.
  Power power(const PointAt<double>& at, const double*) const { return lostPower(*this, at); }

  /// Weight [N] and torque [N m] of steady drilling at an advance `depth` of one blade [m].
  double weight(double depth) const { return cutting_ * p_.inclination * depth + wear_; }
  double torque(double depth) const {
    return 0.5 * p_.radius * (cutting_ * depth + p_.friction * wear_);
  }
  double pitch() const { return pitch_; }  ///< angle between blades [rad]

 private:
  /// Held states before those of the surface: U and phi of the last step. For a bit that has turned
  /// back: whether it is behind its foremost angle, whether it moves forward there, and from where.
  struct Track {
    enum { U, phi, again, onTheWay, fromU, fromPhi, size };
  };

  /// Motion of a bit behind its foremost angle: at its end each forward motion deepens the surface.
  void followAgain(const double* d, double* held, double foremost) const {
    const double U = held[Track::U], phi = held[Track::phi];
    if (held[Track::again] == 0.0 && d[1] < foremost) {
      held[Track::again] = 1.0;
      held[Track::onTheWay] = 0.0;
    }
    if (held[Track::again] == 0.0) return;
    const bool forward = d[1] > phi, arrives = d[1] >= foremost;
    if (forward && held[Track::onTheWay] == 0.0) {
      held[Track::onTheWay] = 1.0;
      held[Track::fromU] = U;
      held[Track::fromPhi] = phi;
    }
    if (held[Track::onTheWay] != 0.0 && (!forward || arrives)) {
      const double share = arrives ? (foremost - phi) / (d[1] - phi) : 0.0,
                   end = U + share * (d[0] - U);
      surface_.raise(held[Track::fromPhi], held + Track::fromU, arrives ? foremost : phi, &end,
                     held + Track::size);
      held[Track::onTheWay] = 0.0;
    }
    if (arrives) held[Track::again] = 0.0;
  }

  /// S' and its slope.
  void behind(double phi, const double* held, double& S, double& slope) const {
    const double* surface = held + Track::size;
    const double angle = phi - pitch_, newest = surface_.newest(surface);
    if (angle > newest)
      throw ConvergenceError(
          "A bit of " + std::to_string(p_.blades) + " blades turns by " +
          formatNumber(std::round(100 * (phi - newest)) / 100) +
          " rad in a step, more than the angle between its blades. Reduce Transient/Step.");
    surface_.at(std::max(angle, surface_.oldest(surface)), surface, &S, &slope);
    // The rock in front of a blade that moves forward again starts one sample ahead of it.
    const double ahead = phi + surface_.spacing();
    if (held[Track::again] == 0.0 || ahead >= newest) return;
    double own = 0, ownSlope = 0;
    surface_.at(std::max(ahead, surface_.oldest(surface)), surface, &own, &ownSlope);
    if (own <= S) return;
    const double away = (newest - ahead) / surface_.spacing(), share = std::min(away, 1.0);
    slope += share * (ownSlope - slope) - (away < 1.0 ? (own - S) / surface_.spacing() : 0.0);
    S += share * (own - S);
  }

  template <class T>
  T depth(const PointAt<T>& at) const {
    double S = 0, slope = 0;
    const double phi = value(at.d[1]);
    behind(phi, at.held, S, slope);
    const T chip = at.d[0] - S - slope * (at.d[1] - phi);
    return chip > 0.0 ? chip : T(0.0);
  }
  /// 0 for v <= 0, s^2 (3 - 2 s) with s = v/v_r, 1 for v >= v_r.
  template <class T>
  T contact(const T& v) const {
    if (v <= 0.0) return T(0.0);
    if (v >= p_.axialVelocity) return T(1.0);
    const T s = v / p_.axialVelocity;
    return s * s * (3.0 - 2.0 * s);
  }
  static double value(double x) { return x; }
  template <class T>
  static double value(const T& x) {
    return x.value();
  }

  CuttingParameters p_;
  double pitch_;
  DelayLine surface_;
  double cutting_;  ///< n a eps [N/m]
  double wear_;     ///< n a l sigma [N]
};

}  // namespace tooljoint::model
