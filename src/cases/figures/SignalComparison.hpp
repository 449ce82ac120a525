// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Comparison of a computed with a measured signal: differences, values of both, spectra.
#pragma once

#include <cstddef>
#include <vector>

#include "cases/figures/SignalFigures.hpp"
#include "cases/figures/Spectrum.hpp"

namespace tooljoint::cases {

/// A signal at increasing times.
struct SampledSignal {
  std::vector<double> time;  ///< [s]
  std::vector<double> value;
};

/// One signal of a comparison over the common window.
struct ComparedSignal {
  SampledSignal samples;            ///< at the measured times of the window
  SignalFigures figures;            ///< fluctuationIndex() of a speed is the stick-slip index
  Spectrum spectrum;                ///< empty for fewer than 16 samples per segment
  std::vector<SpectralPeak> peaks;  ///< empty for a constant signal
};

struct SignalComparison {
  double begin = 0.0, end = 0.0;  ///< first and last time of the common window [s]
  ComparedSignal computed, measured;
  std::vector<double> difference;  ///< computed - measured at the measured times
  double mean = 0.0, rms = 0.0;    ///< of the difference; rms about zero
  double largest = 0.0;            ///< of its magnitude
};

struct SpectrumSettings {
  int segments = 3;       ///< of Welch's method
  std::size_t peaks = 3;  ///< number of largest peaks that are listed
};

/// Compares over the part of [begin, end] that both signals cover. The computed signal is linear
/// between its samples; its values are taken at the measured times. The spectrum of the measured
/// signal uses its samples directly if they are equidistant; otherwise the longest stretch without
/// gaps, linear between samples, at the median distance. The spectrum of the computed signal uses
/// the same stretch. Error(Internal) for fewer than two samples of either signal in the window.
SignalComparison compareSignals(const SampledSignal& computed, const SampledSignal& measured,
                                double begin, double end, const SpectrumSettings& settings);

/// Value at t of a signal that is linear between its samples; t is within its times.
double valueAt(const SampledSignal& signal, double t);

}  // namespace tooljoint::cases
