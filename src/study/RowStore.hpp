// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Stored results of a study in its folder, so that a later one continues after an interruption.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "cases/run/KeptRows.hpp"
#include "study/Row.hpp"

namespace tooljoint::study {

/// Host name and processor; times of another machine are not comparable.
std::string machineName();

/// A motion of the nodes over time.
struct RecordedHistory {
  std::size_t nodes = 0;
  std::vector<double> time;          ///< [s]
  std::vector<double> displacement;  ///< samples x nodes x components [m]
  std::vector<double> bitSpeed;      ///< [rad/s]; empty without a bit
  std::size_t components = 3;        ///< number of components, all judged
  std::size_t vibrating = 2;         ///< number of leading components that are the vibration
  HistoryView view() const {
    return {time.data(), displacement.data(), time.size(), nodes,
            components,  components,          vibrating};
  }
};

/// Rows of a study or a map, and files FOLDER/cache/reference_KEY.h5.
class RowStore : public cases::KeptRows {
 public:
  using KeptRows::KeptRows;

  bool restore(const std::string& key, StudyRow& row) const;
  void keep(const std::string& key, const StudyRow& row) const;
  std::optional<RecordedHistory> restoreHistory(const std::string& key) const;
  void keepHistory(const std::string& key, const RecordedHistory& history) const;
};

}  // namespace tooljoint::study
