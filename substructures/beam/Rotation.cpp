// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/beam/Rotation.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace tooljoint::beam {
namespace {

/// Below this angle the coefficients come from their series (truncation below 1e-16).
constexpr double kSmallAngle = 0.02;

/// eta(a) = (1 - (a/2) cot(a/2)) / a^2.
double eta(double a) {
  if (a < kSmallAngle) return 1.0 / 12.0 + a * a / 720.0 + a * a * a * a / 30240.0;
  return (1.0 - 0.5 * a / std::tan(0.5 * a)) / (a * a);
}

/// (d eta/d a) / a.
double etaSlope(double a) {
  if (a < 5.0 * kSmallAngle) return 1.0 / 360.0 + a * a / 7560.0 + a * a * a * a / 201600.0;
  const double s = std::sin(0.5 * a);
  return (a * (a + std::sin(a)) - 8.0 * s * s) / (4.0 * a * a * a * a * s * s);
}

}  // namespace

Matrix3 skew(const Vector3& v) {
  Matrix3 s;
  s << 0.0, -v.z(), v.y(), v.z(), 0.0, -v.x(), -v.y(), v.x(), 0.0;
  return s;
}

Matrix3 rotationExponential(const Vector3& theta) {
  const double a = theta.norm();
  // sin a/a and (1 - cos a)/a^2 = 2 (sin(a/2)/a)^2
  const double first =
      a < kSmallAngle ? 1.0 - a * a / 6.0 + a * a * a * a / 120.0 : std::sin(a) / a;
  const double half =
      a < kSmallAngle ? 0.5 - a * a / 48.0 + a * a * a * a / 3840.0 : std::sin(0.5 * a) / a;
  const Matrix3 s = skew(theta);
  return Matrix3::Identity() + first * s + 2.0 * half * half * s * s;
}

Vector3 rotationLogarithm(const Matrix3& rotation) {
  const Eigen::Quaterniond q(rotation);
  const double sine = q.vec().norm();
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  // theta = 2 atan2(|q|, q0) q/|q|
  const double factor = sine > 1e-9 ? 2.0 * std::atan2(sine, sign * q.w()) / sine : 2.0;
  return sign * factor * q.vec();
}

Matrix3 spinFromRotationVector(const Vector3& theta) {
  const double a = theta.norm();
  const Matrix3 s = skew(theta);
  // T_s = I + (1 - cos a)/a^2 theta^ + (a - sin a)/a^3 theta^^2
  if (a < kSmallAngle)
    return Matrix3::Identity() + (0.5 - a * a / 24.0 + a * a * a * a / 720.0) * s +
           (1.0 / 6.0 - a * a / 120.0 + a * a * a * a / 5040.0) * s * s;
  return Matrix3::Identity() + (1.0 - std::cos(a)) / (a * a) * s +
         (a - std::sin(a)) / (a * a * a) * s * s;
}

Matrix3 rotationVectorFromSpin(const Vector3& theta) {
  const Matrix3 s = skew(theta);
  return Matrix3::Identity() - 0.5 * s + eta(theta.norm()) * s * s;
}

Matrix3 inverseSpinTransposeDerivative(const Vector3& theta, const Vector3& v) {
  // T_s^-T v = v + theta x v/2 + eta theta x (theta x v)
  const double a = theta.norm();
  const Vector3 once = theta.cross(v);
  const Vector3 twice = theta.cross(once);
  return -0.5 * skew(v) - eta(a) * (skew(once) + skew(theta) * skew(v)) +
         etaSlope(a) * twice * theta.transpose();
}

}  // namespace tooljoint::beam
