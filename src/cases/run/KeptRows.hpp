// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stored results of an analysis with many rows. They are kept in its folder, so that the same
/// command continues after an interruption.
#pragma once

#include <optional>
#include <string>

namespace tooljoint::cases {

/// Identification of the program: version and commit, and for a build from changed sources also its
/// files with their sizes and times.
std::string programStamp();

/// Files FOLDER/cache/KIND_KEY.json, one per row; the key covers all data that determine the row.
/// Rank 0 does all the work; other ranks find and store nothing. Unreadable files count as absent.
class KeptRows {
 public:
  /// Makes FOLDER/cache. FileError when that fails.
  explicit KeptRows(const std::string& folder, std::string kind = "row");

  /// Removes all rows of this kind, and reference runs.
  void clear() const;
  /// Number of stored rows of this kind, with any key.
  int count() const;

  /// A row as its stored text.
  std::optional<std::string> restoreText(const std::string& key) const;
  void keepText(const std::string& key, const std::string& text) const;

 protected:
  bool active() const { return active_; }
  /// FOLDER/cache/KIND_KEY.ENDING
  std::string file(const std::string& kind, const std::string& key,
                   const std::string& ending) const {
    return folder_ + "/" + kind + "_" + key.substr(0, 24) + ending;
  }

 private:
  std::string folder_, kind_;
  bool active_ = false;
};

}  // namespace tooljoint::cases
