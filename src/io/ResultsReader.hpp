// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Reads results.h5: for restart, studies and tests.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace tooljoint::io {

/// An open results file, finished or .part. Every method throws FileError with file and dataset if
/// an object does not exist or has another type.
class ResultsReader {
 public:
  explicit ResultsReader(const std::string& path);
  ~ResultsReader();
  ResultsReader(const ResultsReader&) = delete;
  ResultsReader& operator=(const ResultsReader&) = delete;

  bool has(const std::string& path) const;
  /// Paths of all datasets, in alphabetical order.
  std::vector<std::string> datasets() const;
  enum class Kind { Real, Integer, Text };
  Kind kind(const std::string& path) const;
  /// Extents; empty for a scalar.
  std::vector<std::size_t> shape(const std::string& path) const;
  /// All values, row-major.
  std::vector<double> numbers(const std::string& path) const;
  /// `count` rows (first index) starting at row `first`.
  std::vector<double> rows(const std::string& path, std::size_t first, std::size_t count) const;
  std::vector<int> integers(const std::string& path) const;
  std::vector<std::string> texts(const std::string& path) const;
  std::string unit(const std::string& path) const { return textAttribute(path, "units"); }
  std::string longName(const std::string& path) const { return textAttribute(path, "long_name"); }
  /// Attribute of a group or dataset ("/" for the file).
  bool hasAttribute(const std::string& object, const std::string& name) const;
  std::string textAttribute(const std::string& object, const std::string& name) const;

 private:
  /// Number of values of an open dataset. FileError if they are in other files, or exceed what the
  /// stored bytes can contain; nothing is allocated for announced sizes alone.
  std::size_t count(const std::string& path, std::int64_t dataset) const;
  [[noreturn]] void fail(const std::string& what) const;
  std::string path_;
  std::int64_t file_ = -1;
};

}  // namespace tooljoint::io
