// SPDX-License-Identifier: BSD-3-Clause
#include "response/Columns.hpp"

#include "io/Csv.hpp"

namespace tooljoint::response {

void Columns::write(const std::string& name, io::OutputFolder& folder,
                    io::ResultsFile& file) const {
  const auto rows = columns.front().values.size();
  if (rows == 0) return;
  std::vector<io::Csv::Column> heads;
  for (const auto& one : columns) heads.push_back({one.name, one.unit});
  io::Csv table(heads);
  for (std::size_t i = 0; i < rows; ++i)
    table.row(collect(columns, [i](const Column& one) { return one.values[i]; }));
  table.stage(folder.file(name + ".csv"));
  writeGroup(name, file);
}

void Columns::writeGroup(const std::string& name, io::ResultsFile& file) const {
  for (const auto& one : columns)
    file.write("/" + name + "/" + one.name, one.values, {one.values.size()}, one.unit,
               one.longName);
}

}  // namespace tooljoint::response
