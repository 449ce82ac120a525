// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Statistics of a motion in place of its samples: for times at which two correct integrators no
/// longer agree pointwise.
#pragma once

#include <array>
#include <vector>

#include "study/Metrics.hpp"

namespace tooljoint::study {

/// Probabilities of the quantiles of the bit speed.
constexpr std::array<double, 5> quantileLevels{0.05, 0.25, 0.5, 0.75, 0.95};

struct MotionStatistics {
  std::size_t samples = 0;
  std::vector<double> bitSpeed;     ///< quantiles at quantileLevels [rad/s]; empty without a bit
  std::vector<double> contactDuty;  ///< per node: fraction of the samples at which |x| exceeds the
                                    ///< clearance, x the vibrating components
  std::vector<double> lateralRms;   ///< per node: sqrt(mean |x - mean x|^2) [m]
  std::vector<double> frequency;    ///< of the spectrum [Hz]; empty for fewer than 32 samples
  std::vector<double>
      spectrum;  ///< one-sided density, sum of the vibrating components, mean of the nodes [m2/Hz]
};

/// Statistics of the samples inside the window. `bitSpeed` has one value per sample of the history,
/// or none; `clearance` has one per node (infinite if it cannot touch anything). Spectra after P.
/// D. Welch, IEEE Trans. Audio Electroacoust. 15 (1967) 70-73: neighbouring segments overlap by
/// half, Hann windows, segment means removed. Error(Internal) for other sizes or a window without
/// samples.
MotionStatistics statisticsOf(const HistoryView& history, const std::vector<double>& bitSpeed,
                              const std::vector<double>& clearance, const Window& window);

/// Differences between the statistics of two motions.
struct StatisticsDifference {
  double bitSpeed = 0.0;    ///< largest difference of a quantile [rad/s]
  double dutyMax = 0.0;     ///< largest difference of the contact duty of a node
  double dutyMean = 0.0;    ///< mean over the nodes
  double lateralRms = 0.0;  ///< |rms - rms_ref| / |rms_ref| over the nodes
  double spectrum = 0.0;    ///< root mean square over third-octave bands of 10 lg(S/S_ref) [dB];
                            ///< bands 60 dB below the highest omitted
};

StatisticsDifference difference(const MotionStatistics& motion, const MotionStatistics& reference);

/// Value below which this fraction of the numbers lies, linear between neighbours.
double quantile(std::vector<double> values, double fraction);

}  // namespace tooljoint::study
