// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/Spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Constants.hpp"

namespace tooljoint::cases {
namespace {

constexpr std::size_t fewestSamples = 32, shortestSegment = 16;
/// Number of lines on either side of a peak that contain the power of a sine under a Hann window.
constexpr std::size_t halfLobe = 2;

bool onlySmallFactors(std::size_t n) {
  for (const std::size_t factor : {2U, 3U, 5U})
    while (n % factor == 0) n /= factor;
  return n == 1;
}

}  // namespace

std::size_t shortSegments(std::size_t samples) {
  if (samples < fewestSamples) return 0;
  std::size_t length = shortestSegment;
  while (2 * length * 4 <= samples) length *= 2;
  return length;
}

std::size_t longSegments(std::size_t samples, int segments) {
  // segments of length L and shift L/2 take (segments + 1) L/2 samples
  std::size_t length = 2 * samples / (static_cast<std::size_t>(segments) + 1);
  length -= length % 2;
  while (length >= shortestSegment && !onlySmallFactors(length)) length -= 2;
  return length >= shortestSegment ? length : 0;
}

WelchSpectrum::WelchSpectrum(std::size_t length, double interval)
    : interval_(interval), length_(length) {
  if (length_ == 0) return;
  hann_.resize(length_);
  for (std::size_t i = 0; i < length_; ++i) {
    hann_[i] = 0.5 - 0.5 * std::cos(constants::twoPi * static_cast<double>(i) /
                                    static_cast<double>(length_));
    power_ += hann_[i] * hann_[i];
  }
  sum_.assign(length_ / 2 + 1, 0.0);
  segment_.resize(length_);
}

void WelchSpectrum::add(const std::vector<double>& signal) {
  if (length_ == 0) return;
  for (std::size_t first = 0; first + length_ <= signal.size(); first += length_ / 2)
    addSegment(signal.data() + first);
}

void WelchSpectrum::addSegment(const double* values) {
  double mean = 0.0;
  for (std::size_t i = 0; i < length_; ++i) mean += values[i] / static_cast<double>(length_);
  for (std::size_t i = 0; i < length_; ++i) segment_[i] = hann_[i] * (values[i] - mean);
  fft_.fwd(transform_, segment_);
  for (std::size_t k = 0; k < sum_.size(); ++k) sum_[k] += std::norm(transform_[k]);
  ++segments_;
}

Spectrum WelchSpectrum::sumOver(std::size_t signals) const {
  Spectrum out;
  if (length_ == 0 || segments_ == 0 || signals == 0) return out;
  const double segmentsPerSignal = static_cast<double>(segments_) / static_cast<double>(signals);
  for (std::size_t k = 0; k < sum_.size(); ++k) {
    const double sides = k == 0 || 2 * k == length_ ? 1.0 : 2.0;
    out.frequency.push_back(static_cast<double>(k) / (static_cast<double>(length_) * interval_));
    out.density.push_back(sides * interval_ * sum_[k] / (segmentsPerSignal * power_));
  }
  return out;
}

Spectrum spectrumOf(const std::vector<double>& signal, double interval, std::size_t length) {
  WelchSpectrum welch(length, interval);
  welch.add(signal);
  return welch.sumOver(1);
}

std::vector<SpectralPeak> largestPeaks(const Spectrum& spectrum, std::size_t most) {
  const auto& density = spectrum.density;
  std::vector<SpectralPeak> peaks;
  for (std::size_t k = 1; k < density.size(); ++k) {
    const auto first = density.begin() + static_cast<std::ptrdiff_t>(k - std::min(k, halfLobe));
    const auto last =
        density.begin() + static_cast<std::ptrdiff_t>(std::min(k + halfLobe + 1, density.size()));
    if (!(density[k] > 0.0) || *std::max_element(first, last) > density[k] ||
        density[k] == density[k - 1])
      continue;
    const double power = std::accumulate(first, last, 0.0) * spectrum.frequency[1];
    peaks.push_back({spectrum.frequency[k], std::sqrt(2.0 * power)});
  }
  std::stable_sort(peaks.begin(), peaks.end(),
                   [](const auto& a, const auto& b) { return a.amplitude > b.amplitude; });
  if (peaks.size() > most) peaks.resize(most);
  return peaks;
}

}  // namespace tooljoint::cases
