// SPDX-License-Identifier: BSD-3-Clause
#include "model/laws/DelayLine.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::model {
namespace {

constexpr int fewest = 4;

/// A rate of the sign of the secant and at most three times as large: the cubic is then monotone.
double limited(double rate, double secant) {
  if (rate * secant <= 0.0) return 0.0;
  return std::abs(rate) > 3.0 * std::abs(secant) ? 3.0 * secant : rate;
}

}  // namespace

DelayLine::DelayLine(int values, double span, int samples, Shape shape)
    : values_(values), samples_(samples), row_(1 + 2 * values), shape_(shape) {
  if (!(span > 0) || samples < fewest || values < 1)
    throw ModelError("A delay line of " + std::to_string(values) + " values over " +
                     formatNumber(span) + " s with " + std::to_string(samples) +
                     " samples is not valid: it needs a value, a positive span and at least " +
                     std::to_string(fewest) + " samples.");
  spacing_ = span / (samples - 2);
}

/// t, y, y' of the sample this many before the newest.
const double* DelayLine::sample(const double* memory, int age) const {
  const int slot = (static_cast<int>(memory[1]) - age + samples_) % samples_;
  return memory + header + slot * row_;
}

void DelayLine::start(double t, const double* y, double* memory) const {
  std::fill(memory, memory + states(), 0.0);
  memory[0] = 1;
  memory[header] = t;
  std::copy(y, y + values_, memory + header + 1);
}

void DelayLine::start(double t, const double* y, const double* yDot, double* memory) const {
  const double span = spacing_ * (samples_ - 2);
  start(t - span, y, memory);
  double* first = memory + header + 1;
  for (int i = 0; i < values_; ++i) {
    first[i] = y[i] - span * yDot[i];
    first[values_ + i] = yDot[i];
  }
  append(t, y, yDot, memory);
}

void DelayLine::append(double t, const double* y, const double* yDot, double* memory) const {
  const int count = static_cast<int>(memory[0]);
  const bool replaces =
      count > 1 && sample(memory, 0)[0] - sample(memory, 1)[0] < spacing_ * (1 - 1e-9);
  if (!replaces) {
    memory[0] = std::min(count + 1, samples_);
    memory[1] = (static_cast<int>(memory[1]) + 1) % samples_;
  }
  double* newest = memory + header + static_cast<int>(memory[1]) * row_;
  newest[0] = t;
  std::copy(yDot, yDot + values_, std::copy(y, y + values_, newest + 1));
}

void DelayLine::raise(double t0, const double* y0, double t1, const double* y1,
                      double* memory) const {
  const int count = static_cast<int>(memory[0]);
  for (int age = 0; age < count; ++age) {
    double* one = memory + (sample(memory, age) - memory);
    if (one[0] < t0) return;
    if (one[0] > t1) continue;
    const double share = t1 > t0 ? (one[0] - t0) / (t1 - t0) : 1.0;
    for (int i = 0; i < values_; ++i) {
      const double y = y0[i] + share * (y1[i] - y0[i]);
      if (y <= one[1 + i]) continue;
      one[1 + i] = y;
      one[1 + values_ + i] = t1 > t0 ? (y1[i] - y0[i]) / (t1 - t0) : 0.0;
    }
  }
}

void DelayLine::at(double t, const double* memory, double* y, double* yDot) const {
  const int count = static_cast<int>(memory[0]);
  const double* after = sample(memory, 0);
  if (t > after[0])
    throw ConvergenceError("A delayed motion is needed at t = " + formatNumber(t) +
                           " s, but it is known up to " + formatNumber(after[0]) +
                           " s only: the delay is shorter than the time step. Reduce "
                           "Transient/Step below the delay.");
  const double* oldest = sample(memory, count - 1);
  if (t <= oldest[0]) {
    if (count == samples_ && t < oldest[0])
      throw ModelError("A delayed motion is needed at t = " + formatNumber(t) +
                       " s, but the delay line begins at " + formatNumber(oldest[0]) +
                       " s. Give it a longer span.");
    std::copy(oldest + 1, oldest + 1 + values_, y);
    if (yDot != nullptr) std::fill(yDot, yDot + values_, 0.0);
    return;
  }
  int low = 0, high = count - 1;  // ages: the sample of `high` is before t, that of `low` is not
  while (high - low > 1) {
    const int middle = (low + high) / 2;
    (sample(memory, middle)[0] < t ? high : low) = middle;
  }
  after = sample(memory, low);
  const double* before = sample(memory, high);
  const double h = after[0] - before[0], s = (t - before[0]) / h;
  for (int i = 0; i < values_; ++i) {
    const double a = before[1 + i], b = after[1 + i];
    double aDot = before[1 + values_ + i], bDot = after[1 + values_ + i];
    if (shape_ == Shape::Monotone) {
      aDot = limited(aDot, (b - a) / h);
      bDot = limited(bDot, (b - a) / h);
    }
    y[i] = (1 + 2 * s) * (1 - s) * (1 - s) * a + s * (1 - s) * (1 - s) * h * aDot +
           s * s * (3 - 2 * s) * b + s * s * (s - 1) * h * bDot;
    if (yDot != nullptr)
      yDot[i] =
          6 * s * (1 - s) * (b - a) / h + (1 - s) * (1 - 3 * s) * aDot + s * (3 * s - 2) * bDot;
  }
}

}  // namespace tooljoint::model
