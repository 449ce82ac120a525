// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A computed signal beside a measured one: differences, figures of both, spectra.
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
  Spectrum spectrum;                ///< empty for fewer than 16 samples a segment
  std::vector<SpectralPeak> peaks;  ///< none of a constant signal
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
  std::size_t peaks = 3;  ///< largest ones that are listed
};

/// Compares over the part of [begin, end] that both signals cover. The computed signal is linear
/// between its samples; its figures are those at the measured times. Spectra are taken of the
/// measured samples as they are where they have equal distances, else of the longest stretch
/// without gaps, linear between samples, at the median of the distances; of the computed ones in
/// the same stretch. Error(Internal) for fewer than two samples of either signal in the window.
SignalComparison compareSignals(const SampledSignal& computed, const SampledSignal& measured,
                                double begin, double end, const SpectrumSettings& settings);

/// Value at t of a signal that is linear between its samples; t lies within its times.
double valueAt(const SampledSignal& signal, double t);

}  // namespace tooljoint::cases
