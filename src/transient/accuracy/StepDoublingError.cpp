// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/StepDoublingError.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace tooljoint::transient {
namespace {

/// Steps between those looked at, each at the price of about three, since its factor is not in the
/// cache; runs that are short beside it still have `fewest` of them, long ones no more than `most`.
constexpr long usualStride = 100, shortestStride = 2, fewest = 8, most = 128;
/// Sums over less say nothing.
constexpr std::size_t least = 4;
/// One in so many steps differs by what happens once, a bounce or a grip, and not by how steps go.
constexpr std::size_t leftOut = 4;

}  // namespace

void StepDoublingError::bind(CompiledModel& model, std::unique_ptr<HalvedStep> halves,
                             const State& state, double h, long steps) {
  model_ = &model;
  halves_ = std::move(halves);
  points_.clear();
  for (const auto& set : model.source().points) points_.emplace_back(set, model.pattern());
  withModel([&] { halves_->prepare(model, state, h); });
  size_.bind(model);
  end_ = state;
  before_ = velocity_ = ofHalves_ = state.v;
  stride_ = std::max(std::clamp(steps / fewest, shortestStride, usualStride), steps / most);
  errors_.reserve(static_cast<std::size_t>(steps / stride_ + 2));
  plan();
}

/// What is done with the model while the points are those of the halves; then it is as it was.
template <class Work>
void StepDoublingError::withModel(const Work& work) {
  model_->remember(snapshot_);
  points_.swap(model_->points());
  work();
  points_.swap(model_->points());
  model_->comeBack(snapshot_);
}

/// next = s (i + frac(g i)), g the golden ratio: no vibration is always met in the same phase.
void StepDoublingError::plan() {
  constexpr double golden = 0.6180339887498949;
  const double i = static_cast<double>(seen_), spread = golden * (i + 1);
  next_ = static_cast<long>(static_cast<double>(stride_) * (i + spread - std::floor(spread)));
}

/// What meets a wall as an impact in the step does so in its halves: what the scheme remembers has
/// no part of its force.
void StepDoublingError::shareImpacts() {
  const auto& points = model_->points();
  for (std::size_t b = 0; b < points.size(); ++b)
    for (int p = 0; p < points[b].points(); ++p) points_[b].setScale(p, points[b].scale(p));
}

bool StepDoublingError::look(const State& from, const State& to) {
  ++seen_;
  plan();
  shareImpacts();
  bool solved = false;
  end_.t = to.t;
  withModel([&] { solved = halves_->take(from, end_); });
  if (!solved) return false;  // says nothing: the step itself has been solved
  before_ = from.v;
  velocity_ = to.v;
  ofHalves_ = end_.v;
  halves_->clean(before_, velocity_, ofHalves_);
  ofHalves_ -= velocity_;
  before_ -= velocity_;
  errors_.push_back(size_(ofHalves_) * size_(ofHalves_));
  change_ += size_(before_) * size_(before_);
  return true;
}

double StepDoublingError::ratio(double speed) const {
  if (errors_.size() < least) return 0.0;
  const double motion = speed * std::sqrt(change_ / static_cast<double>(errors_.size()));
  if (!(motion > 0)) return 0.0;
  auto errors = errors_;
  std::sort(errors.begin(), errors.end());
  const auto kept = errors.size() - errors.size() / leftOut;
  return std::sqrt(
      std::accumulate(errors.begin(), errors.begin() + static_cast<std::ptrdiff_t>(kept), 0.0) /
      static_cast<double>(kept) / motion);
}

void StepDoublingError::save(std::vector<double>& memory) const {
  memory.insert(memory.end(),
                {static_cast<double>(seen_), change_, static_cast<double>(errors_.size())});
  memory.insert(memory.end(), errors_.begin(), errors_.end());
  for (const auto& batch : points_) batch.save(memory);
  halves_->save(memory);
}

void StepDoublingError::restore(const double*& memory) {
  seen_ = static_cast<long>(*memory++);
  change_ = *memory++;
  errors_.resize(static_cast<std::size_t>(*memory++));
  for (double& error : errors_) error = *memory++;
  plan();
  const double* points = memory;
  for (auto& batch : points_) batch.restore(memory);
  withModel([&] { halves_->restore(memory); });
  for (auto& batch : points_) batch.restore(points);  // the scheme has set scales of its own
}

}  // namespace tooljoint::transient
