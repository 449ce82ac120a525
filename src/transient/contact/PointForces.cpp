// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/PointForces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"
#include "transient/contact/FewRows.hpp"
#include "transient/points/PointWidth.hpp"

namespace tooljoint::transient {
namespace {

void setIdentity(int n, double* B) {
  for (int i = 0; i < n * n; ++i) B[i] = i % (n + 1) == 0 ? 1.0 : 0.0;
}

/// Keeps the larger value; NaN counts as larger than all.
void keepLarger(double& largest, double x) {
  if (x > largest || std::isnan(x)) largest = x;
}

}  // namespace

PointForces::PointForces(const PointBatch& batch, Strategies& strategies)
    : strategies_(&strategies) {
  problem_.strategies = &strategies;
  const std::size_t points = at(batch.points()), rows = points * at(batch.width());
  for (auto* array : {&d_, &y_, &p_, &defect_, &weight_, &target_, &change_})
    array->assign(rows, 0.0);
  compliance_.assign(rows * at(batch.width()), 0.0);
  answer_.assign(rows * at(batch.width()), 0.0);
  error_.assign(points, 0.0);
  for (auto* array : {&started_, &known_, &alone_, &listed_}) array->assign(points, 0);
  moved_.assign(points, 1);
  points_.reserve(points);
}

void PointForces::setWeights(const PointBatch& batch, const Vector& weight) {
  for (std::size_t r = 0; r < weight_.size(); ++r)
    weight_[r] = batch.rowWeight(static_cast<int>(r), weight.data());
}

void PointForces::forgetCompliance() { std::fill(known_.begin(), known_.end(), 0); }

void PointForces::forgetStart() { std::fill(started_.begin(), started_.end(), 0); }

void PointForces::takeNew(const PointBatch& batch) {
  points_.clear();
  for (int p : batch.active())
    if (!started_[at(p)]) points_.push_back(p);
}

void PointForces::takeReached(const PointBatch& batch, const std::vector<int>& blocks) {
  for (int p : points_) listed_[at(p)] = 1;
  for (int block : blocks)
    batch.forActiveIn(block, [&](int p) {
      if (!listed_[at(p)]) points_.push_back(p);
      listed_[at(p)] = 1;
    });
  for (int p : points_) listed_[at(p)] = 0;
}

void PointForces::keepWrong(double small) {
  const auto isRight = [&](int p) { return (moved_[at(p)] = isWrong(p, small) ? 1 : 0) == 0; };
  points_.erase(std::remove_if(points_.begin(), points_.end(), isRight), points_.end());
}

void PointForces::takeTurn(const PointBatch& batch, double small, int colour, long& place) {
  points_.clear();
  for (int p : batch.active()) {
    moved_[at(p)] = place++ % Tuned::colours == colour && isWrong(p, small) ? 1 : 0;
    if (!moved_[at(p)]) continue;
    alone_[at(p)] = strategies_->has(Strategy::PointsAlone) ? 1 : 0;
    points_.push_back(p);
  }
}

void PointForces::start(PointBatch& batch, const double* q, const double* inverse) {
  const int w = batch.width();
  batch.gatherPositions(points_, q);
  for (int p : points_) {
    std::copy_n(batch.d() + p * w, w, &d_[at(p * w)]);
    started_[at(p)] = 1;
    alone_[at(p)] = 0;
    moved_[at(p)] = 1;
    error_[at(p)] = std::numeric_limits<double>::infinity();
    if (known_[at(p)]) continue;
    batch.project(p, inverse, &compliance_[at(p * w * w)]);
    known_[at(p)] = 1;
  }
}

void PointForces::gather(const PointBatch& batch, const Vector& delta, double c) {
  batch.gather(points_, delta.data(), y_.data());
  if (c == 1.0) return;
  const std::size_t w = at(batch.width());
  for (int p : points_)
    for (std::size_t r = at(p) * w; r < at(p + 1) * w; ++r) y_[r] /= c;
}

void PointForces::evaluate(PointBatch& batch, double t, double c, bool tangents) {
  double* d = batch.position();
  double* v = batch.velocity();
  withWidth(batch.width(), [&](auto width) {
    const int w = width;
    for (int p : points_)
      for (int r = p * w; r < (p + 1) * w; ++r) d[r] = d_[at(r)] + y_[at(r)], v[r] = c * y_[at(r)];
  });
  batch.evaluateHere(t, points_, tangents);
}

void PointForces::agree(const PointBatch& batch, double c) {
  withWidth(batch.width(), [&](auto width) {
    for (int p : points_) answer(batch, p, c, width);
  });
}

/// p = f - P y of a point, and its response B = (I - (J - P) G)^-1.
template <class Width>
void PointForces::answer(const PointBatch& batch, int point, double c, Width width) {
  constexpr int widest = PointSolve::widest;
  const int w = width, first = point * w;
  const double* P = batch.frozen() + first * w;
  const double* f = batch.force() + first;
  for (int i = 0; i < w; ++i) {
    double known = 0;
    for (int k = 0; k < w; ++k) known += P[i * w + k] * y_[at(first + k)];
    p_[at(first + i)] = f[i] - known;
  }
  double A[widest * widest], change[widest * widest];
  const double* dfdd = batch.dfdd() + first * w;
  const double* dfdv = batch.dfdv() + first * w;
  const double* G = &compliance_[at(first * w)];
  double* B = &answer_[at(first * w)];
  bool changes = false;
  for (int i = 0; i < w * w; ++i) {
    change[i] = dfdd[i] + c * dfdv[i] - P[i];
    changes = changes || change[i] != 0;
  }
  if (!changes) return setIdentity(w, B);
  for (int i = 0; i < w; ++i)
    for (int j = 0; j < w; ++j) {
      double sum = i == j ? 1.0 : 0.0;
      for (int k = 0; k < w; ++k) sum -= change[i * w + k] * G[k * w + j];
      A[i * w + j] = sum;
    }
  if (!invertFew(w, A, B)) setIdentity(w, B);
}

void PointForces::removeForces(const PointBatch& batch) {
  for (int p : points_) std::fill_n(&p_[at(p * batch.width())], batch.width(), 0.0);
}

void PointForces::measure(const PointBatch& batch, double small, double& force) {
  const double* f = batch.force();
  const double* P = batch.frozen();
  const double* y = y_.data();
  const double* weight = weight_.data();
  double largest = force;
  withWidth(batch.width(), [&](auto width) {
    const int w = width;
    for (int p : points_) {
      double wrong = 0;
      for (int r = p * w; r < (p + 1) * w; ++r) {
        double known = p_[at(r)];
        for (int k = 0; k < w; ++k) known += P[r * w + k] * y[p * w + k];
        const double defect = defect_[at(r)] = f[r] - known;
        const double size =
            alone_[at(p)] ? std::abs(y[r] - target_[at(r)]) : weight[r] * std::abs(defect);
        keepLarger(wrong, size);
        largest = std::max(largest, weight[r] * std::abs(f[r]));
      }
      if (moved_[at(p)] && wrong > small && wrong > Tuned::slowestRate * error_[at(p)] &&
          !alone_[at(p)])
        alone_[at(p)] = strategies_->use(Strategy::PointsAlone) ? 1 : 0;
      error_[at(p)] = wrong;
    }
  });
  force = largest;
}

/// p += B defect, or the force of the local equilibrium of the point.
void PointForces::correct(PointBatch& batch, double t, double c) {
  const int w = batch.width();
  for (int point : points_) {
    const int first = point * w;
    moved_[at(point)] = 1;
    for (int r = first; r < first + w; ++r) change_[at(r)] = -p_[at(r)];
    if (alone_[at(point)]) {
      solveAlone(batch, point, t, c);
    } else {
      const double* B = &answer_[at(first * w)];
      const double* defect = &defect_[at(first)];
      withWidth(w, [&](auto width) {
        const int n = width;
        for (int i = 0; i < n; ++i)
          for (int k = 0; k < n; ++k) p_[at(first + i)] += B[i * n + k] * defect[k];
      });
    }
    for (int r = first; r < first + w; ++r) change_[at(r)] += p_[at(r)];
  }
}

/// y = free + G p is the displacement of the point under a force p while the other forces are held.
void PointForces::solveAlone(PointBatch& batch, int point, double t, double c) {
  using Rows =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  const int w = batch.width();
  const int first = point * w;
  const auto local = [&](const std::vector<double>& rows) {
    return Eigen::Map<const Vector>(&rows[at(first)], w);
  };
  problem_.point = point;
  problem_.d = local(d_);
  problem_.v = PointSolve::Local::Zero(w);
  problem_.f0 = PointSolve::Local::Zero(w);
  problem_.P = Rows(batch.frozen() + first * w, w, w);
  problem_.G = Rows(&compliance_[at(first * w)], w, w);
  guess_ = local(y_);
  phi_ = local(p_);
  problem_.free = guess_;
  problem_.free.noalias() -= problem_.G.lazyProduct(phi_);
  if (!problem_.solve(batch, t, c, guess_, phi_)) return;
  for (int i = 0; i < w; ++i) p_[at(first + i)] = phi_[i], target_[at(first + i)] = guess_[i];
}

void PointForces::stand(PointBatch& batch, double t, double c) {
  points_.clear();
  const int w = batch.width();
  for (int p : batch.active()) {
    if (!alone_[at(p)]) continue;
    points_.push_back(p);
    std::copy_n(&target_[at(p * w)], w, &y_[at(p * w)]);
  }
  if (!points_.empty()) evaluate(batch, t, c, false);
}

/// NaN counts as wrong.
bool PointForces::isWrong(int point, double small) const {
  return !(error_[at(point)] <= Tuned::rightEnough * small);
}

double PointForces::worst(const std::vector<int>& points, double known) const {
  for (int p : points) keepLarger(known, error_[at(p)]);
  return known;
}

void PointForces::addSquares(const PointBatch& batch, double& wrong, double& whole) const {
  for (int p : batch.active())
    for (int r = p * batch.width(); r < (p + 1) * batch.width(); ++r) {
      const double error = weight_[at(r)] * defect_[at(r)],
                   force = weight_[at(r)] * batch.force()[r];
      wrong += error * error, whole += force * force;
    }
}

}  // namespace tooljoint::transient
