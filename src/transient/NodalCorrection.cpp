// SPDX-License-Identifier: BSD-3-Clause
#include "transient/NodalCorrection.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tooljoint::transient {
namespace {

std::size_t z(int i) { return static_cast<std::size_t>(i); }

/// Points treated at once, and the share of the worst error from which a point counts as troubled.
constexpr int mostPoints = 24;
constexpr double troubledShare = 0.1;
constexpr int mostSweeps = 30;

}  // namespace

void NodalCorrection::bind(CompiledModel& model) {
  model_ = &model;
  int coordinates = 0;
  for (const auto& batch : model.points()) {
    const auto size = z(batch.points()) * z(batch.width());
    for (auto* arrays : {&d_, &v_, &f_}) arrays->emplace_back(size, 0.0);
    coordinates += batch.points() * batch.width();
  }
  const int room = std::min(coordinates, mostPoints * widest);
  points_.reserve(mostPoints);
  columns_.resize(model.size(), room);
  compliance_.resize(room, room);
}

void NodalCorrection::begin() {
  points_.clear();
  for (std::size_t b = 0; b < d_.size(); ++b) {
    const auto& batch = model_->points()[b];
    std::copy(batch.d(), batch.d() + d_[b].size(), d_[b].begin());
    std::copy(batch.v(), batch.v() + v_[b].size(), v_[b].begin());
    std::copy(batch.force(), batch.force() + f_[b].size(), f_[b].begin());
  }
}

bool NodalCorrection::isIn(int batch, int point) const {
  return std::any_of(points_.begin(), points_.end(), [&](const Point& at) { return at.batch == batch && at.point == point; });
}

/// max_r |w_r (f - f0 - P R delta)_r|, w_r by the strongest dof of the row.
double NodalCorrection::error(const PointBatch& batch, int b, int p, const double* delta, const double* weight) const {
  double worst = 0;
  for (int r = p * batch.width(); r < (p + 1) * batch.width(); ++r) {
    const double wrong = batch.force()[r] - f_[z(b)][z(r)] - batch.frozenTimes(r, delta);
    worst = std::max(worst, std::abs(wrong) * batch.rowWeight(r, weight));
  }
  return worst;
}

bool NodalCorrection::addTroubled(const double* delta, const double* weight) {
  double worst = 0;
  for (std::size_t b = 0; b < d_.size(); ++b)
    for (int p : model_->points()[b].active())
      if (!isIn(static_cast<int>(b), p))
        worst = std::max(worst, error(model_->points()[b], static_cast<int>(b), p, delta, weight));
  if (!(worst > 0) || !std::isfinite(worst)) return false;
  bool any = false;
  for (std::size_t b = 0; b < d_.size(); ++b) {
    auto& batch = model_->points()[b];
    if (batch.width() > widest) continue;
    for (int p : batch.active()) {
      if (isIn(static_cast<int>(b), p) || error(batch, static_cast<int>(b), p, delta, weight) < troubledShare * worst) continue;
      const int first = points_.empty() ? 0 : points_.back().first + static_cast<int>(points_.back().d.size());
      if (points_.size() == mostPoints || first + batch.width() > columns_.cols()) return any;
      const int w = batch.width();
      Point at{static_cast<int>(b), p, first, {}, {}, {}, Local::Zero(w), Local::Zero(w)};
      at.d = Eigen::Map<const Eigen::VectorXd>(&d_[b][z(p * w)], w);
      at.v = Eigen::Map<const Eigen::VectorXd>(&v_[b][z(p * w)], w);
      at.f = Eigen::Map<const Eigen::VectorXd>(&f_[b][z(p * w)], w);
      points_.push_back(at);
      any = true;
    }
  }
  for (const Point& at : points_) model_->points()[z(at.batch)].dropTangent(at.point);
  return any;
}

NodalCorrection::Local NodalCorrection::defect(double t, double c, Point& at, const Local& free, const LocalMatrix& G,
                                               const Local& y, LocalMatrix* slope) {
  auto& batch = model_->points()[z(at.batch)];
  const Local d = at.d + y;
  const Local v = at.v + c * y;
  Local f(y.size());
  if (slope != nullptr) {
    LocalMatrix dfdd(y.size(), y.size()), dfdv(y.size(), y.size());
    batch.evaluateOne(t, at.point, d.data(), v.data(), f.data(), dfdd.data(), dfdv.data());
    *slope = dfdd.transpose() + c * dfdv.transpose();  // the law's arrays are row-major
  } else {
    batch.evaluateOne(t, at.point, d.data(), v.data(), f.data(), nullptr, nullptr);
  }
  at.phi = f - at.f;
  return y - free - G * at.phi;
}

/// Newton with backtracking on the defect scaled by 1/sqrt(G_cc) (an energy); where no decrease is found, the sign change of
/// step . G^-1 defect is bracketed, as in the global iteration but on a few numbers.
bool NodalCorrection::solvePoint(double t, double c, Point& at, const Local& free, const LocalMatrix& G) {
  const Eigen::Index w = free.size();
  Local scale(w);
  for (Eigen::Index i = 0; i < w; ++i) scale[i] = 1.0 / std::sqrt(std::max(std::abs(G(i, i)), 1e-300));
  const auto size = [&](const Local& x) { return x.cwiseProduct(scale).norm(); };
  LocalMatrix slope(w, w);
  Local best = at.y;
  double bestSize = INFINITY;
  for (int start = 0; start < 2; ++start) {
    Local y = start == 0 ? at.y : free;
    for (int iteration = 0; iteration < 30; ++iteration) {
      const Local now = defect(t, c, at, free, G, y, &slope);
      const double before = size(now);
      if (!std::isfinite(before)) break;
      if (before < bestSize) best = y, bestSize = before;
      if (before <= 1e-11 * (size(free) + size(y)) + 1e-300) break;
      const LocalMatrix J = LocalMatrix::Identity(w, w) - G * slope;
      const Local step = -J.partialPivLu().solve(now);
      if (!step.allFinite()) break;
      double fraction = 1, beyond = 0;
      bool decreased = false;
      for (int cut = 0; cut < 10 && !decreased; ++cut, fraction *= 0.5) {
        const Local trial = defect(t, c, at, free, G, y + fraction * step, nullptr);
        if (size(trial) <= (1 - 1e-4 * fraction) * before) {
          y += fraction * step;
          decreased = true;
        } else if (step.cwiseProduct(scale).dot(trial.cwiseProduct(scale)) > 0) {
          beyond = fraction;
        }
      }
      if (decreased) continue;
      if (beyond == 0) break;
      double low = 0, high = beyond;
      for (int i = 0; i < 60; ++i) {
        const double middle = 0.5 * (low + high);
        const Local trial = defect(t, c, at, free, G, y + middle * step, nullptr);
        (step.cwiseProduct(scale).dot(trial.cwiseProduct(scale)) > 0 ? high : low) = middle;
      }
      y += high * step;
    }
    if (bestSize <= 1e-9 * (size(free) + size(best))) break;
  }
  at.y = best;
  defect(t, c, at, free, G, at.y, nullptr);
  return std::isfinite(bestSize);
}

bool NodalCorrection::solve(double t, double c, const linalg::BlockFactor& factor, const Vector& residual, Vector& delta,
                            Vector& force) {
  delta = -residual;
  factor.solve(delta.data());
  for (const Point& at : points_) {
    const auto& batch = model_->points()[z(at.batch)];
    for (int k = 0; k < batch.width(); ++k) {
      double* column = columns_.col(at.first + k).data();
      std::fill(column, column + model_->size(), 0.0);
      batch.addRow(at.point * batch.width() + k, 1.0, column);
      factor.solve(column);
    }
  }
  const int total = points_.back().first + static_cast<int>(points_.back().d.size());
  for (const Point& at : points_) {
    const auto& batch = model_->points()[z(at.batch)];
    for (int k = 0; k < batch.width(); ++k)
      for (int j = 0; j < total; ++j)
        compliance_(at.first + k, j) = batch.rowTimesVector(at.point * batch.width() + k, columns_.col(j).data());
  }
  bool settled = false;
  for (int sweep = 0; sweep < mostSweeps && !settled; ++sweep) {
    settled = true;
    for (Point& at : points_) {
      const auto& batch = model_->points()[z(at.batch)];
      const auto w = static_cast<int>(at.d.size());
      Local free(w);
      for (int k = 0; k < w; ++k) free[k] = batch.rowTimesVector(at.point * w + k, delta.data());
      for (const Point& other : points_) {
        if (&other == &at) continue;
        const auto columns = static_cast<int>(other.d.size());
        free += compliance_.block(at.first, other.first, w, columns) * other.phi;
      }
      const Local before = at.y;
      if (!solvePoint(t, c, at, free, compliance_.block(at.first, at.first, w, w))) return false;
      if ((at.y - before).norm() > 1e-10 * (at.y.norm() + free.norm())) settled = false;
    }
    if (points_.size() == 1) settled = true;
  }
  force.setZero();
  for (const Point& at : points_) {
    const auto& batch = model_->points()[z(at.batch)];
    for (int k = 0; k < batch.width(); ++k) {
      delta += at.phi[k] * columns_.col(at.first + k);
      batch.addRow(at.point * batch.width() + k, at.phi[k], force.data());
    }
  }
  return delta.allFinite();
}

}  // namespace tooljoint::transient
