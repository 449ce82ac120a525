// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/BusiestSpan.hpp"

#include <algorithm>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Length of a span in s, and its largest fraction of the run. The comparison costs three to seven
/// times the motion of the span.
constexpr double longestSpan = 1, largestPart = 0.1;
/// Another span is busier if its numerator exceeds that of the known spans by this factor: twice
/// the changes of velocity in a step.
constexpr double busier = 4;
/// Largest J of resolved motion: vibration of w h = 0.1 and less.
constexpr double followed = 0.01;
/// Tolerance of times, in parts of a span.
constexpr double untimely = 1e-9;

}  // namespace

BusiestSpan::BusiestSpan(const CompiledModel& model, const Window& window, double known,
                         const State& like)
    : model_(&model),
      begin_(window.begin),
      part_(std::min(longestSpan, largestPart * (window.end - window.begin)) /
            static_cast<double>(parts)),
      known_(known),
      inertia_(model.size()),
      difference_(like.q) {
  model.diagonal(1.0, 0.0, 0.0, inertia_.data());
  for (int i = 0; i < model.size(); ++i)
    if (!model.cut().owns(i)) inertia_[i] = 0;
  for (auto& part : last_) part.from = like;
  best_.from = like;
}

void BusiestSpan::look(const State& from, const State& to) {
  Part& part = last_[at(closed_ % static_cast<long>(parts))];
  if (empty_) {
    part.from = from;
    part.sums = {};
    empty_ = false;
  }
  difference_ = (to.t - from.t) * (to.a - from.a);
  part.sums.jumps += square(difference_);
  part.sums.speeds += square(to.v);
  if (to.t - begin_ > (static_cast<double>(closed_ + 1) - untimely) * part_) close();
}

/// Evaluates the span that ends with the current part.
void BusiestSpan::close() {
  const auto count = static_cast<long>(parts);
  double sums[2] = {0, 0};
  for (const auto& part : last_) {
    sums[0] += part.sums.jumps;
    sums[1] += part.sums.speeds;
  }
  model_->cut().reduce(nullptr, 0, sums, 2);
  ++closed_;
  empty_ = true;
  const bool isKnown = static_cast<double>(closed_) * part_ <= known_ * (1 + untimely);
  if (isKnown) knownJumps_ = std::max(knownJumps_, sums[0]);
  if (isKnown || sums[0] <= best_.sums.jumps) return;
  best_.from = last_[at(closed_ % count)].from;
  best_.sums = {sums[0], sums[1]};
}

bool BusiestSpan::isLater() const {
  return best_.sums.jumps > busier * knownJumps_ &&
         best_.sums.jumps > followed * followed * best_.sums.speeds;
}

void BusiestSpan::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {static_cast<double>(closed_), empty_ ? 1.0 : 0.0, knownJumps_});
  const auto add = [&](const Part& part) {
    part.from.save(memory);
    memory.insert(memory.end(), {part.sums.jumps, part.sums.speeds});
  };
  for (const auto& part : last_) add(part);
  add(best_);
}

void BusiestSpan::restore(const double*& memory) {
  closed_ = static_cast<long>(*memory++);
  empty_ = *memory++ != 0;
  knownJumps_ = *memory++;
  const auto take = [&](Part& part) {
    part.from.restore(memory);
    part.sums.jumps = *memory++;
    part.sums.speeds = *memory++;
  };
  for (auto& part : last_) take(part);
  take(best_);
}

}  // namespace tooljoint::transient
