// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/PointBatch.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>

#include "common/Index.hpp"
#include "transient/compiled/PointWidth.hpp"

namespace tooljoint::transient {
PointBatch::PointBatch(const model::PointSet& set, const linalg::BlockPattern& pattern,
                       const std::vector<int>* own)
    : name_(set.name),
      law_(set.law),
      entities_(set.entities),
      points_(set.law->size()),
      width_(set.law->width()) {
  if (const auto* law = model::stateful(*law_)) states_ = std::make_unique<PointStates>(*law);
  const int rows = points_ * width_;
  const auto& position = pattern.partition().position;
  offset_.assign(set.offset.data(), set.offset.data() + rows);
  rowBegin_.push_back(0);
  single_ = true;
  for (int r = 0; r < rows; ++r) {
    for (Sparse::InnerIterator it(set.rows, r); it; ++it) {
      if (it.value() == 0.0) continue;
      column_.push_back(position[at(static_cast<int>(it.col()))]);
      value_.push_back(it.value());
      single_ = single_ && it.value() == 1.0;
    }
    rowBegin_.push_back(static_cast<int>(column_.size()));
    single_ = single_ && rowBegin_[at(r + 1)] - rowBegin_[at(r)] <= 1;
  }
  findBlocks(pattern);
  if (single_) {
    index_.assign(at(rows), -1);
    for (int r = 0; r < rows; ++r)
      if (rowBegin_[at(r + 1)] > rowBegin_[at(r)]) index_[at(r)] = column_[at(rowBegin_[at(r)])];
    entryAddress_.assign(at(rows) * at(width_), noEntry);
    for (int p = 0; p < points_; ++p)
      for (int i = 0; i < width_; ++i)
        for (int j = 0; j < width_; ++j) {
          const int row = index_[at(p * width_ + i)];
          const int column = index_[at(p * width_ + j)];
          if (row >= 0 && column >= 0)
            entryAddress_[at((p * width_ + i) * width_ + j)] = pattern.address(row, column);
        }
  } else {
    touchBegin_.push_back(0);
    pairBegin_.push_back(0);
    for (int p = 0; p < points_; ++p) {
      std::map<int, std::size_t> blocks;
      for (int i = rowBegin_[at(p * width_)]; i < rowBegin_[at((p + 1) * width_)]; ++i)
        blocks[pattern.blockOf(column_[at(i)])] = 0;
      for (auto& [block, begin] : blocks) {
        begin = touchRows_.size();
        touches_.push_back({pattern.start(block), pattern.width(block), begin});
        touchRows_.resize(begin + at(width_ * pattern.width(block)), 0.0);
        for (const auto& [other, ignored] : blocks)
          pairOffset_.push_back(pattern.offset(pattern.find(block, other)));
      }
      for (int c = 0; c < width_; ++c)
        for (int i = rowBegin_[at(p * width_ + c)]; i < rowBegin_[at(p * width_ + c + 1)]; ++i) {
          const int block = pattern.blockOf(column_[at(i)]);
          touchRows_[blocks[block] + at((column_[at(i)] - pattern.start(block)) * width_ + c)] =
              value_[at(i)];
        }
      touchBegin_.push_back(static_cast<int>(touches_.size()));
      pairBegin_.push_back(static_cast<int>(pairOffset_.size()));
    }
  }
  if (own != nullptr) {
    all_ = *own;
  } else {
    all_.resize(at(points_));
    std::iota(all_.begin(), all_.end(), 0);
  }
  watch_ = ContactBroadPhase(all_, width_, law_->reach(), rowBegin_, column_, value_, pattern);
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

void PointBatch::findBlocks(const linalg::BlockPattern& pattern) {
  blockBegin_.push_back(0);
  for (int p = 0; p < points_; ++p) {
    const auto begin = static_cast<std::ptrdiff_t>(block_.size());
    for (int i = rowBegin_[at(p * width_)]; i < rowBegin_[at((p + 1) * width_)]; ++i)
      block_.push_back(pattern.blockOf(column_[at(i)]));
    std::sort(block_.begin() + begin, block_.end());
    block_.erase(std::unique(block_.begin() + begin, block_.end()), block_.end());
    blockBegin_.push_back(static_cast<int>(block_.size()));
  }
  pointBegin_.assign(at(pattern.blocks() + 1), 0);
  for (int b : block_) ++pointBegin_[at(b + 1)];
  std::partial_sum(pointBegin_.begin(), pointBegin_.end(), pointBegin_.begin());
  point_.resize(block_.size());
  std::vector<int> next(pointBegin_.begin(), pointBegin_.end() - 1);
  for (int p = 0; p < points_; ++p)
    for (int i = blockBegin_[at(p)]; i < blockBegin_[at(p + 1)]; ++i)
      point_[at(next[at(block_[at(i)])]++)] = p;
}

double PointBatch::rowTimes(int row, const double* x) const {
  double sum = 0;
  for (int i = rowBegin_[at(row)]; i < rowBegin_[at(row + 1)]; ++i)
    sum += value_[at(i)] * x[column_[at(i)]];
  return sum;
}

void PointBatch::gatherAll(const double* q, const double* v) {
  const int rows = points_ * width_;
  if (single_) {
    for (int r = 0; r < rows; ++r) {
      const int i = index_[at(r)];
      d_[at(r)] = i < 0 ? offset_[at(r)] : offset_[at(r)] + q[i];
    }
    if (v != nullptr)
      for (int r = 0; r < rows; ++r) v_[at(r)] = index_[at(r)] < 0 ? 0.0 : v[index_[at(r)]];
  } else {
    for (int r = 0; r < rows; ++r) d_[at(r)] = offset_[at(r)] + rowTimes(r, q);
    if (v != nullptr)
      for (int r = 0; r < rows; ++r) v_[at(r)] = rowTimes(r, v);
  }
}

void PointBatch::gatherPositions(const std::vector<int>& points, const double* q) {
  for (int p : points)
    for (int r = p * width_; r < (p + 1) * width_; ++r)
      d_[at(r)] = offset_[at(r)] +
                  (single_ ? (index_[at(r)] < 0 ? 0.0 : q[index_[at(r)]]) : rowTimes(r, q));
}

void PointBatch::gatherThese(const std::vector<int>& points, const double* q, const double* v) {
  for (int p : points)
    for (int r = p * width_; r < (p + 1) * width_; ++r) {
      if (single_) {
        const int i = index_[at(r)];
        d_[at(r)] = i < 0 ? offset_[at(r)] : offset_[at(r)] + q[i];
        v_[at(r)] = i < 0 ? 0.0 : v[i];
      } else {
        d_[at(r)] = offset_[at(r)] + rowTimes(r, q);
        v_[at(r)] = rowTimes(r, v);
      }
    }
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
    for (int r = p * width_; r < (p + 1) * width_; ++r) addRow(r, f_[at(r)], y);
    appendBlocks(p, blocks);
  }
}

void PointBatch::applyScale(const std::vector<int>& points, bool tangent) {
  for (int p : points) scalePoint(p, tangent);
}

void PointBatch::addForce(double factor, double* y) const {
  for (int p : active_)
    for (int r = p * width_; r < (p + 1) * width_; ++r) {
      const double force = factor * f_[at(r)];
      if (single_) {
        if (index_[at(r)] >= 0) y[index_[at(r)]] += force;
      } else {
        for (int i = rowBegin_[at(r)]; i < rowBegin_[at(r + 1)]; ++i)
          y[column_[at(i)]] += value_[at(i)] * force;
      }
    }
}

void PointBatch::gather(const std::vector<int>& points, const double* x, double* rows) const {
  withWidth(width_, [&](auto width) {
    const int w = width;
    for (int p : points)
      for (int r = p * w; r < (p + 1) * w; ++r)
        rows[r] = single_ ? (index_[at(r)] < 0 ? 0.0 : x[index_[at(r)]]) : rowTimes(r, x);
  });
}

void PointBatch::scatter(const std::vector<int>& points, const double* rows, double* y) const {
  withWidth(width_, [&](auto width) {
    const int w = width;
    for (int p : points)
      for (int r = p * w; r < (p + 1) * w; ++r) {
        if (single_) {
          if (index_[at(r)] >= 0) y[index_[at(r)]] += rows[r];
        } else {
          for (int i = rowBegin_[at(r)]; i < rowBegin_[at(r + 1)]; ++i)
            y[column_[at(i)]] += value_[at(i)] * rows[r];
        }
      }
  });
}

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
  for (int b : block_) blocks[at(b)] = 1;
}

void PointBatch::appendBlocks(int point, std::vector<int>& blocks) const {
  blocks.insert(blocks.end(), block_.begin() + blockBegin_[at(point)],
                block_.begin() + blockBegin_[at(point + 1)]);
}

double PointBatch::rowTimesVector(int row, const double* x) const {
  if (single_) return index_[at(row)] < 0 ? 0.0 : x[index_[at(row)]];
  return rowTimes(row, x);
}

void PointBatch::addRow(int row, double factor, double* y) const {
  for (int i = rowBegin_[at(row)]; i < rowBegin_[at(row + 1)]; ++i)
    y[column_[at(i)]] += factor * value_[at(i)];
}

double PointBatch::rowWeight(int row, const double* weight) const {
  double largest = 0;
  for (int i = rowBegin_[at(row)]; i < rowBegin_[at(row + 1)]; ++i)
    largest = std::max(largest, std::abs(value_[at(i)]) * weight[column_[at(i)]]);
  return largest;
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
