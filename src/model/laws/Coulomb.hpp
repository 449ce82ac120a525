// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Coulomb friction, smoothed about zero sliding velocity in two ways: a direction for forces
/// across a normal or along a coordinate, and a coefficient with a peak.
#pragma once

#include <cmath>

namespace tooljoint::model {

/// -F w/|w|_r with |w|_r = sqrt(|w|^2 + v_r^2) for a sliding velocity w of one or more components.
class SmoothedSliding {
 public:
  /// v_r > 0 [m/s, rad/s]; w must outlive this.
  SmoothedSliding(const double* w, int components, double velocity)
      : w_(w), components_(components), velocity_(velocity) {
    double square = velocity * velocity;
    for (int i = 0; i < components; ++i) square += w[i] * w[i];
    size_ = std::sqrt(square);
  }
  /// |w|_r
  double size() const { return size_; }
  /// Force in component i for the friction force F.
  double force(int i, double F) const { return -F * w_[i] / size_; }
  /// Its derivative with respect to F.
  double direction(int i) const { return -(w_[i] / size_); }
  /// Its derivative with respect to w_j: -F (delta_ij - w_i w_j / |w|_r^2) / |w|_r.
  double slope(int i, int j, double F) const {
    if (components_ == 1) return -F * velocity_ * velocity_ / (size_ * size_ * size_);
    return -F * ((i == j ? 1.0 : 0.0) - w_[i] / size_ * w_[j] / size_) / size_;
  }
  /// Power lost in component i.
  double loss(int i, double F) const { return F * w_[i] * w_[i] / size_; }

 private:
  const double* w_;
  int components_;
  double velocity_, size_;
};

/// sign w, smoothed over +-width: s (3 - s^2)/2 with s = w/width, exactly +-1 beyond.
template <class T>
T smoothedSign(const T& w, double width) {
  if (w >= width) return T(1.0);
  if (w <= -width) return T(-1.0);
  const T s = w / width;
  return 0.5 * s * (3.0 - s * s);
}

/// Coefficient of Nguyen et al. 2020, eq. (9):
///
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

  /// mu(v)/v for v >= 0 [s/m]; 1/v_r at zero.
  double overSpeed(double v) const {
    const double q = 1.0 / (1.0 + c * v);
    return h * q * ((1.0 - xi) + (1.0 + xi) * q);
  }
};

/// Sliding velocity in the plane of a wall [m/s].
struct SlidingVelocity {
  double around = 0.0, along = 0.0;
};

/// mu(v) (v_c, v_a)/v for a sliding velocity (v_c, v_a) of magnitude v: Coulomb friction of
/// magnitude mu N against the whole velocity.
struct SlidingFriction {
  double around = 0.0, along = 0.0;

  SlidingFriction(const FrictionCurve& curve, const SlidingVelocity& v) {
    const double overSpeed = curve.overSpeed(std::sqrt(v.around * v.around + v.along * v.along));
    around = overSpeed * v.around;
    along = overSpeed * v.along;
  }
};

/// Derivatives of SlidingFriction: mu/v (I - e e') + mu' e e' with e = (v_c, v_a)/v; I/v_r at rest.
struct SlidingFrictionSlope {
  double aroundAround = 0.0, aroundAlong = 0.0, alongAlong = 0.0;  ///< [s/m]; symmetric

  SlidingFrictionSlope(const FrictionCurve& curve, const SlidingVelocity& v) {
    const double size = std::sqrt(v.around * v.around + v.along * v.along);
    double slope = 0.0;
    curve.value(size, slope);
    const double across = curve.overSpeed(size), more = slope - across;
    const double ec = size > 0.0 ? v.around / size : 0.0, ea = size > 0.0 ? v.along / size : 0.0;
    aroundAround = across + more * ec * ec;
    aroundAlong = more * ec * ea;
    alongAlong = across + more * ea * ea;
  }
};

}  // namespace tooljoint::model
