// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/StepError.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "transient/verdict/SpreadSteps.hpp"

namespace tooljoint::transient {
namespace {

/// Steps in a window. A frequency error does not show in a window that is short compared with
/// 1/omega. Schemes whose phase is accurate only to second order have such errors, so their windows
/// span this many radians of the motion, up to `longestWindow` steps.
constexpr long usualWindow = 8, longestWindow = 32;
constexpr double radiansInWindow = 2;
/// Steps from one window to the next; a usual window costs as much as 20 steps. Short runs have
/// `fewest` windows if possible, long ones at most `most`.
constexpr long usualStride = 400, fewest = 8, most = 128;
/// With fewer windows there is no estimate.
constexpr double fewestSaying = 2;
/// Motion in windows below this part of the displacement since the start is rest. Errors of the
/// iterations, too, are a part of the displacement, of the order of their tolerance.
constexpr double negligibleMotion = 1e-3;
/// Motion below this part of the displacement has no meaningful damping.
constexpr double quiet = 1e-6;
/// Over longer times [s] contact separates any two motions.
constexpr double longest = 3.0;
/// Later motion is measured if the run lasts this many times T.
constexpr double longer = 1.2;
/// The motion begins anew where it becomes this many times as large as before. It is then compared
/// from there, if that is later than this part of T; otherwise enough of T remains after the start.
constexpr double risen = 100, lateStart = 0.5;
/// |C_ij - C_ji| / 2 over twice the fourth root of K_ii M_ii K_jj M_jj. Above this, gyroscopic
/// terms matter: they change frequencies by about this part.
constexpr double strongGyroscopics = 0.05;

bool isGyroscopic(const CompiledModel& model, double t) {
  const auto& source = model.source();
  const Sparse C = source.dampingAt(t), transposed = C.transpose(), skew = 0.5 * (C - transposed);
  const Vector k = source.stiffnessAt(t).diagonal(), m = source.mass.diagonal();
  bool strong = false;
  for (int i = 0; i < skew.rows(); ++i)
    for (Sparse::InnerIterator it(skew, i); it; ++it) {
      const double scale = k[i] * m[i] * k[it.col()] * m[it.col()];
      strong = strong || (scale > 0 && std::abs(it.value()) >
                                           2 * strongGyroscopics * std::sqrt(std::sqrt(scale)));
    }
  return model.cut().any(strong);
}

}  // namespace

StepError::StepError(CompiledModel& model, const Integrator& run,
                     std::unique_ptr<Integrator> second, const Window& window, const State& start)
    : norm_(model),
      window_(model, run, std::move(second), window, start),
      damping_(dynamic_cast<const NumericalDamping*>(&run), start.q),
      begin_(window.begin),
      h_(run.equalStep()),
      turning_(std::min(longest, window.end - window.begin)),
      start_(start.q),
      difference_(start.q),
      followsPhase_(run.followsPhase(isGyroscopic(model, window.begin))),
      steps_(static_cast<long>(std::floor((window.end - window.begin) / h_ + 1e-6))),
      stride_(std::max(std::clamp(steps_ / fewest, usualWindow, usualStride), steps_ / most)),
      last_(start),
      calm_(start) {
  if (window.end - window.begin > longer * turning_)
    busiest_.emplace(model, window, turning_, start);
  plan();
}

void StepError::plan() {
  const auto i = static_cast<double>(seen_);
  next_ = stride_ == usualWindow ? stride_ * seen_  // consecutive windows
                                 : spreadStep(stride_, i, i + 1);
}

long StepError::windowNow() const {
  const double square = (sums_.speeds / sums_.offsets.max(1e-300)).maxCoeff();
  if (followsPhase_ || !(sums_.duration > 0) || !(square > 0)) return usualWindow;
  const double steps = radiansInWindow / (std::sqrt(square) * h_);
  return std::clamp(static_cast<long>(std::min(steps, 1e6)), usualWindow, longestWindow);
}

void StepError::before(const Integrator& run, const State& from) {
  if (end_ >= 0) return;
  const double passed = (from.t - begin_) / h_;
  const long step = std::lround(passed);
  if (step < next_ || std::abs(passed - static_cast<double>(step)) > 1e-6) return;
  inWindow_ = windowNow();
  if (step + inWindow_ > steps_) return;
  ++seen_;
  plan();
  end_ = step + inWindow_;
  most_ = {0, 0};
  watchCalm(from);
  window_.begin(run, from);
}

void StepError::watchCalm(const State& from) {
  difference_ = from.q - start_;
  const double level = norm_.squares(difference_)[1];
  if (level > risen * risen * level_) {
    level_ = level;
    if (last_.t - begin_ > lateStart * turning_) calm_ = last_;
  }
  last_ = from;
}

void StepError::after(const State& from, const State& to) {
  damping_.look(norm_, from, to);
  if (busiest_) busiest_->look(from, to);
  if (end_ < 0) return;
  const auto square = [&](const Vector& a, const Vector& b) {
    difference_ = a - b;
    return norm_.squares(difference_);
  };
  const double dt = to.t - from.t;
  sums_.speeds += square(to.q, from.q) / dt;
  sums_.offsets += square(to.q, start_) * dt;
  sums_.duration += dt;
  most_ = most_.max(square(to.q, window_.start()));
  const double endOfFirst = time(end_ - inWindow_ + 1), end = time(end_);
  if (to.t < endOfFirst + 1e-6 * h_) window_.endFirst(to.q);
  if (to.t < end - 1e-6 * h_) return;
  if (window_.take(endOfFirst, end)) {
    sums_.errors += square(to.q, window_.end());
    sums_.moved += most_;
    sums_.sizes += norm_.squares(to.q);
    ++sums_.windows;
  }
  end_ = -1;
}

double StepError::value() const {
  if (sums_.windows < fewestSaying) return 0.0;
  return std::max(of(0), of(1));
}

double StepError::of(int norm) const {
  const double error = sums_.errors[norm], moved = sums_.moved[norm], speed = sums_.speeds[norm],
               offset = sums_.offsets[norm];
  if (!(moved > 0)) return 0.0;
  const double noise = 1e-12 * std::sqrt(sums_.windows) + 1e-9 * std::sqrt(sums_.sizes[norm]);
  if (std::sqrt(error) <= noise) return 0.0;
  const double mean = sums_.duration > 0 ? offset / sums_.duration : 0.0;
  const double least = negligibleMotion * negligibleMotion * mean * sums_.windows;
  const double turns = offset > 0 ? turning_ * std::sqrt(speed / offset) : 1.0;
  return std::max(1.0, turns) * std::sqrt(error / std::max(moved, least));
}

double StepError::damped() const {
  if (sums_.windows < fewestSaying ||
      !(std::sqrt(sums_.moved[0]) > quiet * std::sqrt(sums_.sizes[0])))
    return 0.0;
  return damping_.damped(norm_, turning_);
}

void StepError::save(std::vector<double>& memory) const {
  memory.insert(memory.end(),
                {static_cast<double>(seen_), static_cast<double>(end_),
                 static_cast<double>(inWindow_), sums_.windows, sums_.duration, level_});
  for (const Norms* norms :
       {&most_, &sums_.errors, &sums_.moved, &sums_.sizes, &sums_.speeds, &sums_.offsets})
    memory.insert(memory.end(), norms->begin(), norms->end());
  last_.save(memory);
  calm_.save(memory);
  damping_.save(memory);
  if (busiest_) busiest_->save(memory);
  window_.save(memory, end_ >= 0);
}

void StepError::restore(const double*& memory) {
  seen_ = static_cast<long>(*memory++);
  end_ = static_cast<long>(*memory++);
  inWindow_ = static_cast<long>(*memory++);
  for (double* each : {&sums_.windows, &sums_.duration, &level_}) *each = *memory++;
  for (Norms* norms :
       {&most_, &sums_.errors, &sums_.moved, &sums_.sizes, &sums_.speeds, &sums_.offsets})
    for (double& each : *norms) each = *memory++;
  last_.restore(memory);
  calm_.restore(memory);
  damping_.restore(memory);
  if (busiest_) busiest_->restore(memory);
  plan();
  window_.restore(memory, end_ >= 0);
}

}  // namespace tooljoint::transient
