// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What a study has done so far, kept in its folder so that a later one goes on where it stopped.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "study/Row.hpp"

namespace tooljoint::study {

/// The program that computes: version and commit, and for a build from changed sources also its
/// files with their sizes and times.
std::string programStamp();

/// Host name and processor: times of another machine are not ours.
std::string machineName();

/// A motion of the nodes over time.
struct RecordedHistory {
  std::size_t nodes = 0;
  std::vector<double> time;          ///< [s]
  std::vector<double> displacement;  ///< samples x nodes x components [m]
  std::vector<double> bitSpeed;      ///< [rad/s]; empty without a bit
  std::size_t components = 3;        ///< all of them are judged
  std::size_t vibrating = 2;         ///< how many of them, from the first on, are the vibration
  HistoryView view() const {
    return {time.data(), displacement.data(), time.size(), nodes,
            components,  components,          vibrating};
  }
};

/// Files FOLDER/cache/row_KEY.json and reference_KEY.h5. Rank 0 does all the work; other ranks find
/// nothing and keep nothing. Files that cannot be read count as absent.
class RowStore {
 public:
  /// Makes FOLDER/cache. FileError when that fails.
  explicit RowStore(const std::string& folder);

  /// Forget everything.
  void clear() const;

  /// A row as the text it was kept as.
  std::optional<std::string> restoreText(const std::string& key) const;
  void keepText(const std::string& key, const std::string& text) const;
  bool restore(const std::string& key, StudyRow& row) const;
  void keep(const std::string& key, const StudyRow& row) const;
  std::optional<RecordedHistory> restoreHistory(const std::string& key) const;
  void keepHistory(const std::string& key, const RecordedHistory& history) const;

 private:
  std::string rowFile(const std::string& key) const {
    return folder_ + "/row_" + key.substr(0, 24) + ".json";
  }
  std::string historyFile(const std::string& key) const {
    return folder_ + "/reference_" + key.substr(0, 24) + ".h5";
  }
  std::string folder_;
  bool active_ = false;
};

}  // namespace tooljoint::study
