// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What writes the samples of a run and can go on where another one stopped.
#pragma once

#include <string>
#include <vector>

#include "io/Csv.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

/// Samples go into time series of the results file, which continue by themselves
/// (ResultsFile::continueFrom()); save() and restore() are about everything else: extremes, counts,
/// what is due next.
class Recorder : public transient::SampleSink {
 public:
  virtual void save(std::vector<double>& memory) const = 0;
  virtual void restore(const double*& memory) = 0;
};

/// motion.csv, whose rows also stand in /transient/motion of the results file, so that a restart
/// has them.
class MotionTable {
 public:
  MotionTable(io::ResultsFile& file, const std::vector<io::Csv::Column>& columns);
  void row(const std::vector<double>& values);
  void stage(io::OutputFolder& folder) const { table_.stage(folder.file("motion.csv")); }

 private:
  io::TimeSeries& series_;
  io::Csv table_;
};

}  // namespace tooljoint::app
