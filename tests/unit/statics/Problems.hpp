// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small nonlinear problems with known solutions.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "model/NonlinearProblem.hpp"

namespace tooljoint::testing {

/// Any residual and dense Jacobian as a problem; rows may be weighted, steps capped.
struct DenseProblem : model::NonlinearProblem {
  std::function<Vector(const Vector&)> r;
  std::function<Matrix(const Vector&)> J;
  Vector weight;
  double cap = 0.0;  ///< largest |dx_i| of a step; 0: none

  DenseProblem(int n, std::function<Vector(const Vector&)> residual_, std::function<Matrix(const Vector&)> jacobian_)
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
  return {2, [](const Vector& x) -> Vector { return Eigen::Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]); },
          [](const Vector& x) -> Matrix {
            Matrix J(2, 2);
            J << -20.0 * x[0], 10.0, -1.0, 0.0;
            return J;
          }};
}

/// A string of masses on soft springs between two walls, each pushed against a stop at distance `gap` with a smoothed
/// contact law: force (k_c / pi) atan2(1, -pi lambda g) g for a penetration g.
struct ContactChain : model::NonlinearProblem {
  int n;
  double load, spring = 1e3, contact = 1e7, gap = 0.01, sharpness;

  ContactChain(int count, double force, double lambda) : n(count), load(force), sharpness(lambda) {}
  int size() const override { return n; }
  double stiffness(double g) const { return contact / M_PI * std::atan2(1.0, -M_PI * sharpness * g); }
  double slope(double g) const { return contact * sharpness / (1.0 + std::pow(M_PI * sharpness * g, 2)); }
  void residual(const Vector& x, Vector& r) const override {
    r.resize(n);
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? x[i - 1] : 0.0, right = i + 1 < n ? x[i + 1] : 0.0, g = std::abs(x[i]) - gap;
      r[i] =
          spring * (2.0 * x[i] - left - right) + stiffness(g) * g * (x[i] < 0.0 ? -1.0 : 1.0) - load * (1.0 + 0.3 * std::sin(i));
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

/// Masses on soft springs held by dry friction 2/pi atan(x/width): far from the solution the slope is that of the springs
/// alone and full Newton steps jump to and fro; near it the friction is stiff.
struct FrictionChain : model::NonlinearProblem {
  int n;
  double spring = 1.0, friction = 100.0, width = 1e-3, load = 20.0;

  explicit FrictionChain(int count) : n(count) {}
  int size() const override { return n; }
  void residual(const Vector& x, Vector& r) const override {
    r.resize(n);
    for (int i = 0; i < n; ++i) {
      const double left = i > 0 ? x[i - 1] : 0.0, right = i + 1 < n ? x[i + 1] : 0.0;
      r[i] = spring * (2.0 * x[i] - left - right) + friction * 2.0 / M_PI * std::atan(x[i] / width) - load;
    }
  }
  void jacobian(const Vector& x, Sparse& J) const override {
    Triplets t;
    for (int i = 0; i < n; ++i) {
      t.emplace_back(i, i, 2.0 * spring + friction * 2.0 / M_PI * width / (width * width + x[i] * x[i]));
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
