// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A map: runs of one case over a grid of its parameters. In one process, in groups of ranks that
/// take points as they become free, or as a plan of one command per point for a scheduler.
#pragma once

#include <string>

#include "cases/Case.hpp"

namespace tooljoint::study {

struct MapOptions {
  std::string output;   ///< folder; empty: next to that of a run of the deck
  bool fresh = false;   ///< remove the points of an earlier map from the folder
  int ranksPerRow = 0;  ///< ranks that compute a point together; 0: all
};

/// Computes the list Map of the deck into a folder: map.csv, map.h5, summary.json and pictures.
/// Stored points are not computed again; points that fail are missing cells. DeckError, FileError,
/// InterruptedError; UsageError when the number of ranks is not a multiple of the group size.
/// Collective.
void runMap(const cases::Case& one, const MapOptions& options);

/// Writes FOLDER/rows.txt, one command per line for every point; the commands are independent.
/// `program` is the file that runs them. Collective.
void planMapRows(const cases::Case& one, const std::string& folder, const std::string& program,
                 const MapOptions& options);

/// One point of the map, by its number from 1, into options.output. Collective.
void computeMapRow(const cases::Case& one, const std::string& row, const MapOptions& options);

/// Table and pictures of the points in options.output; missing ones are named. Collective.
void collectMap(const cases::Case& one, const MapOptions& options);

}  // namespace tooljoint::study
