// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/StepComparison.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/Error.hpp"
#include "transient/accuracy/NumericalDamping.hpp"

namespace tooljoint::transient {
namespace {

/// Part of its velocity that a motion is disturbed by, so often in T, in turns up and down.
constexpr double disturbance = 1e-3;
constexpr long disturbances = 16;
/// Motion below this part of all displacement is rounding, and a speed that would take T for this
/// part of the motion is rest.
constexpr double rounding = 1e-6, rest = 1e-3;
/// Shorter steps cost more than they tell: contact that they do not resolve is warned of.
constexpr int mostParts = 32;

}  // namespace

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
  window_.sampling = window.step;  // of which steps of a half are a whole part
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
  model_->remember(motion.model);
}

/// To the step that ends at t.
void StepComparison::advance(Motion& motion, double t) {
  model_->comeBack(motion.model);
  motion.points.swap(model_->points());
  while (motion.state.t < t - 1e-6 * window_.step) {
    motion.scheme->advance(motion.state, motion.next);
    std::swap(motion.state, motion.next);
  }
  motion.points.swap(model_->points());
  model_->remember(motion.model);
}

std::unique_ptr<Integrator> StepComparison::sharpened() const {
  auto made = make_();
  made->sharpen();
  return made;
}

std::optional<StepComparison::Difference> StepComparison::compare(std::unique_ptr<Integrator> first,
                                                                  double step, double kick) {
  CompiledModel::Snapshot snapshot;
  model_->remember(snapshot);
  const long steps = std::lround((window_.end - window_.begin) / window_.step);
  const long between = std::max(1L, steps / disturbances);
  double apart = 0, moved = 0, size = 0, speed = 0, otherSpeed = 0, v = 0, otherV = 0;
  long unresolved = 0;
  bool whole = false;
  try {
    Motion run, second;
    begin(run, std::move(first), step);
    begin(second, sharpened(), shorterStep());
    const auto* contact = dynamic_cast<const NumericalDamping*>(second.scheme.get());
    Vector before = start_.q, otherBefore = start_.q, difference = start_.q;
    const auto square = [&](const Vector& a, const Vector& b) {
      difference = a - b;
      return norm_.square(difference);
    };
    for (long k = 1; k <= steps && !stop_(); ++k) {
      const double t = window_.begin + static_cast<double>(k) * window_.step;
      if (k % between == 0) second.state.v *= k / between % 2 == 0 ? 1 - kick : 1 + kick;
      advance(run, t);
      advance(second, t);
      if (contact != nullptr && contact->hasUnresolvedContact()) ++unresolved;
      apart += square(run.state.q, second.state.q);
      moved += square(second.state.q, start_.q);
      size += norm_.square(second.state.q);
      v += square(run.state.v, second.state.v);
      otherV += norm_.square(second.state.v);
      if (2 * k > steps) {
        speed += square(run.state.q, before);
        otherSpeed += square(second.state.q, otherBefore);
      }
      before = run.state.q;
      otherBefore = second.state.q;
      whole = k == steps;
    }
  } catch (const ConvergenceError&) {
  }
  model_->comeBack(snapshot);
  if (!whole || !std::isfinite(apart + moved + otherSpeed)) return std::nullopt;
  Difference found;
  found.unresolved = static_cast<double>(unresolved) > oftenUnresolved * static_cast<double>(steps);
  if (std::max(moved, apart) <= rounding * rounding * size) return found;
  found.size = moved > 0 ? std::sqrt(apart / moved) : std::numeric_limits<double>::infinity();
  if (otherV > 0) found.velocities = std::sqrt(v / otherV);
  const double inT = static_cast<double>(steps * steps) * std::max(speed, otherSpeed);
  if (inT <= rest * rest * moved) return found;
  found.speeds =
      otherSpeed > 0 ? std::sqrt(speed / otherSpeed) : std::numeric_limits<double>::infinity();
  return found;
}

}  // namespace tooljoint::transient
