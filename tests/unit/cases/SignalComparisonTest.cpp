// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Spectra and comparisons of known signals.
#include "cases/figures/SignalComparison.hpp"

#include <cmath>
#include <gtest/gtest.h>

#include "common/Constants.hpp"
#include "common/Error.hpp"

namespace SignalComparisonTest {

using namespace tooljoint;
using namespace tooljoint::cases;

constexpr double interval = 0.01;

std::vector<double> sine(std::size_t samples, double amplitude, double frequency) {
  std::vector<double> values;
  for (std::size_t i = 0; i < samples; ++i)
    values.push_back(amplitude *
                     std::sin(constants::twoPi * frequency * interval * static_cast<double>(i)));
  return values;
}

double power(const Spectrum& spectrum) {
  double sum = 0.0;
  for (const double density : spectrum.density) sum += density * spectrum.frequency[1];
  return sum;
}

// A^2/2 = (S_k-1 + S_k + S_k+1) df of a sine on line k; S_k = A^2/(3 df) under a Hann window,
// whose noise bandwidth is 1.5 lines
TEST(Spectrum, OfASineOnALine) {
  const auto spectrum = spectrumOf(sine(800, 3.0, 10.0), interval, 200);
  const double line = 1.0 / (200 * interval);
  ASSERT_EQ(spectrum.frequency.size(), 101U);
  EXPECT_NEAR(spectrum.frequency[1], line, 1e-14);
  EXPECT_NEAR(spectrum.density[20], 9.0 / (3.0 * line), 1e-10);
  EXPECT_NEAR(power(spectrum), 4.5, 1e-10);
  const auto peaks = largestPeaks(spectrum, 3);
  ASSERT_FALSE(peaks.empty());
  EXPECT_NEAR(peaks[0].frequency, 10.0, 1e-12);
  EXPECT_NEAR(peaks[0].amplitude, 3.0, 1e-10);
}

TEST(Spectrum, ASineBetweenLinesKeepsItsAmplitudeWithinTwoPerCent) {
  const auto peaks = largestPeaks(spectrumOf(sine(800, 3.0, 10.25), interval, 200), 1);
  ASSERT_EQ(peaks.size(), 1U);
  EXPECT_NEAR(peaks[0].amplitude, 3.0, 0.06);
}

// A sine on a line has a higher density than one of a tenth more amplitude between lines.
TEST(Spectrum, PeaksComeByAmplitude) {
  auto signal = sine(800, 1.0, 10.0);
  const auto between = sine(800, 1.1, 20.25);
  for (std::size_t i = 0; i < signal.size(); ++i) signal[i] += between[i];
  const auto spectrum = spectrumOf(signal, interval, 200);
  const auto peaks = largestPeaks(spectrum, 5);
  ASSERT_GE(peaks.size(), 2U);
  EXPECT_NEAR(peaks[0].frequency, 20.25, 0.3);
  EXPECT_NEAR(peaks[1].frequency, 10.0, 1e-12);
  EXPECT_GT(peaks[0].amplitude, peaks[1].amplitude);
}

// Parseval: sum of S df over one segment is sum (w x)^2/sum w^2, x without its mean
TEST(Spectrum, HoldsThePowerOfTheSignal) {
  std::vector<double> values;
  unsigned state = 1;
  for (int i = 0; i < 360; ++i) {
    state = 1664525U * state + 1013904223U;
    values.push_back(state / 4294967296.0);
  }
  double mean = 0.0, weighted = 0.0, window = 0.0;
  for (const double value : values) mean += value / 360.0;
  for (int i = 0; i < 360; ++i) {
    const double w = 0.5 - 0.5 * std::cos(constants::twoPi * i / 360.0);
    const auto k = static_cast<std::size_t>(i);
    weighted += w * w * (values[k] - mean) * (values[k] - mean);
    window += w * w;
  }
  EXPECT_NEAR(power(spectrumOf(values, interval, 360)), weighted / window, 1e-14);
}

TEST(Spectrum, SegmentsFitIntoTheSamples) {
  EXPECT_EQ(longSegments(1000, 3), 500U);
  EXPECT_EQ(longSegments(1000, 1), 1000U);
  EXPECT_EQ(longSegments(1003, 1), 1000U);
  EXPECT_EQ(longSegments(30, 3), 0U);
  EXPECT_EQ(shortSegments(31), 0U);
  EXPECT_EQ(shortSegments(512), 128U);
  EXPECT_TRUE(spectrumOf({1.0, 2.0}, interval, 0).frequency.empty());
}

SampledSignal sampled(double first, double step, std::size_t samples, double slope) {
  SampledSignal out;
  for (std::size_t i = 0; i < samples; ++i) {
    out.time.push_back(first + step * static_cast<double>(i));
    out.value.push_back(slope * out.time.back());
  }
  return out;
}

// x = 2 t, y = 3 t at t = 1, 1.5, 2: differences -1, -1.5, -2
TEST(SignalComparison, OfStraightLines) {
  const auto found =
      compareSignals(sampled(0, 0.1, 21, 2.0), sampled(1, 0.5, 9, 3.0), 0.0, 10.0, {});
  EXPECT_DOUBLE_EQ(found.begin, 1.0);
  EXPECT_NEAR(found.end, 2.0, 1e-12);
  ASSERT_EQ(found.difference.size(), 3U);
  EXPECT_NEAR(found.mean, -1.5, 1e-12);
  EXPECT_NEAR(found.rms, std::sqrt((1 + 2.25 + 4) / 3.0), 1e-12);
  EXPECT_NEAR(found.largest, 2.0, 1e-12);
  EXPECT_EQ(found.computed.figures.samples(), 3) << "at the measured times";
  EXPECT_NEAR(found.computed.figures.mean() - found.measured.figures.mean(), found.mean, 1e-12);
  EXPECT_NEAR(found.computed.figures.fluctuationIndex(), (4.0 - 2.0) / (2 * 3.0), 1e-12);
  EXPECT_NEAR(found.measured.figures.fluctuationIndex(), (6.0 - 3.0) / (2 * 4.5), 1e-12);
}

TEST(SignalComparison, RoundingHasNoPeaks) {
  auto constant = sampled(0, interval, 400, 0.0);
  for (std::size_t i = 0; i < constant.value.size(); ++i)
    constant.value[i] = 1e5 + (i % 2 == 0 ? 1e-10 : 0.0);
  const auto found = compareSignals(constant, sampled(0, interval, 400, 1.0), 0, 10, {});
  EXPECT_TRUE(found.computed.peaks.empty());
  EXPECT_FALSE(found.computed.spectrum.frequency.empty());
}

TEST(SignalComparison, NeedsTwoSamplesOfEither) {
  EXPECT_THROW(compareSignals(sampled(0, 0.1, 5, 1), sampled(2, 0.1, 5, 1), 0, 10, {}), Error);
}

TEST(SignalComparison, SpectraAreOfTheLongestStretchWithoutGaps) {
  SampledSignal measured;
  const auto values = sine(1000, 1.0, 12.5);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (i < 100 || i >= 300) {  // a gap of two seconds
      measured.time.push_back(interval * static_cast<double>(i));
      measured.value.push_back(values[i]);
    }
  const auto found = compareSignals(sampled(0, interval, 1000, 0.0), measured, 0, 10, {1, 3});
  EXPECT_EQ(found.measured.spectrum.frequency.size(), 325U);  // 648 = 8 81 of 700 samples
  ASSERT_FALSE(found.measured.peaks.empty());
  EXPECT_NEAR(found.measured.peaks[0].frequency, 12.5, 0.1);
  EXPECT_EQ(found.computed.spectrum.frequency.size(), 325U) << "of the same stretch";
}

}  // namespace SignalComparisonTest
