// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/well/Frames.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "common/Error.hpp"

namespace tooljoint::well {
namespace {

/// Points closer than this have the same frame [m]: their chord is rounding and has no direction.
constexpr double samePlace = 1e-8;

Vector3 reflected(const Vector3& a, const Vector3& normal, double squaredNorm) {
  return a - (2.0 / squaredNorm * normal.dot(a)) * normal;
}

/// Carries x from one point to the next by two reflections: in the bisecting plane of the chord,
/// then in the plane that takes the reflected tangent to the new one.
Vector3 doubleReflection(const WellPoint& from, const WellPoint& to, const Vector3& x) {
  const Vector3 chord = to.position - from.position;
  const double c1 = chord.squaredNorm();
  const Vector3 xLeft = reflected(x, chord, c1);
  const Vector3 tLeft = reflected(from.tangent, chord, c1);
  const Vector3 v = to.tangent - tLeft;
  const Vector3 carried = reflected(xLeft, v, v.squaredNorm());
  return (carried - carried.dot(to.tangent) * to.tangent).normalized();
}

/// Carries x along a stretch without curvature jumps inside. Starts at `point` and moves it to
/// `to`.
void transport(const Trajectory& trajectory, double from, double to, WellPoint& point, Vector3& x) {
  if (to - from < samePlace) {
    point = trajectory.at(to);
    return;
  }
  // local error of a step is of order (kappa h)^5, so kappa h <= 2e-3 leaves nothing above rounding
  const double kappa = std::max(point.curvature.norm(), trajectory.at(to).curvature.norm());
  const double step = std::min(0.25, 2e-3 / std::max(kappa, 1e-12));
  const int count = std::max(1, static_cast<int>(std::ceil((to - from) / step)));
  for (int i = 1; i <= count; ++i) {
    const double s = i == count ? to : from + (to - from) * i / count;
    const WellPoint next = trajectory.at(s);
    x = doubleReflection(point, next, x);
    point = next;
  }
}

}  // namespace

Matrix3 smallestRotation(const Vector3& from, const Vector3& to) {
  const double cosine = from.dot(to);
  if (cosine < -1.0 + 1e-12)
    throw ModelError(
        "The smallest rotation between opposite directions is not defined: a well cannot start "
        "straight upwards.");
  // R = I + [w]x + [w]x^2/(1 + cos), w = from x to
  const Vector3 w = from.cross(to);
  Matrix3 cross;
  cross << 0.0, -w.z(), w.y(), w.z(), 0.0, -w.x(), -w.y(), w.x(), 0.0;
  return Matrix3::Identity() + cross + cross * cross / (1.0 + cosine);
}

Vector3 highSide(const Vector3& tangent) {
  constexpr double vertical = 1e-6;  // [rad]
  const bool hasHighSide = std::hypot(tangent.x(), tangent.y()) > vertical;
  const Vector3 towards = hasHighSide ? Vector3(-Vector3::UnitZ()) : Vector3(Vector3::UnitX());
  return (towards - towards.dot(tangent) * tangent).normalized();
}

std::vector<Matrix3> bishopFrames(const Trajectory& trajectory, const std::vector<double>& s) {
  std::vector<double> breaks = trajectory.breaks();
  auto nextBreak = breaks.begin();
  WellPoint point = trajectory.at(0.0);
  Vector3 x = smallestRotation(Vector3::UnitZ(), point.tangent).col(0);
  double depth = 0.0;
  std::vector<Matrix3> frames;
  frames.reserve(s.size());
  for (const double target : s) {
    if (target < depth - 1e-9)
      throw ModelError(
          "Frames are requested at decreasing depths along the well, or above the surface.");
    while (nextBreak != breaks.end() && *nextBreak < target) {
      if (*nextBreak > depth) {
        transport(trajectory, depth, *nextBreak, point, x);
        depth = *nextBreak;
      }
      ++nextBreak;
    }
    if (target > depth) {
      transport(trajectory, depth, target, point, x);
      depth = target;
    }
    Matrix3 frame;
    frame.col(0) = x;
    frame.col(1) = point.tangent.cross(x);
    frame.col(2) = point.tangent;
    frames.push_back(frame);
  }
  return frames;
}

}  // namespace tooljoint::well
