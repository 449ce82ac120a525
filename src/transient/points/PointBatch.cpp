// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/PointBatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

std::vector<int> allOr(const std::vector<int>* own, int points) {
  if (own != nullptr) return *own;
  std::vector<int> all(at(points));
  std::iota(all.begin(), all.end(), 0);
  return all;
}

ContactBroadPhase watchOf(const std::vector<int>& points, const model::PointSet& set,
                          const linalg::BlockPattern& pattern) {
  const PointRowEntries entries = PointRows::entries(set, pattern);
  return {points,         set.law->width(), set.law->reach(), entries.begin,
          entries.column, entries.value,    pattern};
}

}  // namespace

PointBatch::PointBatch(const model::PointSet& set, const linalg::BlockPattern& pattern,
                       const std::vector<int>* own)
    : name_(set.name),
      law_(set.law),
      entities_(set.entities),
      points_(set.law->size()),
      width_(set.law->width()),
      rows_(set, pattern),
      selected_(points_, allOr(own, points_)),
      clearances_(points_, watchOf(selected_.all(), set, pattern)),
      frozen_(points_, width_) {
  if (const auto* law = model::stateful(*law_)) states_ = std::make_unique<PointStates>(*law);
  const int rows = points_ * width_;
  offset_.assign(set.offset.data(), set.offset.data() + rows);
  own_.assign(at(2 * width_), 0.0);
  scale_.assign(at(points_), 1.0);
  for (auto* array : {&d_, &v_, &f_, &dd_, &dv_}) array->assign(at(rows), 0.0);
  for (auto* array : {&dfdd_, &dfdv_, &ahead_}) array->assign(at(rows) * at(width_), 0.0);
  one_.assign(1, 0);
}

void PointBatch::gatherAll(const double* q, const double* v) {
  for (int r = 0; r < points_ * width_; ++r) d_[at(r)] = offset_[at(r)] + rows_.times(r, q);
  if (v == nullptr) return;
  for (int r = 0; r < points_ * width_; ++r) v_[at(r)] = rows_.times(r, v);
}

void PointBatch::gatherPositions(const std::vector<int>& points, const double* q) {
  rows_.gather(points, q, d_.data());
  for (int p : points)
    for (int r = p * width_; r < (p + 1) * width_; ++r) d_[at(r)] += offset_[at(r)];
}

void PointBatch::gatherThese(const std::vector<int>& points, const double* q, const double* v) {
  gatherPositions(points, q);
  rows_.gather(points, v, v_.data());
}

auto PointBatch::measure(const double* q) {
  return [this, q](const std::vector<int>& points, double* gap) {
    gatherPositions(points, q);
    law_->clearanceLeft(points, d_.data(), gap);
  };
}

void PointBatch::look(double t, double h, const double* q) {
  for (int p : active()) selected_.mark(p, false);
  clearances_.look(t, h, q, measure(q), [&](int p, bool acts) { selected_.mark(p, acts); });
  // A point with a tangent in the factored matrix must be evaluated as long as it is frozen.
  for (int p : frozen_.points()) selected_.mark(p, true);
  selected_.update();
}

model::PointLaw::Power PointBatch::power(double t, const double* q, const double* v,
                                         const std::vector<int>& points) {
  gatherThese(points, q, v);
  return callPower(t, points);
}

/// With y = -1/2 ... 1/2 over the step and the mean m of both ends, the cubic
///
///     d(y) = m + y Dd + (y^2 - 1/4) h Dv/2 + y (y^2 - 1/4) (h (v_n + v_{n+1}) - 2 Dd)
///
/// is evaluated at y = -g and g, g^2 = 1/12, where its velocity is Dd/h -+ g Dv.
model::PointLaw::Power PointBatch::meanPower(double t, double h, const double* q, const double* v,
                                             const double* dq, const double* dv,
                                             const std::vector<int>& points) {
  constexpr double gauss = 0.28867513459481287;
  gatherThese(points, q, v);
  rows_.gather(points, dq, dd_.data());
  rows_.gather(points, dv, dv_.data());
  for (int p : points) {
    const double smooth = scale_[at(p)] == 1.0 ? 1.0 : 0.0;
    for (std::size_t r = at(p * width_); r < at((p + 1) * width_); ++r) {
      const double chord = dd_[r], change = smooth * dv_[r];
      const double bow = smooth * (h * (2 * v_[r] - dv_[r]) - 2 * chord);
      dd_[r] = gauss * (smooth * chord - bow / 6);
      dv_[r] = gauss * change;
      d_[r] -= 0.5 * chord + gauss * gauss * h * change + dd_[r];
      v_[r] = chord / h - dv_[r];
    }
  }
  model::PointLaw::Power mean = callPower(t - (0.5 + gauss) * h, points);
  for (int p : points)
    for (std::size_t r = at(p * width_); r < at((p + 1) * width_); ++r)
      d_[r] += 2 * dd_[r], v_[r] += 2 * dv_[r];
  const model::PointLaw::Power late = callPower(t - (0.5 - gauss) * h, points);
  mean.stored = 0.5 * (mean.stored + late.stored);
  mean.damping = 0.5 * (mean.damping + late.damping);
  mean.friction = 0.5 * (mean.friction + late.friction);
  mean.drive = 0.5 * (mean.drive + late.drive);
  return mean;
}

model::PointLaw::Power PointBatch::callPower(double t, const std::vector<int>& points) const {
  if (states_) return states_->power(t, points, d_.data(), v_.data());
  return law_->power(t, points, d_.data(), v_.data());
}

bool PointBatch::addMissed(const double* q, double t) {
  if (active().size() == everyPoint().size()) return false;
  bool any = false;
  clearances_.check(q, t, measure(q), [&](int p) {
    if (!selected_.isMarked(p)) selected_.mark(p, true), any = true;
  });
  if (any) selected_.update();
  return any;
}

bool PointBatch::meetsOrLeavesWall(const double* q) {
  return clearances_.meetsOrLeavesWall(q, measure(q));
}

void PointBatch::evaluate(double t, const double* q, const double* v) {
  if (active().empty()) return;
  gatherThese(active(), q, v);
  evaluateHere(t, active(), false);
}

void PointBatch::evaluateWithTangent(double t, const double* q, const double* v) {
  if (active().empty()) return;
  gatherThese(active(), q, v);
  evaluateHere(t, active(), true);
}

void PointBatch::lookAheadAlong(double t, double h, const double* q, const double* v) {
  if (active().empty()) return;
  gatherThese(active(), q, v);
  for (int p : active())
    for (int r = p * width_; r < (p + 1) * width_; ++r) d_[at(r)] += h * v_[at(r)];
  evaluateHere(t, active(), true);
  std::swap(ahead_, dfdd_);
}

void PointBatch::setScale(int point, double scale) {
  double& mine = scale_[at(point)];
  scaled_ += (scale != 1.0 ? 1 : 0) - (mine != 1.0 ? 1 : 0);
  mine = scale;
}

void PointBatch::scalePoint(int p, bool tangent) {
  const double scale = scale_[at(p)];
  if (scale == 1.0) return;
  for (int r = p * width_; r < (p + 1) * width_; ++r) f_[at(r)] *= scale;
  if (!tangent) return;
  for (int i = p * width_ * width_; i < (p + 1) * width_ * width_; ++i)
    dfdd_[at(i)] *= scale, dfdv_[at(i)] *= scale;
}

void PointBatch::addScaledForce(double* y, std::vector<int>& blocks) const {
  for (int p : active()) {
    if (scale_[at(p)] == 1.0) continue;
    for (int r = p * width_; r < (p + 1) * width_; ++r) rows_.add(r, f_[at(r)], y);
    rows_.appendBlocks(p, blocks);
  }
}

void PointBatch::applyScale(const std::vector<int>& points, bool tangent) {
  for (int p : points) scalePoint(p, tangent);
}

void PointBatch::addForce(double* y) const { rows_.scatter(active(), f_.data(), y); }

void PointBatch::callLaw(double t, const std::vector<int>& points, bool tangent) {
  const double *d = d_.data(), *v = v_.data();
  if (states_ && tangent)
    states_->evaluateWithTangent(t, points, d, v, f_.data(), dfdd_.data(), dfdv_.data());
  else if (states_)
    states_->evaluate(t, points, d, v, f_.data());
  else if (tangent)
    law_->evaluateWithTangent(t, points, d, v, f_.data(), dfdd_.data(), dfdv_.data());
  else
    law_->evaluate(t, points, d, v, f_.data());
}

void PointBatch::evaluateHere(double t, const std::vector<int>& points, bool tangent) {
  callLaw(t, points, tangent);
  if (scaled_ > 0) applyScale(points, tangent);
  evaluations_ += static_cast<long>(points.size());
}

void PointBatch::evaluateHere(double t, int point, bool tangent) {
  one_[0] = point;
  evaluateHere(t, one_, tangent);
}

void PointBatch::markBlocks(std::vector<char>& blocks) const {
  for (int b : rows_.blocks()) blocks[at(b)] = 1;
}

void PointBatch::evaluateOne(double t, int point, const double* d, const double* v, double* f,
                             double* dfdd, double* dfdv) {
  const int first = point * width_;
  std::copy(d, d + width_, d_.begin() + first);
  std::copy(v, v + width_, v_.begin() + first);
  evaluateHere(t, point, dfdd != nullptr);
  if (dfdd != nullptr) {
    std::copy_n(dfdd_.begin() + first * width_, width_ * width_, dfdd);
    std::copy_n(dfdv_.begin() + first * width_, width_ * width_, dfdv);
  }
  std::copy_n(f_.begin() + first, width_, f);
}

void PointBatch::evaluateElsewhere(double t, int point, const double* d, const double* v, double* f,
                                   double* dfdd, double* dfdv) {
  const int first = point * width_;
  double *ownD = own_.data(), *ownV = ownD + width_;
  std::copy_n(d_.begin() + first, width_, ownD);
  std::copy_n(v_.begin() + first, width_, ownV);
  evaluateOne(t, point, d, v, f, dfdd, dfdv);
  std::copy_n(ownD, width_, d_.begin() + first);
  std::copy_n(ownV, width_, v_.begin() + first);
  evaluateHere(t, point, true);
}

void PointBatch::save(std::vector<double>& memory) const {
  clearances_.save(memory);
  selected_.save(memory);
  memory.insert(memory.end(), scale_.begin(), scale_.end());
  frozen_.save(memory);
}

void PointBatch::restore(const double*& memory) {
  clearances_.restore(memory);
  selected_.restore(memory);
  for (int p = 0; p < points_; ++p) setScale(p, *memory++);
  frozen_.restore(memory);
}

}  // namespace tooljoint::transient
