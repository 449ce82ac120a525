// SPDX-License-Identifier: BSD-3-Clause
#include "app/Recorder.hpp"

#include <algorithm>

#include "common/Text.hpp"

namespace tooljoint::app {

namespace {

constexpr const char* motionSeries = "/transient/motion";

io::TimeSeries& seriesOf(io::ResultsFile& file, const std::vector<io::Csv::Column>& columns) {
  std::vector<std::string> names, units;
  for (const auto& column : columns) {
    names.push_back(column.name);
    if (std::find(units.begin(), units.end(), column.unit) == units.end())
      units.push_back(column.unit);
  }
  return file.series(motionSeries, {columns.size()}, join(units, ", "),
                     "Rows of motion.csv: " + join(names, ", "));
}

}  // namespace

MotionTable::MotionTable(io::ResultsFile& file, const std::vector<io::Csv::Column>& columns)
    : series_(seriesOf(file, columns)), table_(columns) {
  const auto carried = file.carried(motionSeries);
  for (auto row = carried.begin(); row != carried.end();
       row += static_cast<std::ptrdiff_t>(columns.size()))
    table_.row(std::vector<double>(row, row + static_cast<std::ptrdiff_t>(columns.size())));
}

void MotionTable::row(const std::vector<double>& values) {
  table_.row(values);
  series_.append(values.data());
}

}  // namespace tooljoint::app
