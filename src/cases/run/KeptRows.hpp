// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What an analysis of many rows has computed so far, kept in its folder so that the same command
/// goes on where it stopped.
#pragma once

#include <optional>
#include <string>

namespace tooljoint::cases {

/// The program that computes: version and commit, and for a build from changed sources also its
/// files with their sizes and times.
std::string programStamp();

/// Files FOLDER/cache/KIND_KEY.json, one a row, each under the key of all that decides it. Rank 0
/// does all the work; other ranks find nothing and keep nothing. Files that cannot be read count as
/// absent.
class KeptRows {
 public:
  /// Makes FOLDER/cache. FileError when that fails.
  explicit KeptRows(const std::string& folder, std::string kind = "row");

  /// Forget all of this kind, and reference runs.
  void clear() const;
  /// Rows of this kind that are there, under whatever key.
  int count() const;

  /// A row as the text it was kept as.
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
