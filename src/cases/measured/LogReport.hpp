// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Output of a run for the comparison with a measured log.
#pragma once

#include <string>
#include <vector>

#include "cases/measured/MeasuredLog.hpp"
#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"

namespace tooljoint::cases {

/// A measured log and its comparisons, one for each column.
struct ComparedLog {
  const MeasuredLog& log;
  const std::vector<SignalComparison>& columns;
};

/// Lines of the log.
std::string describe(const ComparedLog& compared);
/// Keys below `measured`.
void summarise(const ComparedLog& compared, io::Summary& summary);
/// Groups /measured/NAME.
void write(const ComparedLog& compared, io::ResultsFile& file);
/// measured.csv, measured_peaks.csv.
void stageTables(const ComparedLog& compared, io::OutputFolder& folder);

}  // namespace tooljoint::cases
