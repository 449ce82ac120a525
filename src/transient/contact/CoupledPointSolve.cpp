// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/CoupledPointSolve.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
void CoupledPointSolve::bind(CompiledModel& model, Strategies& strategies) {
  strategies_ = &strategies;
  model_ = &model;
  int coordinates = 0;
  for (const auto& batch : model.points()) {
    const auto size = at(batch.points()) * at(batch.width());
    for (auto* arrays : {&d_, &v_, &f_}) arrays->emplace_back(size, 0.0);
    coordinates += batch.points() * batch.width();
  }
  const int room = std::min(coordinates, Tuned::mostTroubled * PointSolve::widest);
  points_.reserve(Tuned::mostTroubled);
  columns_.resize(model.size(), room);
  compliance_.resize(room, room);
}

void CoupledPointSolve::begin() {
  points_.clear();
  for (std::size_t b = 0; b < d_.size(); ++b) {
    const auto& batch = model_->points()[b];
    std::copy(batch.d(), batch.d() + d_[b].size(), d_[b].begin());
    std::copy(batch.v(), batch.v() + v_[b].size(), v_[b].begin());
    std::copy(batch.force(), batch.force() + f_[b].size(), f_[b].begin());
  }
}

bool CoupledPointSolve::isIn(int batch, int point) const {
  return std::any_of(points_.begin(), points_.end(), [&](const Point& each) {
    return each.batch == batch && each.problem.point == point;
  });
}

/// max_r |w_r (f - f0 - P R delta)_r|, w_r the largest weight of the dofs of the row.
double CoupledPointSolve::error(const PointBatch& batch, int b, int p, const double* delta,
                                const double* weight) const {
  double worst = 0;
  for (int r = p * batch.width(); r < (p + 1) * batch.width(); ++r) {
    const double wrong = batch.force()[r] - f_[at(b)][at(r)] - batch.frozenTimes(r, delta);
    worst = std::max(worst, std::abs(wrong) * batch.rowWeight(r, weight));
  }
  return worst;
}

bool CoupledPointSolve::addTroubled(const double* delta, const double* weight) {
  double worst = 0;
  for (std::size_t b = 0; b < d_.size(); ++b)
    for (int p : model_->points()[b].active())
      if (!isIn(static_cast<int>(b), p))
        worst = std::max(worst, error(model_->points()[b], static_cast<int>(b), p, delta, weight));
  if (!(worst > 0) || !std::isfinite(worst)) return false;
  bool any = false;
  for (std::size_t b = 0; b < d_.size(); ++b) {
    auto& batch = model_->points()[b];
    if (batch.width() > PointSolve::widest) continue;
    for (int p : batch.active()) {
      if (isIn(static_cast<int>(b), p) ||
          error(batch, static_cast<int>(b), p, delta, weight) < Tuned::counted * worst)
        continue;
      const int first =
          points_.empty() ? 0 : points_.back().first + static_cast<int>(points_.back().y.size());
      if (points_.size() == at(Tuned::mostTroubled) || first + batch.width() > columns_.cols())
        return any;
      const int w = batch.width();
      Point added{static_cast<int>(b), first, {}, Local::Zero(w), Local::Zero(w)};
      added.problem.strategies = strategies_;
      added.problem.point = p;
      added.problem.P = PointSolve::LocalMatrix::Zero(w, w);
      added.problem.d = Eigen::Map<const Eigen::VectorXd>(&d_[b][at(p * w)], w);
      added.problem.v = Eigen::Map<const Eigen::VectorXd>(&v_[b][at(p * w)], w);
      added.problem.f0 = Eigen::Map<const Eigen::VectorXd>(&f_[b][at(p * w)], w);
      points_.push_back(added);
      any = true;
    }
  }
  for (const Point& each : points_)
    model_->points()[at(each.batch)].dropTangent(each.problem.point);
  return any;
}

bool CoupledPointSolve::solve(double t, double c, const linalg::BlockFactor& factor,
                              const Vector& residual, Vector& delta, Vector& force) {
  delta = -residual;
  factor.solve(delta.data());
  for (const Point& each : points_) {
    const auto& batch = model_->points()[at(each.batch)];
    for (int k = 0; k < batch.width(); ++k) {
      double* column = columns_.col(each.first + k).data();
      std::fill(column, column + model_->size(), 0.0);
      batch.addRow(each.problem.point * batch.width() + k, 1.0, column);
      factor.solve(column);
    }
  }
  const int total = points_.back().first + static_cast<int>(points_.back().y.size());
  for (const Point& each : points_) {
    const auto& batch = model_->points()[at(each.batch)];
    for (int k = 0; k < batch.width(); ++k)
      for (int j = 0; j < total; ++j)
        compliance_(each.first + k, j) =
            batch.rowTimesVector(each.problem.point * batch.width() + k, columns_.col(j).data());
  }
  bool settled = false;
  for (int sweep = 0; sweep < Tuned::mostPointIterations && !settled; ++sweep) {
    settled = true;
    for (Point& each : points_) {
      const auto& batch = model_->points()[at(each.batch)];
      const auto w = static_cast<int>(each.y.size());
      Local& free = each.problem.free;
      free.resize(w);
      for (int k = 0; k < w; ++k)
        free[k] = batch.rowTimesVector(each.problem.point * w + k, delta.data());
      for (const Point& other : points_) {
        if (&other == &each) continue;
        const auto columns = static_cast<int>(other.y.size());
        free += compliance_.block(each.first, other.first, w, columns) * other.phi;
      }
      const Local before = each.y;
      each.problem.G = compliance_.block(each.first, each.first, w, w);
      if (!each.problem.solve(model_->points()[at(each.batch)], t, c, each.y, each.phi))
        return false;
      if ((each.y - before).norm() > Tuned::pointTolerance * (each.y.norm() + free.norm()))
        settled = false;
    }
    if (points_.size() == 1) settled = true;
  }
  force.setZero();
  for (const Point& each : points_) {
    const auto& batch = model_->points()[at(each.batch)];
    for (int k = 0; k < batch.width(); ++k) {
      delta += each.phi[k] * columns_.col(each.first + k);
      batch.addRow(each.problem.point * batch.width() + k, each.phi[k], force.data());
    }
  }
  return delta.allFinite();
}

}  // namespace tooljoint::transient
