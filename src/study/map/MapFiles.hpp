// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Files of a map in its folder: map.csv, map.h5, summary.json and pictures. docs/file-formats.md
/// describes all of it.
#pragma once

#include <string>
#include <vector>

#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "study/map/MapPlan.hpp"
#include "study/map/MapRows.hpp"

namespace tooljoint::study {

/// Extremes of one value over the points that have the value.
struct MapRange {
  std::size_t known = 0;
  std::size_t unsafe = 0;  ///< points beyond a limit
  double least = 0.0, largest = 0.0;
  std::size_t leastPoint = 0, largestPoint = 0;
};
MapRange rangeOf(const MapValue& value, const std::vector<MapRow>& rows);

void stageMapTable(const MapPlan& plan, const std::vector<MapRow>& rows, io::OutputFolder& folder);
void writeMap(const MapPlan& plan, const std::vector<MapRow>& rows, io::ResultsFile& file);
void summarise(const MapPlan& plan, const std::vector<MapRow>& rows, io::Summary& summary);

/// Lines of the log: the range of every value, and the time per point.
std::string describe(const MapPlan& plan, const std::vector<MapRow>& rows);
/// Failed points with the reason, and missing points; one sentence for those that differ only in
/// numbers.
std::vector<std::string> missingPoints(const MapPlan& plan, const std::vector<MapRow>& rows);

/// A sentence on the points whose bit motion has not settled; "" if all have.
std::string unsettledPoints(const MapPlan& plan, const std::vector<MapRow>& rows);

/// Draws the maps of a folder with the installed script. If that fails, warns with the command to
/// draw them later. Rank 0 only.
void drawMap(const std::string& folder);

}  // namespace tooljoint::study
