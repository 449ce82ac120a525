// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/PointStates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
namespace {

using Rows = model::StateTangentArrays::Rows;

}  // namespace

PointStates::PointStates(const model::StatefulPointLaw& law)
    : law_(&law),
      points_(law.size()),
      width_(law.width()),
      states_(law.states()),
      rated_(law.rated()),
      tangents_(law),
      factorised_(rated_) {
  x_.assign(at(points_ * states_), 0.0);
  still_ = x_;
  base_ = still_.data();
  g_.assign(at(points_ * rated_), 0.0);
  f_.assign(at(points_ * width_), 0.0);
  one_.assign(1, 0);
  jacobian_.setZero(rated_, rated_);
  right_.setZero(rated_, width_);
  slope_ = right_;
  defect_.setZero(rated_);
  step_ = defect_;
}

void PointStates::bind(const double* base, double factor, const double* rate) {
  base_ = base;
  factor_ = factor;
  known_ = factor == 0.0 || rated_ == 0;
  rate_ = rate;
  std::copy(base, base + size(), x_.begin());
}

void PointStates::bindKnown(const double* x, double factor) {
  bind(x, factor, nullptr);
  known_ = true;
}

/// I - factor dg/dx
void PointStates::setJacobian(int point, double factor) {
  jacobian_ = -factor * tangentsOf(point).gx;
  jacobian_.diagonal().array() += 1.0;
  factorised_.compute(jacobian_);
}

/// Newton's method for x - base - factor g = 0, starting from the last states of this step. False
/// if it does not converge.
bool PointStates::solve(double t, int point, const double* d, const double* v) {
  one_[0] = point;
  double* x = &x_[at(point * states_)];
  const double* base = base_ + point * states_;
  for (int iteration = 0; iteration < Tuned::mostPointIterations; ++iteration) {
    law_->forcesWithTangents(t, one_, d, v, x_.data(), f_.data(), g_.data(), tangents_.write());
    setJacobian(point, factor_);
    double size = 0, update = 0;
    for (int i = 0; i < rated_; ++i)
      defect_[i] = base[i] + factor_ * g_[at(point * rated_ + i)] - x[i];
    step_ = factorised_.solve(defect_);
    for (int i = 0; i < rated_; ++i) {
      x[i] += step_[i];
      size = std::max({size, std::abs(x[i]), std::abs(base[i])});
      update = std::max(update, std::abs(step_[i]));
    }
    if (!std::isfinite(update)) return false;
    if (update <= Tuned::rounding * size) return true;
  }
  return false;
}

void PointStates::evaluate(double t, const std::vector<int>& points, const double* d,
                           const double* v, double* f) {
  bool good = true;
  if (!known_)
    for (int p : points) good = solve(t, p, d, v) && good;
  law_->forces(t, points, d, v, x_.data(), f, g_.data());
  if (!good)
    for (int p : points)
      std::fill_n(f + p * width_, width_, std::numeric_limits<double>::quiet_NaN());
}

void PointStates::evaluateWithTangent(double t, const std::vector<int>& points, const double* d,
                                      const double* v, double* f, double* dfdd, double* dfdv) {
  evaluate(t, points, d, v, f);
  law_->forcesWithTangents(t, points, d, v, x_.data(), f_.data(), g_.data(), tangents_.write());
  const bool follows = factor_ != 0.0 && rated_ > 0;
  const int entries = width_ * width_;
  for (int p : points) {
    const auto own = tangentsOf(p);
    std::copy_n(own.fd.data(), entries, dfdd + p * entries);
    std::copy_n(own.fv.data(), entries, dfdv + p * entries);
    if (!follows) continue;
    setJacobian(p, factor_);
    const auto add = [&](const Rows& by, double* tangent) {
      right_ = factor_ * by;
      slope_ = factorised_.solve(right_);
      for (int i = 0; i < width_; ++i)
        for (int j = 0; j < width_; ++j)
          for (int k = 0; k < rated_; ++k)
            tangent[p * entries + i * width_ + j] += own.fx(i, k) * slope_(k, j);
    };
    add(own.gd, dfdd);
    add(own.gv, dfdv);
  }
}

model::PointLaw::Power PointStates::power(double t, const std::vector<int>& points, const double* d,
                                          const double* v) const {
  return law_->powers(t, points, d, v, base_, rate_ != nullptr ? rate_ : still_.data());
}

void PointStates::forceOf(double factor, const double* r, double* rows) {
  for (int p = 0; p < points_ && rated_ > 0; ++p) {
    setJacobian(p, factor);
    step_ = factorised_.solve(Eigen::Map<const Vector>(r + p * rated_, rated_));
    Eigen::Map<Vector>(rows + p * width_, width_).noalias() = tangentsOf(p).fx * step_;
  }
}

void PointStates::follow(double factor, const double* d, const double* v, double* r) {
  for (int p = 0; p < points_ && rated_ > 0; ++p) {
    setJacobian(p, factor);
    Eigen::Map<Vector> mine(r + p * rated_, rated_);
    defect_ = mine;
    const auto own = tangentsOf(p);
    const auto add = [&](const Rows& by, const double* rows) {
      defect_.noalias() += factor * (by * Eigen::Map<const Vector>(rows + p * width_, width_));
    };
    add(own.gd, d);
    add(own.gv, v);
    mine = factorised_.solve(defect_);
  }
}

void PointStates::rates(double* xDot) const {
  for (int p = 0; p < points_; ++p)
    for (int i = 0; i < states_; ++i)
      xDot[p * states_ + i] = i < rated_ ? g_[at(p * rated_ + i)] : 0.0;
}

void PointStates::complete(double t, const std::vector<int>& all, const double* d, const double* v,
                           double* x, double* xDot) {
  evaluate(t, all, d, v, f_.data());
  std::copy(x_.begin(), x_.end(), x);
  rates(xDot);
  accept(t, d, v, x);
}

}  // namespace tooljoint::transient
