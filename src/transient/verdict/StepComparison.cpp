// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/StepComparison.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"
#include "transient/accuracy/NumericalDamping.hpp"

namespace tooljoint::transient {
namespace {

/// Relative disturbance of the velocity, and the number of disturbances in T, of alternating sign.
constexpr double disturbance = 1e-3;
constexpr long disturbances = 16;
/// Motion below this part of the displacement is rounding.
constexpr double rounding = 1e-6;
/// Speeds of the second half below this part of those of all T count as rest: chatter after a
/// landing and ringing are no part of the motion.
constexpr double rest = 0.01;
/// Shorter steps cost more than they are worth; the run warns of contact that they do not resolve.
constexpr int mostParts = 32;

}  // namespace

double farthest(const Norms& ratios) {
  double found = 1;
  for (const double ratio : ratios)
    if (std::abs(std::log(ratio)) > std::abs(std::log(found))) found = ratio;
  return found;
}

StepComparison::StepComparison(CompiledModel& model,
                               std::function<std::unique_ptr<Integrator>()> make,
                               const Window& window, double span, const State& start,
                               std::function<bool()> stop)
    : model_(&model),
      make_(std::move(make)),
      window_(window),
      start_(start),
      stop_(std::move(stop)),
      norm_(model) {
  const double steps = std::max(1.0, std::floor(span / window.step + 1e-6));
  window_.end = std::min(window.end, window.begin + steps * window.step);
  whole_ = window.end - window_.end < window.step;
  window_.sampling = window.step;  // a multiple of half a step
}

bool StepComparison::shorten() {
  if (parts_ >= mostParts) return false;
  parts_ *= 4;
  return true;
}

std::optional<StepComparison::Difference> StepComparison::withShorter() {
  return compare(make_(), window_.step, 0);
}

std::optional<StepComparison::Difference> StepComparison::withDisturbed() {
  return compare(sharpened(), shorterStep(), disturbance);
}

void StepComparison::begin(Motion& motion, std::unique_ptr<Integrator> scheme, double step) {
  motion.scheme = std::move(scheme);
  motion.points = model_->makePoints();
  motion.state = motion.next = start_;
  Window window = window_;
  window.step = step;
  motion.points.swap(model_->points());
  model_->setTime(window.begin);
  motion.scheme->prepare(*model_, window, motion.state);
  motion.points.swap(model_->points());
  model_->timed().remember(motion.model);
}

/// Advances to the end of the step at t.
void StepComparison::advance(Motion& motion, double t) {
  model_->timed().comeBack(motion.model);
  motion.points.swap(model_->points());
  while (motion.state.t < t - 1e-6 * window_.step) {
    motion.scheme->advance(motion.state, motion.next);
    std::swap(motion.state, motion.next);
  }
  motion.points.swap(model_->points());
  model_->timed().remember(motion.model);
}

std::unique_ptr<Integrator> StepComparison::sharpened() const {
  auto made = make_();
  made->sharpen();
  return made;
}

std::optional<StepComparison::Difference> StepComparison::compare(std::unique_ptr<Integrator> first,
                                                                  double step, double kick) {
  TimedTerms::Snapshot snapshot;
  model_->timed().remember(snapshot);
  const long steps = std::lround((window_.end - window_.begin) / window_.step);
  const long between = std::max(1L, steps / disturbances);
  Sums sums;
  long unresolved = 0;
  bool whole = false, stopped = false;
  try {
    Motion run, second;
    begin(run, std::move(first), step);
    begin(second, sharpened(), shorterStep());
    const auto* contact = dynamic_cast<const NumericalDamping*>(second.scheme.get());
    Vector before = start_.q, otherBefore = start_.q, difference = start_.q;
    const auto square = [&](const Vector& a, const Vector& b) {
      difference = a - b;
      return norm_.squares(difference);
    };
    for (long k = 1; k <= steps; ++k) {
      stopped = stop_();
      if (stopped) break;
      const double t = window_.begin + static_cast<double>(k) * window_.step;
      if (k % between == 0) second.state.v *= k / between % 2 == 0 ? 1 - kick : 1 + kick;
      advance(run, t);
      advance(second, t);
      if (contact != nullptr && contact->hasUnresolvedContact()) ++unresolved;
      sums.apart += square(run.state.q, second.state.q);
      sums.moved += square(second.state.q, start_.q);
      sums.size += norm_.squares(second.state.q);
      sums.v += square(run.state.v, second.state.v);
      sums.otherV += norm_.squares(second.state.v);
      const Norms otherPath = square(second.state.q, otherBefore);
      sums.otherPath += otherPath;
      if (2 * k > steps) {
        sums.latePath += square(run.state.q, before);
        sums.otherLatePath += otherPath;
      }
      before = run.state.q;
      otherBefore = second.state.q;
      whole = k == steps;
    }
  } catch (const ConvergenceError&) {
  }
  model_->timed().comeBack(snapshot);
  if (stopped) throw InterruptedError("Interrupted while the time step was judged.");
  if (!whole || !sums.isFinite()) return std::nullopt;
  Difference found = differenceOf(sums);
  found.unresolved = static_cast<double>(unresolved) > oftenUnresolved * static_cast<double>(steps);
  return found;
}

StepComparison::Difference StepComparison::differenceOf(const Sums& sums) const {
  Difference found;
  found.whole = whole_;
  const auto moving = (sums.moved.max(sums.apart) > rounding * rounding * sums.size).eval();
  found.still = !moving.any();
  found.sizes = moving.select(rootRatio(sums.apart, sums.moved), 0.0);
  found.size = found.sizes.maxCoeff();
  found.velocities = moving.select(rootRatio(sums.v, sums.otherV), 0.0).maxCoeff();
  const Norms speeds = rootRatio(sums.latePath, sums.otherLatePath);
  const auto late = sums.latePath.max(sums.otherLatePath);
  for (int norm = 0; norm < speeds.size(); ++norm)
    if (moving[norm] && late[norm] > rest * rest * sums.otherPath[norm])
      found.ratios[norm] = speeds[norm];
  found.speeds = farthest(found.ratios);
  return found;
}

}  // namespace tooljoint::transient
