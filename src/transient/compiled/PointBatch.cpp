// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/PointBatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "common/Index.hpp"

namespace tooljoint::transient {
PointBatch::PointBatch(const model::PointSet& set, const linalg::BlockPattern& pattern,
                       const std::vector<int>* own)
    : name_(set.name),
      law_(set.law),
      entities_(set.entities),
      points_(set.law->size()),
      width_(set.law->width()),
      rows_(set, pattern) {
  if (const auto* law = model::stateful(*law_)) states_ = std::make_unique<PointStates>(*law);
  const int rows = points_ * width_;
  offset_.assign(set.offset.data(), set.offset.data() + rows);
  if (own != nullptr) {
    all_ = *own;
  } else {
    all_.resize(at(points_));
    std::iota(all_.begin(), all_.end(), 0);
  }
  const PointRowEntries entries = PointRows::entries(set, pattern);
  watch_ = ContactBroadPhase(all_, width_, law_->reach(), entries.begin, entries.column,
                             entries.value, pattern);
  small_.assign(at(width_), 0.0);
  own_.assign(at(2 * width_), 0.0);
  active_.reserve(at(points_));
  frozen_.reserve(at(points_));
  isActive_.assign(at(points_), 0);
  hasActed_.assign(at(points_), 0);
  acted_.reserve(at(points_));
  isFrozen_.assign(at(points_), 0);
  scale_.assign(at(points_), 1.0);
  for (auto* array : {&d_, &v_, &f_}) array->assign(at(rows), 0.0);
  for (auto* array : {&dfdd_, &dfdv_, &P_, &positionP_}) array->assign(at(rows) * at(width_), 0.0);
  gap_.assign(at(points_), 0.0);
  lastGap_.assign(at(points_), 0.0);
  check_.assign(at(points_), 0.0);
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

/// Clearances at q of the points that are awake; what slept is as if it had stood still.
void PointBatch::measure(const double* q, std::vector<double>& gap) {
  watch_.activate(q);
  gatherPositions(watch_.active(), q);
  law_->clearanceLeft(watch_.active(), d_.data(), gap.data());
  for (int p : watch_.activated()) gap_[at(p)] = lastGap_[at(p)] = check_[at(p)] = gap[at(p)];
  watch_.deactivate(q, gap.data());
}

void PointBatch::look(double t, double h, const double* q) {
  if (gapsSeen_ == 0 || t != gapTime_) {
    gap_.swap(lastGap_);
    lastGapTime_ = gapTime_;
    gapTime_ = t;
    gapsSeen_ = std::min(gapsSeen_ + 1, 2);
  }
  if (t == checkTime_) {
    gap_.swap(check_);
  } else {
    measure(q, gap_);
  }
  checkTime_ = std::numeric_limits<double>::quiet_NaN();
  // A point acts in the step when gap <= 2 h closing, closing = rate at which its clearance shrank
  // since the look before.
  const double reach =
      gapsSeen_ == 2 && gapTime_ > lastGapTime_ ? 2.0 * h / (gapTime_ - lastGapTime_) : 0.0;
  for (int p : active_) isActive_[at(p)] = 0;
  for (int p : watch_.active()) {
    const double closing = std::max(0.0, lastGap_[at(p)] - gap_[at(p)]);
    isActive_[at(p)] = gap_[at(p)] > reach * closing ? 0 : 1;
  }
  // What stands in a factored matrix has to be looked at as long as it stands there.
  for (int p : frozen_) isActive_[at(p)] = 1;
  listActive();
}

void PointBatch::listActive() {
  active_.clear();
  for (int p : all_)
    if (isActive_[at(p)]) active_.push_back(p), hasActed_[at(p)] = 1;
}

model::PointLaw::Power PointBatch::power(double t, const double* q, const double* v,
                                         const std::vector<int>& points) {
  gatherThese(points, q, v);
  return callPower(t, points);
}

model::PointLaw::Power PointBatch::chordPower(double t, double h, const double* q,
                                              const double* step, const std::vector<int>& points) {
  gatherThese(points, q, step);
  for (int p : points)
    for (int r = p * width_; r < (p + 1) * width_; ++r)
      d_[at(r)] -= 0.5 * v_[at(r)], v_[at(r)] /= h;
  return callPower(t, points);
}

model::PointLaw::Power PointBatch::callPower(double t, const std::vector<int>& points) const {
  if (states_) return states_->power(t, points, d_.data(), v_.data());
  return law_->power(t, points, d_.data(), v_.data());
}

const std::vector<int>& PointBatch::acted() {
  acted_.clear();
  for (int p : all_)
    if (hasActed_[at(p)]) acted_.push_back(p);
  return acted_;
}

void PointBatch::bookPowers() { hasActed_ = isActive_; }

bool PointBatch::addMissed(const double* q, double t) {
  if (active_.size() == all_.size()) return false;
  measure(q, check_);
  checkTime_ = t;
  bool any = false;
  for (int p : watch_.active())
    if (!isActive_[at(p)] && !(check_[at(p)] > 0)) isActive_[at(p)] = 1, any = true;
  if (any) listActive();
  return any;
}

bool PointBatch::meetsOrLeavesWall(const double* q) {
  measure(q, check_);
  checkTime_ = std::numeric_limits<double>::quiet_NaN();
  const auto isClosed = [](const std::vector<double>& gap, int p) { return !(gap[at(p)] > 0); };
  const auto& found = watch_.activated();
  const auto& seen = watch_.active();
  return std::any_of(found.begin(), found.end(), [&](int p) { return isClosed(check_, p); }) ||
         std::any_of(seen.begin(), seen.end(),
                     [&](int p) { return isClosed(check_, p) != isClosed(gap_, p); });
}

void PointBatch::evaluate(double t, const double* q, const double* v) {
  if (active_.empty()) return;
  gatherThese(active_, q, v);
  evaluateHere(t, active_, false);
}

void PointBatch::evaluateWithTangent(double t, const double* q, const double* v) {
  if (active_.empty()) return;
  gatherThese(active_, q, v);
  evaluateHere(t, active_, true);
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
  for (int p : active_) {
    if (scale_[at(p)] == 1.0) continue;
    for (int r = p * width_; r < (p + 1) * width_; ++r) rows_.add(r, f_[at(r)], y);
    rows_.appendBlocks(p, blocks);
  }
}

void PointBatch::applyScale(const std::vector<int>& points, bool tangent) {
  for (int p : points) scalePoint(p, tangent);
}

void PointBatch::addForce(double* y) const { rows_.scatter(active_, f_.data(), y); }

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
  memory.insert(memory.end(), {gapTime_, lastGapTime_, static_cast<double>(gapsSeen_)});
  memory.insert(memory.end(), gap_.begin(), gap_.end());
  memory.insert(memory.end(), lastGap_.begin(), lastGap_.end());
  for (const auto* flags : {&isActive_, &hasActed_})
    memory.insert(memory.end(), flags->begin(), flags->end());
  memory.insert(memory.end(), scale_.begin(), scale_.end());
  watch_.save(memory);
  memory.push_back(static_cast<double>(frozen_.size()));
  for (int p : frozen_) {
    memory.push_back(p);
    for (const auto* tangent : {&P_, &positionP_})
      memory.insert(memory.end(), tangent->begin() + p * width_ * width_,
                    tangent->begin() + (p + 1) * width_ * width_);
  }
}

void PointBatch::restore(const double*& memory) {
  gapTime_ = *memory++;
  lastGapTime_ = *memory++;
  gapsSeen_ = static_cast<int>(*memory++);
  for (double& gap : gap_) gap = *memory++;
  for (double& gap : lastGap_) gap = *memory++;
  for (char& on : isActive_) on = *memory++ != 0.0 ? 1 : 0;
  listActive();
  for (char& on : hasActed_) on = *memory++ != 0.0 ? 1 : 0;
  for (int p = 0; p < points_; ++p) setScale(p, *memory++);
  watch_.restore(memory);
  forgetTangent();
  frozen_.assign(at(static_cast<int>(*memory++)), 0);
  for (int& p : frozen_) {
    p = static_cast<int>(*memory++);
    isFrozen_[at(p)] = 1;
    for (auto* tangent : {&P_, &positionP_})
      for (int i = p * width_ * width_; i < (p + 1) * width_ * width_; ++i)
        (*tangent)[at(i)] = *memory++;
  }
}

}  // namespace tooljoint::transient
