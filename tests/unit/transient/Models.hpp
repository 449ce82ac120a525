// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small models and point laws with known motion, for the tests of the integrators.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "common/Constants.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::transient::testing {

/// Model with these dense matrices; one node per dof unless `perNode` says otherwise.
inline model::SecondOrderModel denseModel(const Matrix& M, const Matrix& C, const Matrix& K,
                                          int perNode = 1) {
  model::SecondOrderModel model;
  const int n = static_cast<int>(M.rows());
  model.componentNames = {"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  for (int i = 0; i < n; ++i)
    model.dofs.push_back(model::DofLabel::physical(1 + i / perNode, i % perNode));
  model.mass = M.sparseView();
  if (C.size() > 0) model.damping.push_back({"damping", C.sparseView(), 0});
  if (K.size() > 0) model.stiffness.push_back({"stiffness", K.sparseView(), 0});
  model.initialDisplacement = Vector::Zero(n);
  model.initialVelocity = Vector::Zero(n);
  return model;
}

inline Matrix scalar(double x) { return Matrix::Constant(1, 1, x); }

/// m q'' + c q' + k q = 0 with q(0), q'(0).
inline model::SecondOrderModel oscillator(double m, double c, double k, double q0, double v0) {
  auto model = denseModel(scalar(m), scalar(c), scalar(k));
  model.initialDisplacement[0] = q0;
  model.initialVelocity[0] = v0;
  return model;
}

/// Chain of n masses and n+1 springs between two walls.
inline model::SecondOrderModel springChain(int n, double m, double c, double k) {
  Matrix K = Matrix::Zero(n, n);
  for (int i = 0; i < n; ++i) {
    K(i, i) = 2 * k;
    if (i > 0) K(i, i - 1) = K(i - 1, i) = -k;
  }
  return denseModel(m * Matrix::Identity(n, n), (c / k) * K, K);
}

/// One-sided spring-damper at d = 0: force on a point at d < 0 is (-k d - c v) times a smoothed
/// step of sharpness lambda.
class Floor final : public model::PointLaw {
 public:
  Floor(int points, double k, double c, double lambda)
      : points_(points), k_(k), c_(c), lambda_(lambda) {}
  int size() const override { return points_; }
  int width() const override { return 1; }
  void evaluate(double, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override {
    for (int p : active) {
      const double s = step(-d[p]);
      f[p] = s * (-k_ * d[p] - c_ * v[p]);
    }
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v,
                           double* f, double* dfdd, double* dfdv) const override {
    for (int p : active) {
      const double s = step(-d[p]);
      const double x = constants::pi * lambda_ * d[p];
      const double slope = -lambda_ / (1 + x * x);  // ds/dd
      f[p] = s * (-k_ * d[p] - c_ * v[p]);
      dfdd[p] = -k_ * s + slope * (-k_ * d[p] - c_ * v[p]);
      dfdv[p] = -c_ * s;
    }
  }
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override {
    for (int p : points) gap[p] = d[p] - tail();
  }
  Power power(double, const std::vector<int>& points, const double* d,
              const double* v) const override {
    Power sum;
    for (int p : points) {
      if (d[p] < 0) sum.stored += 0.5 * k_ * d[p] * d[p];
      sum.damping += c_ * step(-d[p]) * v[p] * v[p];
    }
    return sum;
  }
  std::vector<model::Channel> channels() const override {
    return {{"force", "N", "Force of the floor."}, {"penetration", "m", "Depth below the floor."}};
  }
  void record(double t, const double* d, const double* v, double* out) const override {
    std::vector<int> all;
    for (int p = 0; p < points_; ++p) all.push_back(p);
    evaluate(t, all, d, v, out);
    for (int p = 0; p < points_; ++p) out[points_ + p] = std::max(0.0, -d[p]);
  }
  std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const override {
    return std::make_shared<Floor>(static_cast<int>(points.size()), k_, c_, lambda_);
  }

 private:
  /// 1 well inside, 0 well outside: atan2(1, -pi lambda g) / pi.
  double step(double g) const {
    return std::atan2(1.0, -constants::pi * lambda_ * g) / constants::pi;
  }
  double tail() const { return 30.0 / lambda_; }
  int points_;
  double k_, c_, lambda_;
};

/// A floor under every dof of a model.
inline void addFloor(model::SecondOrderModel& model, double k, double c, double lambda) {
  const int n = model.size();
  model::PointSet set;
  set.name = "floor";
  set.law = std::make_shared<Floor>(n, k, c, lambda);
  set.rows.resize(n, n);
  set.rows.setIdentity();
  set.offset = Vector::Zero(n);
  for (int i = 0; i < n; ++i) set.entities.push_back(i + 1);
  model.points.push_back(set);
}

/// Balls of 5 kg dropped on one floor from heights of 4 to 6 mm; with links between neighbours of
/// this stiffness.
inline model::SecondOrderModel droppedBalls(int n, double k, double c, double lambda,
                                            double link = 0) {
  Matrix K = Matrix::Zero(n, n);
  for (int i = 1; i < n; ++i) {
    K(i, i) += link, K(i - 1, i - 1) += link;
    K(i, i - 1) -= link, K(i - 1, i) -= link;
  }
  auto model = denseModel(5 * Matrix::Identity(n, n), Matrix(), K);
  model.loads.push_back({"weight", Vector::Constant(n, -5 * 9.81), 0});
  for (int i = 0; i < n; ++i)
    model.initialDisplacement[i] = 0.005 + 0.001 * std::sin(3.0 * i + 0.4);
  addFloor(model, k, c, lambda);
  return model;
}

/// Keeps all samples.
class Keep final : public SampleSink {
 public:
  void sample(double t, const Vector& place, const Vector& qDot, const Vector& qDDot) override {
    time.push_back(t);
    q.push_back(place);
    v.push_back(qDot);
    a.push_back(qDDot);
  }
  void states(const Vector& ofLaws) override { x.push_back(ofLaws); }
  std::vector<double> time;
  std::vector<Vector> q, v, a, x;
};

inline TransientOptions options(const std::string& integrator, double end, double step,
                                double sampling) {
  TransientOptions o;
  o.integrator = integrator;
  o.end = end;
  o.step = step;
  o.sampling = sampling;
  o.progress = false;
  return o;
}

/// Large step errors and an open energy balance do not end the run.
inline void acceptCoarseSteps(TransientOptions& o) {
  o.stepErrorLimit = o.energyResidualLimit = std::numeric_limits<double>::infinity();
}

/// Balls with contact, plus a load and a damping that change with time, so that all stored data of
/// a run affect the result.
inline model::SecondOrderModel eventful() {
  auto model = droppedBalls(6, 1e6, 2e3, 7e11, 2e4);
  const int law = model.lawIndex({"swell", [](double t) { return 1 + 0.5 * std::sin(40 * t); }});
  model.damping.push_back({"swelling", (3.0 * Matrix::Identity(6, 6)).sparseView(), law});
  model.loads.push_back({"shaking", Vector::LinSpaced(6, -30, 60), law});
  return model;
}

/// An integrator with options, beside the plain names of integrators.
inline constexpr const char* controlledAlpha = "Generalized-alpha with Step Tolerance";

/// Options of an integrator, or of controlledAlpha, good for eventful().
inline TransientOptions wayToStep(const std::string& way, double end) {
  auto o = options(way == controlledAlpha ? "Generalized-alpha" : way, end, way == "RK4" ? 5e-5 : 0,
                   0.005);
  if (way == controlledAlpha) o.own.set("Step Tolerance", 1e-5);
  return o;
}

}  // namespace tooljoint::transient::testing
