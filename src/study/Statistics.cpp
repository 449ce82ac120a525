// SPDX-License-Identifier: BSD-3-Clause
#include "study/Statistics.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "cases/figures/Spectrum.hpp"
#include "common/Error.hpp"

namespace tooljoint::study {
namespace {

constexpr double dynamicRange = 1e-6;  ///< 60 dB

/// Mean density in third-octave bands, from the second line of the spectrum on.
std::vector<double> thirdOctaves(const std::vector<double>& frequency,
                                 const std::vector<double>& spectrum) {
  std::vector<double> bands;
  if (frequency.size() < 3) return bands;
  const double ratio = std::cbrt(2.0);
  std::size_t k = 2;
  for (double edge = frequency[2] * 0.999; edge < frequency.back(); edge *= ratio) {
    double sum = 0.0;
    int lines = 0;
    for (; k < frequency.size() && frequency[k] < edge * ratio; ++k, ++lines) sum += spectrum[k];
    if (lines > 0) bands.push_back(sum / lines);
  }
  return bands;
}

double bandDifference(const MotionStatistics& a, const MotionStatistics& b) {
  const auto mine = thirdOctaves(a.frequency, a.spectrum);
  const auto theirs = thirdOctaves(b.frequency, b.spectrum);
  if (mine.size() != theirs.size() || mine.empty()) return 0.0;
  const double highest = *std::max_element(theirs.begin(), theirs.end());
  double sum = 0.0;
  int bands = 0;
  for (std::size_t i = 0; i < mine.size(); ++i) {
    if (!(theirs[i] > dynamicRange * highest)) continue;
    const double decibel =
        10.0 * std::log10(std::max(mine[i], dynamicRange * dynamicRange * highest) / theirs[i]);
    sum += decibel * decibel;
    ++bands;
  }
  return bands == 0 ? 0.0 : std::sqrt(sum / bands);
}

}  // namespace

double quantile(std::vector<double> values, double fraction) {
  if (values.empty()) throw Error(ExitCode::Internal, "A quantile needs at least one number.");
  std::sort(values.begin(), values.end());
  const double place = fraction * static_cast<double>(values.size() - 1);
  const auto below = static_cast<std::size_t>(place);
  const auto above = std::min(below + 1, values.size() - 1);
  return values[below] + (place - static_cast<double>(below)) * (values[above] - values[below]);
}

MotionStatistics statisticsOf(const HistoryView& history, const std::vector<double>& bitSpeed,
                              const std::vector<double>& clearance, const Window& window) {
  if ((!bitSpeed.empty() && bitSpeed.size() != history.samples) ||
      clearance.size() != history.nodes)
    throw Error(ExitCode::Internal,
                "The bit speeds or clearances do not match the history of the statistics.");
  std::vector<std::size_t> samples;
  for (std::size_t i = 0; i < history.samples; ++i)
    if (history.time[i] >= window.begin - 1e-9 && history.time[i] <= window.end + 1e-9)
      samples.push_back(i);
  if (samples.size() < 2)
    throw Error(ExitCode::Internal, "Statistics need at least two samples in their window.");

  MotionStatistics s;
  s.samples = samples.size();
  const auto count = static_cast<double>(samples.size());
  std::vector<double> speeds;
  for (auto i : samples)
    if (!bitSpeed.empty()) speeds.push_back(bitSpeed[i]);
  for (double level : quantileLevels)
    if (!speeds.empty()) s.bitSpeed.push_back(quantile(speeds, level));

  cases::WelchSpectrum welch(cases::shortSegments(samples.size()),
                             history.time[samples[1]] - history.time[samples[0]]);
  std::vector<double> signal(samples.size());
  for (std::size_t n = 0; n < history.nodes; ++n) {
    double touching = 0.0;
    for (auto i : samples) touching += history.radius(i, n) > clearance[n] ? 1.0 : 0.0;
    s.contactDuty.push_back(touching / count);
    double variance = 0.0;
    for (std::size_t c = 0; c < history.vibrating; ++c) {
      double mean = 0.0;
      for (std::size_t k = 0; k < samples.size(); ++k)
        mean += (signal[k] = history.at(samples[k], n, c)) / count;
      for (double x : signal) variance += (x - mean) * (x - mean) / count;
      welch.add(signal);
    }
    s.lateralRms.push_back(std::sqrt(variance));
  }
  auto spectrum = welch.sumOver(history.nodes);
  s.frequency = std::move(spectrum.frequency);
  s.spectrum = std::move(spectrum.density);
  return s;
}

StatisticsDifference difference(const MotionStatistics& motion, const MotionStatistics& reference) {
  if (motion.contactDuty.size() != reference.contactDuty.size() ||
      motion.bitSpeed.size() != reference.bitSpeed.size())
    throw Error(ExitCode::Internal, "Statistics of different numbers of nodes cannot be compared.");
  StatisticsDifference d;
  for (std::size_t i = 0; i < reference.bitSpeed.size(); ++i)
    d.bitSpeed = std::max(d.bitSpeed, std::abs(motion.bitSpeed[i] - reference.bitSpeed[i]));
  double error = 0.0;
  double size = 0.0;
  const std::size_t nodes = reference.contactDuty.size();
  for (std::size_t n = 0; n < nodes; ++n) {
    const double duty = std::abs(motion.contactDuty[n] - reference.contactDuty[n]);
    d.dutyMax = std::max(d.dutyMax, duty);
    d.dutyMean += duty / static_cast<double>(nodes);
    error += std::pow(motion.lateralRms[n] - reference.lateralRms[n], 2);
    size += std::pow(reference.lateralRms[n], 2);
  }
  d.lateralRms = std::sqrt(size) > negligibleNorm ? std::sqrt(error / size) : 0.0;
  d.spectrum = bandDifference(motion, reference);
  return d;
}

}  // namespace tooljoint::study
