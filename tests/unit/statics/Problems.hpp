// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small nonlinear problems with known solutions.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>

#include "common/Constants.hpp"
#include "model/NonlinearProblem.hpp"

namespace tooljoint::testing {

/// Any residual and dense Jacobian as a problem; rows may be weighted, steps capped.
struct DenseProblem : model::NonlinearProblem {
  std::function<Vector(const Vector&)> r;
  std::function<Matrix(const Vector&)> J;
  Vector weight;
  double cap = 0.0;  ///< largest |dx_i| of a step; 0: none

  DenseProblem(int n, std::function<Vector(const Vector&)> residual_,
               std::function<Matrix(const Vector&)> jacobian_)
      : r(std::move(residual_)), J(std::move(jacobian_)), weight(Vector::Ones(n)) {}
  int size() const override { return static_cast<int>(weight.size()); }
  void residual(const Vector& x, Vector& out) const override { out = r(x); }
  void jacobian(const Vector& x, Sparse& out) const override {
    const Matrix dense = J(x);
    Triplets all;
    for (int i = 0; i < dense.rows(); ++i)
      for (int j = 0; j < dense.cols(); ++j) all.emplace_back(i, j, dense(i, j));
    out.resize(size(), size());
    out.setFromTriplets(all.begin(), all.end());
  }
  Vector residualScale() const override { return weight; }
  double stepLimit(const Vector&, const Vector& dx) const override {
    const double largest = dx.cwiseAbs().maxCoeff();
    return cap > 0.0 && largest > cap ? cap / largest : 1.0;
  }
  std::string unknownName(int i) const override { return "x" + std::to_string(i + 1); }
};

/// Rosenbrock's valley as a system: 10 (x2 - x1^2) = 0, 1 - x1 = 0; solution (1, 1).
inline DenseProblem rosenbrock() {
  return {2,
          [](const Vector& x) -> Vector {
            return Eigen::Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]);
          },
          [](const Vector& x) -> Matrix {
            Matrix J(2, 2);
            J << -20.0 * x[0], 10.0, -1.0, 0.0;
            return J;
          }};
}

/// A string of masses on soft springs between two walls, each pushed against a stop at distance
/// `gap` with a smoothed contact law: force (k_c / pi) atan2(1, -pi lambda g) g for a penetration
/// g.
struct ContactChain : model::NonlinearProblem {
  int n;
  double load, spring = 1e3, contact = 1e7, gap = 0.01, sharpness;

  ContactChain(int count, double force, double lambda) : n(count), load(force), sharpness(lambda) {}
  int size() const override { return n; }
  double stiffness(double g) const {
    return contact / constants::pi * std::atan2(1.0, -constants::pi * sharpness * g);
  }
  double slope(double g) const {
    return contact * sharpness / (1.0 + std::pow(constants::pi * sharpness * g, 2));
  }
  void residual(const Vector& x, Vector& r) const override {
    r.resize(n);
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? x[i - 1] : 0.0, right = i + 1 < n ? x[i + 1] : 0.0,
                   g = std::abs(x[i]) - gap;
      r[i] = spring * (2.0 * x[i] - left - right) + stiffness(g) * g * (x[i] < 0.0 ? -1.0 : 1.0) -
             load * (1.0 + 0.3 * std::sin(i));
    }
  }
  void jacobian(const Vector& x, Sparse& J) const override {
    Triplets t;
    for (int i = 0; i < n; ++i) {
      const double g = std::abs(x[i]) - gap;
      t.emplace_back(i, i, 2.0 * spring + stiffness(g) + slope(g) * g);
      if (i > 0) t.emplace_back(i, i - 1, -spring);
      if (i + 1 < n) t.emplace_back(i, i + 1, -spring);
    }
    J.resize(n, n);
    J.setFromTriplets(t.begin(), t.end());
  }
  Vector residualScale() const override { return Vector::Constant(n, 1.0 / load); }
  std::string unknownName(int i) const override { return "u of node " + std::to_string(i + 1); }
};

/// A string of masses from the axis to the axis of a smooth round hole, under loads that turn along
/// it. Its stiff wall only pushes, with (k_c / pi)(atan2(1, -pi lambda g) g + 1/(pi lambda)) at a
/// penetration g. Unknowns u1 v1 u2 v2 ...
struct StringInHole : model::NonlinearProblem {
  int n;
  double spring = 1e4, load = 10.0, wall = 1e10, sharpness = 1e6, radius = 0.03;
  bool slides = true;  ///< steps along the wall, not along its tangent

  explicit StringInHole(int count) : n(count) {}
  int size() const override { return 2 * n; }
  double force(double g) const {
    return wall / constants::pi *
           (std::atan2(1.0, -constants::pi * sharpness * g) * g +
            1.0 / (constants::pi * sharpness));
  }
  double slope(double g) const {
    const double x = constants::pi * sharpness * g;
    return wall / constants::pi * (std::atan2(1.0, -x) + x / (1.0 + x * x));
  }
  void residual(const Vector& x, Vector& r) const override {
    r.resize(size());
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d here = x.segment<2>(2 * i), zero = Eigen::Vector2d::Zero();
      const Eigen::Vector2d left = i > 0 ? Eigen::Vector2d(x.segment<2>(2 * i - 2)) : zero;
      const Eigen::Vector2d right = i + 1 < n ? Eigen::Vector2d(x.segment<2>(2 * i + 2)) : zero;
      const double distance = std::hypot(here.norm(), 1e-9), angle = 4.0 * i / n;
      r.segment<2>(2 * i) = spring * (2.0 * here - left - right) +
                            force(distance - radius) / distance * here -
                            load * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    }
  }
  void jacobian(const Vector& x, Sparse& J) const override {
    Triplets t;
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector2d here = x.segment<2>(2 * i);
      const double distance = std::hypot(here.norm(), 1e-9),
                   across = force(distance - radius) / distance;
      const Eigen::Matrix2d k =
          (2.0 * spring + across) * Eigen::Matrix2d::Identity() +
          (slope(distance - radius) - across) / (distance * distance) * here * here.transpose();
      for (int a = 0; a < 4; ++a) t.emplace_back(2 * i + a / 2, 2 * i + a % 2, k(a / 2, a % 2));
      for (int a = 0; a < 2 && i + 1 < n; ++a) {
        t.emplace_back(2 * i + a, 2 * i + 2 + a, -spring);
        t.emplace_back(2 * i + 2 + a, 2 * i + a, -spring);
      }
    }
    J.resize(size(), size());
    J.setFromTriplets(t.begin(), t.end());
  }
  Vector residualScale() const override { return Vector::Constant(size(), 1.0 / load); }
  double stepLimit(const Vector&, const Vector& dx) const override {
    return std::min(1.0, 0.05 / dx.cwiseAbs().maxCoeff());
  }
  Vector moved(const Vector& x, const Vector& dx, double s) const override {
    Vector there = x + s * dx;
    for (int i = 0; slides && i < n; ++i) {
      const Eigen::Vector2d before = x.segment<2>(2 * i), after = there.segment<2>(2 * i);
      const double alongNormal = before.dot(after) / before.norm();
      if (after.norm() > radius && alongNormal > 0.5 * after.norm())
        there.segment<2>(2 * i) *= alongNormal / after.norm();
    }
    return there;
  }
  std::string unknownName(int i) const override {
    return (i % 2 == 0 ? "u of node " : "v of node ") + std::to_string(i / 2 + 1);
  }
};

/// Masses on soft springs held by dry friction 2/pi atan(x/width): far from the solution the slope
/// is that of the springs alone and full Newton steps oscillate; near it the friction is stiff.
struct FrictionChain : model::NonlinearProblem {
  int n;
  double spring = 1.0, friction = 100.0, width = 1e-3, load = 20.0;

  explicit FrictionChain(int count) : n(count) {}
  int size() const override { return n; }
  void residual(const Vector& x, Vector& r) const override {
    r.resize(n);
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? x[i - 1] : 0.0, right = i + 1 < n ? x[i + 1] : 0.0;
      r[i] = spring * (2.0 * x[i] - left - right) +
             friction * 2.0 / constants::pi * std::atan(x[i] / width) - load;
    }
  }
  void jacobian(const Vector& x, Sparse& J) const override {
    Triplets t;
    for (int i = 0; i < n; ++i) {
      t.emplace_back(
          i, i,
          2.0 * spring + friction * 2.0 / constants::pi * width / (width * width + x[i] * x[i]));
      if (i > 0) t.emplace_back(i, i - 1, -spring);
      if (i + 1 < n) t.emplace_back(i, i + 1, -spring);
    }
    J.resize(n, n);
    J.setFromTriplets(t.begin(), t.end());
  }
  Vector residualScale() const override { return Vector::Constant(n, 1.0 / load); }
  std::string unknownName(int i) const override { return "u of node " + std::to_string(i + 1); }
};

}  // namespace tooljoint::testing
