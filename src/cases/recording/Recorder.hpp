// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Recovers the samples of a motion and writes them: the quantities common to all cases, and the
/// channels of the MotionRecord of the case.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "cases/measured/LogRecorder.hpp"
#include "cases/recording/SampleRecovery.hpp"
#include "io/OutputFolder.hpp"
#include "io/OutputParameters.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::cases {

/// The span of a motion [s].
struct TimeSpan {
  double start = 0.0;
  double end = 0.0;
};

/// Choice of the recorded quantities.
struct Recorded {
  const io::OutputSettings& output;
  std::vector<std::int64_t> nodes;  ///< increasing; empty: all
};

/// Samples go into time series of the results file, which continue by themselves
/// (ResultsFile::continueFrom()). save() and restore() handle everything else: extremes, counts,
/// next output times.
class Recorder : public transient::ShareSink {
 public:
  /// Opens the series of /transient named in the list Output. `model` and `file` must outlive the
  /// recorder.
  Recorder(std::unique_ptr<MotionRecord> record, const model::SecondOrderModel& model,
           const Recorded& wanted, TimeSpan span, io::ResultsFile& file);

  /// Records the quantities for the comparison with a measured log. The log and `rest` must outlive
  /// the recorder. Call before the first sample. Collective; errors are those of LogRecorder.
  void compareWith(const MeasuredLog& log, const RestingCase& rest);
  /// One per column of the log; empty without a log.
  std::vector<SignalComparison> comparisons() const;

  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override;
  void states(const Vector& x) override { recovery_.states(x); }
  /// In a divided motion only rank 0 needs the samples, unless the motion is compared with a
  /// measured log.
  bool gathers() const override { return !measured_; }
  void sampleShare(const transient::SampleShare& mine) override;
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

  const MotionRecord& record() const { return *record_; }
  /// motion.csv. Its rows are also in /transient/motion, so that a restart has them.
  void stageTable(io::OutputFolder& folder) const { table_.stage(folder.file("motion.csv")); }
  /// results.xdmf beside results.h5; nothing without pictures.
  void stagePictures(io::OutputFolder& folder) const;

 private:
  struct Series {
    io::TimeSeries* series;
    const double* values;
    bool ofNodes;  ///< one value for each node
  };
  void choose(const std::vector<std::int64_t>& nodes);
  void addTable();
  void take(const Sample& sample);
  /// Appends the values of the chosen nodes, of `width` each.
  void append(io::TimeSeries& series, const double* values, std::size_t width);
  io::XdmfFrame frame(const Sample& sample) const;

  std::unique_ptr<MotionRecord> record_;
  const model::SecondOrderModel& model_;
  io::ResultsFile& file_;
  SampleRecovery recovery_;
  io::TimeSeries& time_;
  io::TimeSeries* displacementSeries_ = nullptr;
  io::TimeSeries* velocitySeries_ = nullptr;
  io::TimeSeries* accelerationSeries_ = nullptr;
  std::vector<Series> channels_;
  std::vector<std::size_t> rows_;  ///< of the chosen nodes; empty: all
  std::vector<double> chosen_;     ///< their values
  std::unique_ptr<LogRecorder> measured_;
  std::unique_ptr<io::XdmfRecorder> pictures_;
  io::Csv table_;
  io::TimeSeries* tableSeries_ = nullptr;
  double flushInterval_;  ///< [s]
  double nextFlush_;      ///< [s]
};

}  // namespace tooljoint::cases
