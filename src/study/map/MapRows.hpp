// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The points of a map: found again in its folder, computed, and kept there.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "study/RowStore.hpp"
#include "study/engine/StudyRunner.hpp"
#include "study/map/MapPlan.hpp"

namespace tooljoint::study {

/// What is known of a point.
struct MapRow {
  std::string status = "pending";  ///< "done", "failed", "pending"
  std::string reason;              ///< of a failure
  std::vector<std::string> warnings;
  double cpu = 0.0, wall = 0.0;  ///< of the whole point, CPU summed over the ranks [s]
  double givenUpAfter = 0.0;     ///< CPU time limit that ended it [s]; 0: it was not the time
  std::map<std::string, double> numbers;  ///< of its summary, by keys joined by dots

  /// The number of a key of the summary; null where it is none, or nothing is known.
  std::optional<double> number(const std::string& key) const;

  std::string toJson() const;
  /// FileError for a text that is none.
  void fromJson(const std::string& text);
};

/// All calls are collective. Rows are known on rank 0, what is complete on all ranks.
class MapRows {
 public:
  /// Finds what the folder knows.
  MapRows(const MapPlan& plan, const std::string& folder);

  const std::vector<MapRow>& rows() const { return rows_; }
  bool isComplete(std::size_t i) const { return complete_[i] != 0; }
  std::size_t completed() const;

  /// Brings the point to rest, reduces and moves it as its deck says. What fails of it is its row.
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
