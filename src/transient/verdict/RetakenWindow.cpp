// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/RetakenWindow.hpp"

#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Corrections of the velocity at the start of a window.
constexpr int corrections = 2;

}  // namespace

RetakenWindow::RetakenWindow(CompiledModel& model, const Integrator& run,
                             std::unique_ptr<Integrator> second, const Window& window,
                             const State& start)
    : model_(&model),
      second_(std::move(second)),
      h_(run.equalStep()),
      from_(start),
      first_(start.q),
      state_(start),
      to_(start) {
  run.saveHistory(history_);  // allocates here, not in the step loop
  points_ = model.makePoints();
  for (const auto& batch : points_) scales_.resize(scales_.size() + at(batch.points()));
  Window halves = window;
  halves.sampling = h_;  // a multiple of half a step
  halves.step = 0.5 * h_;
  withModel([&] { second_->prepareRetaking(run, model, halves, start); });
}

/// Runs `work` on the model with the points of the second object, then restores the model.
template <class Work>
void RetakenWindow::withModel(const Work& work) {
  model_->timed().remember(snapshot_);
  points_.swap(model_->points());
  work();
  points_.swap(model_->points());
  model_->timed().comeBack(snapshot_);
}

void RetakenWindow::begin(const Integrator& run, const State& from) {
  from_ = from;
  history_.clear();
  run.saveHistory(history_);
  scales_.clear();
  for (const auto& batch : model_->points())
    for (int p = 0; p < batch.points(); ++p) scales_.push_back(batch.scale(p));
}

/// A point that meets a wall as an impact at the start of the window does so in the halves too.
bool RetakenWindow::take(double endOfFirst, double end) {
  bool solved = false;
  withModel([&] {
    try {
      for (int i = 0;; ++i) {
        auto scale = scales_.begin();
        for (auto& batch : model_->points())
          for (int p = 0; p < batch.points(); ++p) batch.setScale(p, *scale++);
        state_ = from_;
        second_->startAgain(history_.data(), state_);
        takeUntil(endOfFirst);
        if (i == corrections) break;
        from_.v += (first_ - state_.q) / h_;
      }
      takeUntil(end);
      solved = true;
    } catch (const ConvergenceError&) {
    }
  });
  return solved && !model_->cut().any(!state_.q.allFinite());
}

void RetakenWindow::takeUntil(double t) {
  while (state_.t < t - 1e-6 * h_) {
    second_->advance(state_, to_);
    std::swap(state_, to_);
  }
}

void RetakenWindow::save(std::vector<double>& memory, bool underWay) const {
  if (underWay) {
    from_.save(memory);
    memory.insert(memory.end(), first_.begin(), first_.end());
    memory.push_back(static_cast<double>(history_.size()));
    memory.insert(memory.end(), history_.begin(), history_.end());
    memory.insert(memory.end(), scales_.begin(), scales_.end());
  }
  for (const auto& batch : points_) batch.save(memory);
  second_->save(memory);
}

void RetakenWindow::restore(const double*& memory, bool underWay) {
  if (underWay) {
    from_.restore(memory);
    for (double& x : first_) x = *memory++;
    history_.resize(static_cast<std::size_t>(*memory++));
    for (double& x : history_) x = *memory++;
    scales_.clear();
    for (const auto& batch : points_)
      for (int p = 0; p < batch.points(); ++p) scales_.push_back(*memory++);
  }
  const double* points = memory;
  for (auto& batch : points_) batch.restore(memory);
  withModel([&] { second_->restore(memory); });
  for (auto& batch : points_) batch.restore(points);  // the scheme has set its own scales
}

}  // namespace tooljoint::transient
