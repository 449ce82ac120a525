// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Bending moments and distances to the wall of a harmonic response: log, tables, summary.
#pragma once

#include "io/OutputFolder.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "response/Columns.hpp"
#include "response/Response.hpp"

namespace tooljoint::response {

/// All calls do nothing if the response has no nodes or elements of a string.
class StringReport {
 public:
  /// \param response  outlives the object
  StringReport(const HarmonicResponse& response, bool bySpeed, bool estimated)
      : response_(response), bySpeed_(bySpeed), estimated_(estimated) {}

  /// Prints the largest moment and the deviation of the spot checks; warns if a node would reach
  /// the wall.
  void print() const;
  /// Adds contact_* and bending_* of response.csv.
  void addColumns(Columns& table) const;
  /// bending.csv, margins.csv, spot_checks_string.csv and their groups.
  void write(io::OutputFolder& folder, io::ResultsFile& file) const;
  /// Keys below response.
  void summarise(io::Summary& summary) const;

 private:
  const ResponsePoint* firstTouch() const;
  /// The point with the largest moment; null without elements, or without bending.
  const ResponsePoint* mostBent() const;
  Columns bendingTable() const;
  Columns marginTable() const;
  Columns checkTable() const;
  void writeProfiles(io::ResultsFile& file) const;

  const HarmonicResponse& response_;
  bool bySpeed_, estimated_;
};

}  // namespace tooljoint::response
