// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/SignalComparison.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Error.hpp"

namespace tooljoint::cases {
namespace {

/// Relative tolerance of times: samples at the ends of a window belong to it.
constexpr double rounding = 1e-9;
/// Sample distances with a smaller relative difference are equal.
constexpr double jitter = 1e-3;
/// A sample distance above this multiple of the median distance is a gap.
constexpr double gap = 2.5;
/// A signal with a smaller range, relative to its largest value, is constant up to rounding.
constexpr double constant = 1e-12;

SampledSignal within(const SampledSignal& signal, double begin, double end) {
  const double slack = rounding * std::max(1.0, std::abs(end) + std::abs(begin));
  SampledSignal out;
  for (std::size_t i = 0; i < signal.time.size(); ++i)
    if (signal.time[i] >= begin - slack && signal.time[i] <= end + slack) {
      out.time.push_back(signal.time[i]);
      out.value.push_back(signal.value[i]);
    }
  return out;
}

/// Equidistant samples and their distance.
struct EvenSignal {
  std::vector<double> value;
  double interval = 0.0;          ///< [s]
  double begin = 0.0, end = 0.0;  ///< [s]
};

EvenSignal evenly(const SampledSignal& signal) {
  const auto& t = signal.time;
  std::vector<double> steps;
  for (std::size_t i = 1; i < t.size(); ++i) steps.push_back(t[i] - t[i - 1]);
  auto sorted = steps;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  const double interval = *middle;
  if (std::all_of(steps.begin(), steps.end(),
                  [&](double step) { return std::abs(step - interval) <= jitter * interval; }))
    return {signal.value, (t.back() - t.front()) / static_cast<double>(steps.size()), t.front(),
            t.back()};
  std::size_t first = 0, best = 0, last = 0;
  for (std::size_t i = 1; i <= t.size(); ++i)
    if (i == t.size() || steps[i - 1] > gap * interval) {
      if (t[i - 1] - t[first] > t[last] - t[best]) best = first, last = i - 1;
      first = i;
    }
  EvenSignal out{{}, interval, t[best], t[last]};
  const double slack = rounding * interval;
  for (long k = 0; t[best] + static_cast<double>(k) * interval <= t[last] + slack; ++k)
    out.value.push_back(
        valueAt(signal, std::min(t[best] + static_cast<double>(k) * interval, t[last])));
  return out;
}

/// \param samples  of the signal, for its figures
/// \param even     of the same signal, for its spectrum
ComparedSignal describe(SampledSignal samples, const EvenSignal& even,
                        const SpectrumSettings& settings) {
  ComparedSignal out;
  for (const double value : samples.value) out.figures.add(value);
  out.spectrum =
      spectrumOf(even.value, even.interval, longSegments(even.value.size(), settings.segments));
  const auto& figures = out.figures;
  const double size = std::max(std::abs(figures.min()), std::abs(figures.max()));
  if (figures.max() - figures.min() > constant * size)
    out.peaks = largestPeaks(out.spectrum, settings.peaks);
  out.samples = std::move(samples);
  return out;
}

}  // namespace

double valueAt(const SampledSignal& signal, double t) {
  const auto& time = signal.time;
  const auto above = std::lower_bound(time.begin(), time.end(), t) - time.begin();
  const auto i = static_cast<std::size_t>(above);
  if (i == time.size()) return signal.value.back();
  if (i == 0 || time[i] == t) return signal.value[i];
  const double share = (t - time[i - 1]) / (time[i] - time[i - 1]);
  return signal.value[i - 1] + share * (signal.value[i] - signal.value[i - 1]);
}

SignalComparison compareSignals(const SampledSignal& computed, const SampledSignal& measured,
                                double begin, double end, const SpectrumSettings& settings) {
  SignalComparison out;
  if (computed.time.empty() || measured.time.empty())
    throw Error(ExitCode::Internal, "Signals without samples cannot be compared.");
  out.begin = std::max({begin, computed.time.front(), measured.time.front()});
  out.end = std::min({end, computed.time.back(), measured.time.back()});
  auto theirs = within(measured, out.begin, out.end);
  if (within(computed, out.begin, out.end).time.size() < 2 || theirs.time.size() < 2)
    throw Error(ExitCode::Internal,
                "A comparison of signals needs at least two samples in its window.");
  SampledSignal mine{theirs.time, {}};  // so that both signals have the same gaps and long steps
  double sum = 0.0, squares = 0.0;
  for (std::size_t i = 0; i < theirs.time.size(); ++i) {
    mine.value.push_back(valueAt(computed, theirs.time[i]));
    const double difference = mine.value.back() - theirs.value[i];
    out.difference.push_back(difference);
    sum += difference;
    squares += difference * difference;
    out.largest = std::max(out.largest, std::abs(difference));
  }
  const auto count = static_cast<double>(theirs.time.size());
  out.mean = sum / count;
  out.rms = std::sqrt(squares / count);
  const EvenSignal even = evenly(theirs);
  const auto stretch = within(computed, even.begin, even.end);
  const EvenSignal own = evenly(stretch.time.size() < 2 ? mine : stretch);
  out.computed = describe(std::move(mine), own, settings);
  out.measured = describe(std::move(theirs), even, settings);
  return out;
}

}  // namespace tooljoint::cases
