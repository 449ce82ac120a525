// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables for spreadsheets: a header `name [unit]`, then one line per row, numbers that read back
/// as the same doubles.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"

namespace tooljoint::io {

class Csv {
 public:
  struct Column {
    std::string name;
    std::string unit;  ///< SI unit; "" or "1" for a pure number or a text, whose header has only
                       ///< the name
  };

  explicit Csv(std::vector<Column> columns);

  /// Adds a row, one number per column. Error(Internal) for a wrong count or a number that is not
  /// finite.
  void row(const std::vector<double>& values);
  /// Adds a row of texts; a text with a comma, a quote or a line end is quoted.
  void row(const std::vector<std::string>& values);

  /// The table so far.
  const std::string& text() const { return text_; }
  /// Writes `path`.part, to be published later (OutputFolder). FileError when that fails.
  void stage(const std::string& path) const;
  /// Writes `path` directly; a partial file never appears.
  void write(const std::string& path) const;
  /// Makes the folder if it is missing and writes the file in it, on rank 0. Collective; FileError
  /// on all ranks when that fails.
  void writeInto(const std::string& folder, const std::string& name) const;

 private:
  std::vector<Column> columns_;
  std::string text_;
};

}  // namespace tooljoint::io
