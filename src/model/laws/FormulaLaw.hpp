// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A point law from one formula: forces and rates of one point, written once for any scalar type;
/// tangents follow by automatic differentiation.
///
///     struct Maxwell : model::Formula<1, 1> {  // one coordinate, one state
///       template <class T>
///       void operator()(const model::PointAt<T>& at, T* f, T* g) const { ... }
///       Power power(const model::PointAt<double>& at, const double* xDot) const { ... }
///     };
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <complex>
#include <memory>
#include <optional>
#include <unsupported/Eigen/AutoDiff>
#include <utility>
#include <vector>

#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::model {

/// State of a point. `held` are the held states, which have no derivatives.
template <class T>
struct PointAt {
  double t;
  const T* d;
  const T* v;
  const T* x;
  const double* held;
};

/// Defaults of a formula: Width coordinates, Rated states with x' = g, Held states that change at
/// the end of a step. A formula must define operator() and power(), see above.
template <int Width, int Rated = 0, int Held = 0>
struct Formula {
  static constexpr int width = Width, rated = Rated;
  /// PointLaw::hasWalls().
  static constexpr bool walls = true;
  using Power = PointLaw::Power;
  int held() const { return Held; }
  /// States (rated ones first) at the start of a motion.
  void initial(double /*t*/, const double* /*d*/, const double* /*v*/, double* x) const {
    std::fill(x, x + Rated + Held, 0.0);
  }
  /// Held states at the end of a step, from those of its start.
  void accept(double /*t*/, const double* /*d*/, const double* /*v*/, double* /*held*/) const {}
  /// StatefulPointLaw::heldFactor() of a formula with held states.
  std::optional<std::complex<double>> heldFactor(std::complex<double> /*s*/, const double* /*d*/,
                                                 const double* /*v*/) const {
    return std::nullopt;
  }
  /// Recorded force.
  Channel channel() const { return {"force", "N", "Force along the first coordinate"}; }
};

/// Power [W] of a formula without rated states whose forces dissipate all their work: -f' v.
template <class Law>
PointLaw::Power lostPower(const Law& law, const PointAt<double>& at) {
  double f[Law::width] = {};
  law(at, f, static_cast<double*>(nullptr));
  PointLaw::Power power;
  for (int i = 0; i < Law::width; ++i) power.friction -= f[i] * at.v[i];
  return power;
}

/// Points with the same formula and parameters.
template <class Law>
class FormulaLaw final : public StatefulPointLaw {
  static constexpr int W = Law::width, R = Law::rated, N = 2 * W + R;
  using Dual = Eigen::AutoDiffScalar<Eigen::Matrix<double, N, 1>>;

 public:
  FormulaLaw(Law law, int points) : law_(std::move(law)), points_(points) {}
  int size() const override { return points_; }
  int width() const override { return W; }
  int states() const override { return R + law_.held(); }
  int rated() const override { return R; }
  bool hasWalls() const override { return Law::walls; }
  void initialState(double t, const double* d, const double* v, double* x) const override {
    for (int p = 0; p < points_; ++p) law_.initial(t, d + p * W, v + p * W, x + p * states());
  }

  void forces(double t, const std::vector<int>& points, const double* d, const double* v,
              const double* x, double* f, double* g) const override {
    for (int p : points) law_(at(t, p, d, v, x), f + p * W, g + p * R);
  }

  void forcesWithTangents(double t, const std::vector<int>& points, const double* d,
                          const double* v, const double* x, double* f, double* g,
                          const StateTangents& tangents) const override {
    std::array<Dual, W> dd, dv, df;
    std::array<Dual, R + 1> dx, dg;  // one more: R may be zero
    for (int p : points) {
      for (int i = 0; i < W; ++i) {
        dd[i] = Dual(d[p * W + i], N, i);
        dv[i] = Dual(v[p * W + i], N, W + i);
      }
      for (int i = 0; i < R; ++i) dx[i] = Dual(x[p * states() + i], N, 2 * W + i);
      law_(PointAt<Dual>{t, dd.data(), dv.data(), dx.data(), x + p * states() + R}, df.data(),
           dg.data());
      for (int i = 0; i < W; ++i)
        spread(df[i], f[p * W + i], tangents.fd + (p * W + i) * W, tangents.fv + (p * W + i) * W,
               tangents.fx + (p * W + i) * R);
      for (int i = 0; i < R; ++i)
        spread(dg[i], g[p * R + i], tangents.gd + (p * R + i) * W, tangents.gv + (p * R + i) * W,
               tangents.gx + (p * R + i) * R);
    }
  }

  void accept(double t, const double* d, const double* v, double* x) const override {
    for (int p = 0; p < points_; ++p) law_.accept(t, d + p * W, v + p * W, x + p * states() + R);
  }

  std::optional<std::complex<double>> heldFactor(double /*t*/, std::complex<double> s, int p,
                                                 const double* d, const double* v) const override {
    if (law_.held() == 0) return 1.0;
    return law_.heldFactor(s, d + p * W, v + p * W);
  }

  Power powers(double t, const std::vector<int>& points, const double* d, const double* v,
               const double* x, const double* xDot) const override {
    Power sum;
    for (int p : points) {
      const Power one = law_.power(at(t, p, d, v, x), xDot + p * states());
      sum.stored += one.stored;
      sum.damping += one.damping;
      sum.friction += one.friction;
      sum.drive += one.drive;
    }
    return sum;
  }

  std::vector<Channel> channels() const override { return {law_.channel()}; }
  void recordState(double t, const double* d, const double* v, const double* x,
                   double* out) const override {
    std::array<double, W> f{};
    std::array<double, R + 1> g{};
    for (int p = 0; p < points_; ++p) {
      law_(at(t, p, d, v, x), f.data(), g.data());
      out[p] = f[0];
    }
  }

  std::shared_ptr<const PointLaw> subset(const std::vector<int>& points) const override {
    return std::make_shared<FormulaLaw>(law_, static_cast<int>(points.size()));
  }

 private:
  PointAt<double> at(double t, int p, const double* d, const double* v, const double* x) const {
    return {t, d + p * W, v + p * W, x + p * states(), x + p * states() + R};
  }
  /// Value and derivatives of one row.
  static void spread(const Dual& row, double& value, double* byD, double* byV, double* byX) {
    value = row.value();
    const auto& slope = row.derivatives();
    for (int i = 0; i < W; ++i) byD[i] = slope[i], byV[i] = slope[W + i];
    for (int i = 0; i < R; ++i) byX[i] = slope[2 * W + i];
  }

  Law law_;
  int points_;
};

}  // namespace tooljoint::model
