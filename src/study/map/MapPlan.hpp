// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A map before it runs: every point of the grid with its deck, read and checked.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "study/Expansion.hpp"
#include "study/map/MapParameters.hpp"

namespace tooljoint::study {

struct MapPoint {
  PlannedRun plan;
  std::unique_ptr<cases::Case> scene;  ///< null if only another row runs, or with a fault
  std::string fault;                   ///< why its model cannot be built; "" if it can
};

struct MapPlan {
  MapSettings settings;
  std::vector<MapPoint> points;  ///< the last axis varies first
};

/// Reads the deck once for every point. DeckError that points into the Map list: no such list, a
/// path or a value that does not fit the deck, a key of a motion that the deck does not have.
/// \param row  number of the only point to read, from 1; "" for all. UsageError if it does not
/// exist.
MapPlan planMap(const cases::Case& scene, const std::string& row = "");

/// "12 points: speed (4) x weight (3); ...": a readable summary.
std::string describe(const MapPlan& plan);

}  // namespace tooljoint::study
