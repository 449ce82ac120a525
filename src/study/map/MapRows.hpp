// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The points of a map: read from its folder, computed, and stored there.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/RowStore.hpp"
#include "study/engine/StudyRunner.hpp"
#include "study/map/MapPlan.hpp"

namespace tooljoint::study {

/// Results of a point.
struct MapRow {
  std::string status = "pending";  ///< "done", "failed", "pending"
  std::string reason;              ///< of a failure
  std::vector<std::string> warnings;
  double cpu = 0.0, wall = 0.0;  ///< of the whole point, CPU summed over the ranks [s]
  double givenUpAfter = 0.0;     ///< CPU time limit that ended it [s]; 0: not ended by time
  std::map<std::string, double> numbers;  ///< of its summary; keys joined by dots

  /// The value of a numeric key of the summary; null if it is not a number, or unknown.
  std::optional<double> number(const std::string& key) const;

  std::string toJson() const;
  /// FileError for a text that is not a row.
  void fromJson(const std::string& text);
};

/// All calls are collective. Rank 0 has the rows; all ranks know which are complete.
class MapRows {
 public:
  /// Reads the stored points of the folder.
  MapRows(const MapPlan& plan, const std::string& folder);

  const std::vector<MapRow>& rows() const { return rows_; }
  bool isComplete(std::size_t i) const { return complete_[i] != 0; }
  std::size_t completed() const;

  /// Computes rest, reduction and motion of the point according to its deck. A failure is stored in
  /// its row.
  void compute(std::size_t i);

 private:
  void makeKeys();
  void find();
  void execute(const cases::Case& scene, MapRow& row);

  const MapPlan& plan_;
  std::optional<RowStore> store_;
  std::vector<MapRow> rows_;
  std::vector<int> complete_;
  std::vector<std::string> keys_;  ///< rank 0
  StudyRunner runner_;
};

}  // namespace tooljoint::study
