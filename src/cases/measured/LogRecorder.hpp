// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Computed signals for the comparison with a measured log, and its result.
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
  /// Opens a series /measured/NAME/computed for each column; a continued run includes the earlier
  /// samples. All arguments must outlive the object. DeckError: an unknown node or component, or a
  /// quantity that the record does not have. Collective.
  LogRecorder(const MeasuredLog& log, const RestingCase& rest, const model::SecondOrderModel& model,
              const MotionRecord& record, io::ResultsFile& file);

  /// Adds a sample; the record has been updated with it.
  void sample(const Sample& sample);

  /// One for each column.
  std::vector<SignalComparison> compare() const;

 private:
  /// Source of the values of a column: a number of the record, or a row of the recovery.
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
