// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One-sided contact of K. H. Hunt and F. R. E. Crossley, J. Appl. Mech. 42 (1975), for walls,
/// stops and other obstacles.
#pragma once

#include <algorithm>
#include <cmath>

namespace tooljoint::model {

/// A normal force with its derivatives with respect to penetration and rate of penetration.
struct NormalForce {
  double value = 0.0;
  double dG = 0.0;
  double dRate = 0.0;
};

/// F = k g^n max(0, 1 + chi G') for the penetration G, with
///
///     g = 0 for G <= -s,   (G + s)^2 / 4s in between,   G for G >= s
///
/// Starts and ends at zero, because the damping grows with the penetration; never pulls.
class HuntCrossley {
 public:
  /// n >= 1, chi >= 0 [s/m], s >= 0 [m].
  explicit HuntCrossley(double exponent = 1.0, double dissipation = 0.0, double smoothing = 0.0)
      : n_(exponent), chi_(dissipation), s_(smoothing) {}

  /// F for the stiffness k [N/m^n].
  double forceOnly(double k, double G, double rate) const {
    if (G <= -s_) return 0.0;
    const double g = ramp(G);
    return std::max(0.0, k * g * power(g) * (1.0 + chi_ * rate));
  }

  NormalForce force(double k, double G, double rate) const {
    const double loss = 1.0 + chi_ * rate;
    if (G <= -s_ || loss <= 0.0) return {};
    const double g = ramp(G), slope = k * power(g);
    return {slope * g * loss, n_ * slope * rampSlope(G) * loss, slope * g * chi_};
  }

  /// F at rest and its derivative.
  double elastic(double k, double G, double& dG) const {
    dG = 0.0;
    if (G <= -s_) return 0.0;
    const double g = ramp(G), slope = k * power(g);
    dG = n_ * slope * rampSlope(G);
    return slope * g;
  }

  /// int F dG at rest [J].
  double energy(double k, double G) const {
    if (G <= -s_) return 0.0;
    if (G < s_) return k * (G + s_) * std::pow(ramp(G), n_) / (2.0 * n_ + 1.0);
    // excess over a force that begins at once, due to the transition
    const double extra =
        s_ > 0.0 ? std::pow(s_, n_ + 1.0) * (2.0 / (2.0 * n_ + 1.0) - 1.0 / (n_ + 1.0)) : 0.0;
    return k * (G * G * power(G) / (n_ + 1.0) + extra);
  }

  /// Separation beyond which there is no force [m].
  double reach() const { return s_; }

 private:
  double ramp(double G) const { return G >= s_ ? G : (G + s_) * (G + s_) / (4.0 * s_); }
  double rampSlope(double G) const { return G >= s_ ? 1.0 : (G + s_) / (2.0 * s_); }
  /// g^(n-1)
  double power(double g) const {
    if (n_ == 1.0) return 1.0;
    return n_ == 1.5 ? std::sqrt(g) : std::pow(g, n_ - 1.0);
  }

  double n_, chi_, s_;
};

}  // namespace tooljoint::model
