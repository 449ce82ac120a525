// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// summary.json: the main results, for scripts and people. All documented keys always exist, with
/// null if a stage did not run; docs/file-formats.md lists them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tooljoint::io {

/// Version of the layout of summary.json.
constexpr int summaryFormatVersion = 1;

/// One entry of an array of the summary ("reduction.substructures", "study"); its keys have the
/// order in which they are set.
class SummaryRow {
 public:
  SummaryRow();
  ~SummaryRow();
  SummaryRow(const SummaryRow& other);
  SummaryRow& operator=(const SummaryRow&) = delete;

  SummaryRow& set(const std::string& key, double value);
  SummaryRow& set(const std::string& key, long value);
  SummaryRow& set(const std::string& key, int value) { return set(key, static_cast<long>(value)); }
  SummaryRow& set(const std::string& key, bool value);
  SummaryRow& set(const std::string& key, const std::string& value);
  SummaryRow& set(const std::string& key, const char* value) {
    return set(key, std::string(value));
  }

 private:
  friend class Summary;
  struct Data;
  std::unique_ptr<Data> data_;
};

class Summary {
 public:
  /// All keys with null, except program version, git hash and ranks.
  Summary();
  ~Summary();
  Summary(const Summary&) = delete;
  Summary& operator=(const Summary&) = delete;

  /// Sets one number or text; `path` is the keys joined by dots ("static.contact_nodes").
  /// Error(Internal) for an undocumented key (so that the list of keys is stable) and for a number
  /// that is not finite.
  void set(const std::string& path, double value);
  void set(const std::string& path, long value);
  void set(const std::string& path, int value) { set(path, static_cast<long>(value)); }
  void set(const std::string& path, bool value);
  void set(const std::string& path, const std::string& value);
  void set(const std::string& path, const char* value) { set(path, std::string(value)); }
  void set(const std::string& path, const std::vector<std::string>& values);

  /// Adds a row to an array. Its keys must be those documented for the array; missing ones become
  /// null.
  void append(const std::string& path, const SummaryRow& row);

  /// All documented keys in dotted form; array rows as "reduction.substructures[].name".
  static std::vector<std::string> keys();

  /// The text of the file.
  std::string text() const;
  /// Writes `path`.part, to be published later (OutputFolder). FileError when that fails.
  void stage(const std::string& path) const;
  /// Writes `path` directly; a partial file never appears.
  void write(const std::string& path) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// Content of an existing summary.json: `status` of its run ("" if there is no readable file) and
/// its `files`.
struct PreviousRun {
  std::string status;
  std::vector<std::string> files;
};
PreviousRun readPreviousRun(const std::string& path);

}  // namespace tooljoint::io
