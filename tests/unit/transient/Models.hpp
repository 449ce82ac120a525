// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Small models and point laws with known motion, for the tests of the integrators.
#pragma once

#include <cmath>
#include <memory>
#include <vector>

#include "model/SecondOrderModel.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::transient::testing {

/// Model with these dense matrices; one node per dof unless `perNode` says otherwise.
inline model::SecondOrderModel denseModel(const Matrix& M, const Matrix& C, const Matrix& K, int perNode = 1) {
  model::SecondOrderModel model;
  const int n = static_cast<int>(M.rows());
  model.componentNames = {"u", "v", "w", "theta_x", "theta_y", "theta_z"};
  for (int i = 0; i < n; ++i) model.dofs.push_back(model::DofLabel::physical(1 + i / perNode, i % perNode));
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

/// One-sided spring-damper at d = 0: force on a point at d < 0 is (-k d - c v) times a smoothed step of sharpness lambda.
class Floor final : public model::PointLaw {
 public:
  Floor(int points, double k, double c, double lambda) : points_(points), k_(k), c_(c), lambda_(lambda) {}
  int size() const override { return points_; }
  int width() const override { return 1; }
  void evaluate(double, const std::vector<int>& active, const double* d, const double* v, double* f) const override {
    for (int p : active) {
      const double s = step(-d[p]);
      f[p] = s * (-k_ * d[p] - c_ * v[p]);
    }
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v, double* f, double* dfdd,
                           double* dfdv) const override {
    for (int p : active) {
      const double s = step(-d[p]);
      const double x = M_PI * lambda_ * d[p];
      const double slope = -lambda_ / (1 + x * x);  // ds/dd
      f[p] = s * (-k_ * d[p] - c_ * v[p]);
      dfdd[p] = -k_ * s + slope * (-k_ * d[p] - c_ * v[p]);
      dfdv[p] = -c_ * s;
    }
  }
  void clearanceLeft(const double* d, double* gap) const override {
    for (int p = 0; p < points_; ++p) gap[p] = d[p] - tail();
  }
  Power power(double, const double* d, const double* v) const override {
    Power sum;
    for (int p = 0; p < points_; ++p) {
      if (d[p] < 0) sum.stored += 0.5 * k_ * d[p] * d[p];
      sum.damping += c_ * step(-d[p]) * v[p] * v[p];
    }
    return sum;
  }
  std::vector<model::Channel> channels() const override { return {{"force", "N", "Force of the floor."}, {"penetration", "m", "Depth below the floor."}}; }
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
  double step(double g) const { return std::atan2(1.0, -M_PI * lambda_ * g) / M_PI; }
  double tail() const { return 30.0 / lambda_; }
  int points_;
  double k_, c_, lambda_;
};

/// Contact with a bore of radius clearance and friction, three coordinates (u, v, theta_z) per point: the law of Nguyen et al. 2020,
/// (7)-(9), written out plainly. `omega` turns the string under it.
class Bore final : public model::PointLaw {
 public:
  struct Data {
    double clearance = 0.01, k = 1e7, c = 1e4, lambda = 7e11, muS = 0.2, muD = 0.1, vr = 0.1, radius = 0.1, omega = 12.5;
  };
  Bore(std::vector<Data> points) : data_(std::move(points)) {}
  int size() const override { return static_cast<int>(data_.size()); }
  int width() const override { return 3; }
  void evaluate(double, const std::vector<int>& active, const double* d, const double* v, double* f) const override {
    for (int p : active) one(data_[static_cast<std::size_t>(p)], d + 3 * p, v + 3 * p, f + 3 * p, nullptr, nullptr);
  }
  void evaluateWithTangent(double, const std::vector<int>& active, const double* d, const double* v, double* f, double* dfdd,
                           double* dfdv) const override {
    for (int p : active) one(data_[static_cast<std::size_t>(p)], d + 3 * p, v + 3 * p, f + 3 * p, dfdd + 9 * p, dfdv + 9 * p);
  }
  void clearanceLeft(const double* d, double* gap) const override {
    for (int p = 0; p < size(); ++p) gap[p] = data_[static_cast<std::size_t>(p)].clearance - std::hypot(d[3 * p], d[3 * p + 1]) - 1e-9;
  }
  Power power(double, const double* d, const double* v) const override {
    Power sum;
    for (int p = 0; p < size(); ++p) {
      const Data& x = data_[static_cast<std::size_t>(p)];
      double f[3];
      one(x, d + 3 * p, v + 3 * p, f, nullptr, nullptr);
      const double r = std::sqrt(d[3 * p] * d[3 * p] + d[3 * p + 1] * d[3 * p + 1] + 1e-18);
      const double gap = r - x.clearance;
      if (gap <= 0) continue;
      const double rate = (d[3 * p] * v[3 * p] + d[3 * p + 1] * v[3 * p + 1]) / r;
      const double slip = (d[3 * p] * v[3 * p + 1] - d[3 * p + 1] * v[3 * p]) / r + (x.omega + v[3 * p + 2]) * x.radius;
      const double friction = -f[2] / x.radius;
      sum.stored += 0.5 * x.k * gap * gap;
      sum.damping += x.c * rate * rate;
      sum.friction += friction * slip;
      sum.drive += friction * x.omega * x.radius;
    }
    return sum;
  }
  std::vector<model::Channel> channels() const override { return {}; }
  void record(double, const double*, const double*, double*) const override {}
  std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const override {
    std::vector<Data> some;
    for (int p : points) some.push_back(data_[static_cast<std::size_t>(p)]);
    return std::make_shared<Bore>(some);
  }

 private:
  static void one(const Data& x, const double* d, const double* vel, double* f, double* dfdd, double* dfdv) {
    const double u = d[0], v = d[1], du = vel[0], dv = vel[1];
    const double r = std::sqrt(u * u + v * v + 1e-18);
    const double nu = u / r, nv = v / r;
    const double G = r - x.clearance;
    const double dG = nu * du + nv * dv;
    const double z = M_PI * x.lambda * G;
    const double s = std::atan2(1.0, -z) / M_PI;
    const double ds = x.lambda / (1 + z * z);
    const double N = s * (x.k * G + x.c * dG);
    const double vg = (u * dv - v * du) / r + (x.omega + vel[2]) * x.radius;
    double mu, dmu;
    friction(x, vg, mu, dmu);
    f[0] = -N * nu + mu * N * nv;
    f[1] = -N * nv - mu * N * nu;
    f[2] = -mu * N * x.radius;
    if (dfdd == nullptr) return;
    // d(n)/du etc.
    const double nuu = (1 - nu * nu) / r, nuv = -nu * nv / r, nvv = (1 - nv * nv) / r;
    const double dGu = nuu * du + nuv * dv, dGv = nuv * du + nvv * dv;
    const double Nu = ds * nu * (x.k * G + x.c * dG) + s * (x.k * nu + x.c * dGu);
    const double Nv = ds * nv * (x.k * G + x.c * dG) + s * (x.k * nv + x.c * dGv);
    const double vgu = nuu * dv - nuv * du, vgv = nuv * dv - nvv * du;
    const double Tu = dmu * vgu * N + mu * Nu, Tv = dmu * vgv * N + mu * Nv;
    const double T = mu * N;
    const double row[9] = {-Nu * nu - N * nuu + Tu * nv + T * nuv, -Nv * nu - N * nuv + Tv * nv + T * nvv, 0,
                           -Nu * nv - N * nuv - Tu * nu - T * nuu, -Nv * nv - N * nvv - Tv * nu - T * nuv, 0,
                           -Tu * x.radius,                         -Tv * x.radius,                         0};
    std::copy(row, row + 9, dfdd);
    const double Ndu = s * x.c * nu, Ndv = s * x.c * nv;
    const double Tdu = -dmu * nv * N + mu * Ndu, Tdv = dmu * nu * N + mu * Ndv, Tdt = dmu * x.radius * N;
    const double rate[9] = {-Ndu * nu + Tdu * nv, -Ndv * nu + Tdv * nv, Tdt * nv,
                            -Ndu * nv - Tdu * nu, -Ndv * nv - Tdv * nu, -Tdt * nu,
                            -Tdu * x.radius,      -Tdv * x.radius,      -Tdt * x.radius};
    std::copy(rate, rate + 9, dfdv);
  }
  /// Odd, slope 1/vr at zero, peak muS, limit muD.
  static void friction(const Data& x, double v, double& mu, double& dmu) {
    if (x.muS == 0) {
      mu = dmu = 0;
      return;
    }
    const double xi = std::sqrt(1 - x.muD / x.muS);
    const double peak = 2 * x.vr * x.muD / (xi > 0 ? xi * (1 - xi) : 1.0);
    // mu = muD v' (..): rational blend through the peak at `peak`
    const double y = v / peak;
    const double a = x.muS, b = x.muD;
    const double th = std::tanh(3 * y), dth = 3 * (1 - th * th);
    const double e = 1 / (1 + y * y), de = -2 * y * e * e;
    mu = th * (b + 2 * (a - b) * e);
    dmu = (dth * (b + 2 * (a - b) * e) + th * 2 * (a - b) * de) / peak;
  }
  std::vector<Data> data_;
};

/// Keeps all samples.
class Keep final : public SampleSink {
 public:
  void sample(double t, const Vector& place, const Vector& qDot, const Vector& qDDot) override {
    time.push_back(t);
    q.push_back(place);
    v.push_back(qDot);
    a.push_back(qDDot);
  }
  std::vector<double> time;
  std::vector<Vector> q, v, a;
};

inline TransientOptions options(const std::string& integrator, double end, double step, double sampling) {
  TransientOptions o;
  o.integrator = integrator;
  o.end = end;
  o.step = step;
  o.sampling = sampling;
  o.progress = false;
  return o;
}

}  // namespace tooljoint::transient::testing
