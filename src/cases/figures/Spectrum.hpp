// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Power spectra of sampled signals: mean of modified periodograms of overlapping segments (P. D.
/// Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70-73). Neighbouring segments overlap by half;
/// Hann windows, segment means removed.
#pragma once

#include <complex>
#include <cstddef>
#include <unsupported/Eigen/FFT>
#include <vector>

namespace tooljoint::cases {

/// One-sided power density; both are empty for signals that are too short.
struct Spectrum {
  std::vector<double> frequency;  ///< k/(length interval), k = 0 ... length/2 [Hz]
  std::vector<double> density;    ///< [unit2/Hz]
};

/// The largest power of two as segment length for which seven half-overlapping segments fit into
/// the samples; 0 for fewer than 32 samples.
std::size_t shortSegments(std::size_t samples);
/// The largest even product of 2, 3 and 5 as segment length for which `segments` half-overlapping
/// segments fit into the samples; 0 if it is below 16.
std::size_t longSegments(std::size_t samples, int segments);

/// Mean of modified periodograms of many signals of one kind.
class WelchSpectrum {
 public:
  /// \param length    samples of a segment, even; 0 for none
  /// \param interval  between samples [s]
  WelchSpectrum(std::size_t length, double interval);

  /// Adds the segments of a signal.
  void add(const std::vector<double>& signal);

  /// Sum over the segments divided by the number of segments per signal, so that spectra of
  /// components add up:
  ///
  ///     S(f_k) = 2 dt sum |X_k|^2 / (segments sum w^2),
  ///
  /// without the factor 2 at f = 0 and at Nyquist. Empty without segments.
  Spectrum sumOver(std::size_t signals) const;

 private:
  void addSegment(const double* values);

  double interval_;
  std::size_t length_;
  double power_ = 0.0;
  std::vector<double> hann_, sum_, segment_;
  std::vector<std::complex<double>> transform_;
  Eigen::FFT<double> fft_;
  std::size_t segments_ = 0;
};

/// The spectrum of one signal.
Spectrum spectrumOf(const std::vector<double>& signal, double interval, std::size_t length);

struct SpectralPeak {
  double frequency = 0.0;  ///< [Hz]
  double amplitude = 0.0;  ///< of the sine with the power of the peak
};

/// The largest peaks above f = 0, by decreasing amplitude: maxima of the density within two lines
/// on either side, the main lobe of a Hann window. A^2/2 is the power in that lobe; exact for a
/// sine on a line.
std::vector<SpectralPeak> largestPeaks(const Spectrum& spectrum, std::size_t most);

}  // namespace tooljoint::cases
