// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// summary.json: the main numbers, for scripts and people. All documented keys are always
/// there, null where a stage did not run; docs/file-formats.md lists them.
#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace tooljoint::io {

/// Version of the layout of summary.json.
constexpr int summaryFormatVersion = 1;

/// One entry of an array of the summary ("reduction.substructures", "study"): keys in the order
/// they are set.
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
  /// All keys, null; program version, git hash and ranks filled in.
  Summary();
  ~Summary();
  Summary(const Summary&) = delete;
  Summary& operator=(const Summary&) = delete;

  /// Set one number or text; `path` is the keys joined by dots ("static.contact_nodes").
  /// Error(Internal) for a key that is not documented (so that the list of keys is stable) and for
  /// a number that is not finite.
  void set(const std::string& path, double value);
  void set(const std::string& path, long value);
  void set(const std::string& path, int value) { set(path, static_cast<long>(value)); }
  void set(const std::string& path, bool value);
  void set(const std::string& path, const std::string& value);
  void set(const std::string& path, const char* value) { set(path, std::string(value)); }
  void set(const std::string& path, const std::vector<std::string>& values);

  /// Add a row to an array. Its keys must be those documented for the array, missing ones become
  /// null.
  void append(const std::string& path, const SummaryRow& row);

  /// All documented keys in dotted form; array rows as "reduction.substructures[].name".
  static std::vector<std::string> keys();

  /// The file's text.
  std::string text() const;
  /// Write `path`.part, to be published later (OutputFolder). FileError when that fails.
  void stage(const std::string& path) const;
  /// Write `path` at once, never half.
  void write(const std::string& path) const;

 private:
  struct Data;
  std::unique_ptr<Data> data_;
};

/// What an existing summary.json says of its run: `status` ("" when there is no readable file) and
/// its `files`.
struct PreviousRun {
  std::string status;
  std::vector<std::string> files;
};
PreviousRun readPreviousRun(const std::string& path);

}  // namespace tooljoint::io
