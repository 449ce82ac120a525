// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/StepError.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Steps in a window.
constexpr long inWindow = 8;
/// Steps from one window to the next: a window costs about as much as 20 steps. Short runs still
/// have `fewest` windows if they can, long ones no more than `most`.
constexpr long usualStride = 400, fewest = 8, most = 128;
/// Fewer windows say nothing.
constexpr long fewestSaying = 2;
/// Corrections of the velocity at the start of a window.
constexpr int corrections = 2;
/// Motion in windows that is less than this part of the displacement since the start is rest: what
/// iterations leave is a part of the displacement, too, of the order of their tolerance.
constexpr double negligibleMotion = 1e-3;
/// Motion that is less than this part of the displacement has no damping that means anything.
constexpr double quiet = 1e-6;
constexpr double golden = 0.6180339887498949;
/// The damping of the scheme is looked at in so many first steps, in which what the start excites
/// is lost, and then once in so many: a look costs some products with M.
constexpr long dampingStart = 64, dampingStride = 11;
/// Over longer times [s] contact parts any two motions.
constexpr double longest = 3.0;

}  // namespace

StepError::StepError(CompiledModel& model, const Integrator& run,
                     std::unique_ptr<Integrator> second, const Window& window, const State& start)
    : model_(&model),
      damping_(dynamic_cast<const NumericalDamping*>(&run)),
      second_(std::move(second)),
      norm_(model),
      begin_(window.begin),
      h_(run.equalStep()),
      turning_(std::min(longest, window.end - window.begin)),
      start_(start.q),
      steps_(static_cast<long>(std::floor((window.end - window.begin) / h_ + 1e-6))),
      stride_(std::max(std::clamp(steps_ / fewest, inWindow, usualStride), steps_ / most)),
      from_(start),
      first_(start.q),
      state_(start),
      to_(start),
      difference_(start.q) {
  run.saveHistory(history_);  // nothing is allocated in the step loop
  points_ = model.makePoints();
  for (const auto& batch : points_) scales_.resize(scales_.size() + at(batch.points()));
  Window halves = window;
  halves.sampling = h_;  // of which steps of a half are a whole part
  halves.step = 0.5 * h_;
  withModel([&] { second_->prepareRetaking(run, model, halves, start); });
  plan();
}

/// What is done with the model while the points are those of the second object; then it is as it
/// was.
template <class Work>
void StepError::withModel(const Work& work) {
  model_->remember(snapshot_);
  points_.swap(model_->points());
  work();
  points_.swap(model_->points());
  model_->comeBack(snapshot_);
}

/// next = s (i + frac(g i)), g the golden ratio: no vibration is always met in the same phase.
void StepError::plan() {
  const double i = static_cast<double>(seen_), spread = golden * (i + 1);
  next_ = static_cast<long>(static_cast<double>(stride_) * (i + spread - std::floor(spread)));
  if (stride_ == inWindow) next_ = stride_ * seen_;  // one after the other
}

void StepError::before(const Integrator& run, const State& from) {
  if (end_ >= 0) return;
  const double passed = (from.t - begin_) / h_;
  const long step = std::lround(passed);
  if (step < next_ || std::abs(passed - static_cast<double>(step)) > 1e-6) return;
  if (step + inWindow > steps_) return;
  ++seen_;
  plan();
  end_ = step + inWindow;
  from_ = from;
  most_ = 0;
  history_.clear();
  run.saveHistory(history_);
  scales_.clear();
  for (const auto& batch : model_->points())
    for (int p = 0; p < batch.points(); ++p) scales_.push_back(batch.scale(p));
}

/// Spread as windows are, so that no vibration is always met in the same phase.
long StepError::nextLook() const {
  if (taken_ < dampingStart) return taken_;
  const double i = static_cast<double>(looks_), spread = golden * i;
  return dampingStart +
         static_cast<long>(static_cast<double>(dampingStride) * (i + spread - std::floor(spread)));
}

void StepError::lookAtDamping(const State& from, const State& to) {
  if (damping_ == nullptr) return;
  const bool first = taken_ < dampingStart;
  if (taken_++ < nextLook()) return;
  if (!first) ++looks_;
  const double weight = first ? 1.0 : static_cast<double>(dampingStride);
  difference_ = to.q - from.q;
  vibrated_ += weight * norm_.square(difference_) / (to.t - from.t);
  lost_ += weight * damping_->dissipated(from, to);
  if (damping_->hasUnresolvedContact()) rested_ += weight;
}

void StepError::after(const State& from, const State& to) {
  lookAtDamping(from, to);
  if (end_ < 0) return;
  const double dt = to.t - from.t;
  difference_ = to.q - from.q;
  speeds_ += norm_.square(difference_) / dt;
  difference_ = to.q - start_;
  offsets_ += norm_.square(difference_) * dt;
  looked_ += dt;
  difference_ = to.q - from_.q;
  most_ = std::max(most_, norm_.square(difference_));
  if (to.t < time(end_ - inWindow + 1) + 1e-6 * h_) first_ = to.q;
  if (to.t < time(end_) - 1e-6 * h_) return;
  if (retake()) {
    difference_ = to.q - state_.q;
    errors_ += norm_.square(difference_);
    moved_ += most_;
    sizes_ += norm_.square(to.q);
    ++count_;
  }
  end_ = -1;
}

/// The window just done, in halves, to state_; false when their equations have no solution. What
/// meets a wall as an impact where it begins does so in the halves too.
bool StepError::retake() {
  bool solved = false;
  withModel([&] {
    try {
      for (int i = 0;; ++i) {
        auto scale = scales_.begin();
        for (auto& batch : model_->points())
          for (int p = 0; p < batch.points(); ++p) batch.setScale(p, *scale++);
        state_ = from_;
        second_->startAgain(history_.data(), state_);
        retakeUntil(time(end_ - inWindow + 1));
        if (i == corrections) break;
        from_.v += (first_ - state_.q) / h_;
      }
      retakeUntil(time(end_));
      solved = true;
    } catch (const ConvergenceError&) {
    }
  });
  return solved && !model_->cut().any(!state_.q.allFinite());
}

void StepError::retakeUntil(double t) {
  while (state_.t < t - 1e-6 * h_) {
    second_->advance(state_, to_);
    std::swap(state_, to_);
  }
}

double StepError::value() const {
  if (count_ < fewestSaying || !(moved_ > 0)) return 0.0;
  const double noise = 1e-12 * std::sqrt(static_cast<double>(count_)) + 1e-9 * std::sqrt(sizes_);
  if (std::sqrt(errors_) <= noise) return 0.0;
  const double offset = looked_ > 0 ? offsets_ / looked_ : 0.0;
  const double least = negligibleMotion * negligibleMotion * offset * static_cast<double>(count_);
  const double turns = offsets_ > 0 ? turning_ * std::sqrt(speeds_ / offsets_) : 1.0;
  return std::max(1.0, turns) * std::sqrt(errors_ / std::max(moved_, least));
}

double StepError::damped() const {
  const double energy = 0.5 * norm_.inertia() * vibrated_;  // integral over the time looked at
  if (count_ < fewestSaying || !(std::sqrt(moved_) > quiet * std::sqrt(sizes_)) || !(energy > 0))
    return 0.0;
  return 1 - std::exp(-std::max(0.0, 0.25 * turning_ * lost_ / energy));
}

bool StepError::hasUnresolvedContact() const {
  return rested_ > oftenUnresolved * static_cast<double>(taken_);
}

void StepError::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {static_cast<double>(seen_), static_cast<double>(end_), most_,
                               static_cast<double>(count_), errors_, moved_, sizes_, lost_,
                               vibrated_, speeds_, offsets_, looked_, static_cast<double>(taken_),
                               static_cast<double>(looks_), rested_});
  if (end_ >= 0) {
    from_.save(memory);
    memory.insert(memory.end(), first_.begin(), first_.end());
    memory.push_back(static_cast<double>(history_.size()));
    memory.insert(memory.end(), history_.begin(), history_.end());
    memory.insert(memory.end(), scales_.begin(), scales_.end());
  }
  for (const auto& batch : points_) batch.save(memory);
  second_->save(memory);
}

void StepError::restore(const double*& memory) {
  seen_ = static_cast<long>(*memory++);
  end_ = static_cast<long>(*memory++);
  most_ = *memory++;
  count_ = static_cast<long>(*memory++);
  for (double* sum :
       {&errors_, &moved_, &sizes_, &lost_, &vibrated_, &speeds_, &offsets_, &looked_})
    *sum = *memory++;
  taken_ = static_cast<long>(*memory++);
  looks_ = static_cast<long>(*memory++);
  rested_ = *memory++;
  plan();
  if (end_ >= 0) {
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
  for (auto& batch : points_) batch.restore(points);  // the scheme has set scales of its own
}

}  // namespace tooljoint::transient
