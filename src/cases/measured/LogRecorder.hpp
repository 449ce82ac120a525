// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The computed signals that a measured log is compared with, and what comes of it.
#pragma once

#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "cases/measured/MeasuredLog.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::cases {

class LogRecorder {
 public:
  /// Opens a series /measured/NAME/computed for each column; a run that goes on has the samples
  /// before it. All arguments must outlive the object. DeckError: a node or a component that is not
  /// there, a quantity that the record does not have. Collective.
  LogRecorder(const MeasuredLog& log, const RestingCase& rest, const model::SecondOrderModel& model,
              const MotionRecord& record, io::ResultsFile& file);

  /// A sample to which the record has been brought.
  void sample(const Sample& sample);

  /// One for each column.
  std::vector<SignalComparison> compare() const;

 private:
  /// Where the values of a column are: a number of the record, or a row of the recovery.
  struct Source {
    const double* value = nullptr;
    Eigen::Index row = 0;
    int rates = 0;
    io::TimeSeries* series = nullptr;
  };

  const MeasuredLog& log_;
  std::vector<double> time_;
  std::vector<Source> sources_;
  std::vector<std::vector<double>> values_;
};

}  // namespace tooljoint::cases
