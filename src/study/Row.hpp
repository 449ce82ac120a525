// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One run of a study with its plan, cost and errors.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/Expansion.hpp"
#include "study/Statistics.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::study {

/// Pointwise errors over the window.
struct PointwiseErrors {
  double epsTMax = 0.0;
  double epsTMean = 0.0;
  double epsNMax = 0.0;
  double vibration = 0.0;
};

/// The lowest modes of the full model, one entry each, and the coupled modes with the same shape.
struct ModeErrors {
  std::vector<double> full, coupled;  ///< [Hz], negative when divergent
  std::vector<double> mac;
  std::vector<double> error;  ///< coupled / full - 1
  std::vector<double>
      estimate;  ///< of `error`, without the full model; empty if one of the bases has none
  std::vector<double> definite;  ///< 0 if modes are missing below that frequency
  bool known() const { return !full.empty(); }
  double worst() const;     ///< largest |error|
  double leastMac() const;  ///< 1 if nothing is known
};

/// Short curves for plots.
struct RowCurves {
  std::vector<double> errorTime, errorOverTime;  ///< [s], eps_t
  std::vector<double> bitTime, bitSpeed;         ///< [s], [rad/s]; thinned out
  std::vector<double> initial;  ///< lateral distance from the axis per node at the start [m]
  std::vector<double> growthTime,
      growth;  ///< [s], largest lateral distance of a node from its position in the reference [m]
  MotionStatistics statistics;  ///< without samples if the motion ends with the window
};

struct StudyRow {
  PlannedRun plan;
  std::string status = "pending";  ///< "done", "failed", "pending"
  std::string
      reason;  ///< of a failure; or why the frequencies of a finished run could not be compared
  std::string basis;  ///< "" for the full model
  long modes = 0;     ///< kept modal coordinates of all parts
  long dofs = 0;  ///< of the integrated model; 0 until it exists. A motion that fails keeps this
                  ///< and `modeErrors`
  ModeErrors modeErrors;  ///< of a reduced model, if the study compares frequencies
  std::string integrator;
  std::optional<double> stepOrTolerance;
  double simulated = 0.0;         ///< [s]
  std::vector<double> cpu, wall;  ///< of each repeat, transient only [s]; CPU is the sum of the
                                  ///< ranks
  double setupCpu = 0.0;          ///< reduction, coupling and the model in kernel form [s]
  double setupWall = 0.0;
  transient::Counters counters;
  std::optional<double> energyResidual;
  std::optional<PointwiseErrors> errors;     ///< none for the reference itself
  std::optional<double> estimatedVibration;  ///< of the vibration error, without the reference; if
                                             ///< Reduction/Error Estimate is set
  std::optional<StatisticsDifference> statistics;
  double maxPenetration = 0.0;
  long missedNodes = 0;       ///< nodes that passed the wall without contact in the model
  double givenUpAfter = 0.0;  ///< CPU time limit that ended the run [s]; 0: not ended by time
  std::string machine;        ///< on which it was timed
  std::optional<int> beside;  ///< rows that ran there at the same time; none: not known
  RowCurves curves;

  bool done() const { return status == "done"; }
  bool hasModel() const { return dofs > 0; }
  double bestCpu() const;  ///< shortest of the repeats, 0 without any
  double bestWall() const;
  double spread() const;  ///< (longest - shortest) / shortest of the CPU times
  double cpuPerSimulatedSecond() const { return simulated > 0.0 ? bestCpu() / simulated : 0.0; }
  double realTimeFactor() const { return bestWall() > 0.0 ? simulated / bestWall() : 0.0; }

  /// Writes all of it except the plan as JSON, and reads it back unchanged. FileError for a text
  /// that is not a row.
  std::string toJson() const;
  void fromJson(const std::string& text);
};

/// Ratios derived from all rows.
struct Ratios {
  std::optional<double> baseline;  ///< time of the baseline / time of this run
  std::optional<double>
      bestFull;  ///< time of the best full run at the same vibration error / time of this run
};

/// The ratios of every row; empty for rows that are not done or have no counterpart.
/// \param baseline  label of the run to divide by; empty: none
std::vector<Ratios> ratios(const std::vector<StudyRow>& rows, const std::string& baseline);

/// study.csv: one line per row.
std::string table(const std::vector<StudyRow>& rows, const std::vector<Ratios>& ratios);

/// Readable table: one short line per row under a heading.
std::string printedTable(const std::vector<StudyRow>& rows, const std::vector<Ratios>& ratios);

}  // namespace tooljoint::study
