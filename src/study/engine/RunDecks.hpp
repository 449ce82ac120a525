// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The decks of many runs of one case. Each is read and checked; faults are reported at the line of
/// the override.
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "common/report/Likewise.hpp"
#include "study/Expansion.hpp"

namespace tooljoint::study {

class RunDecks {
 public:
  /// The case must outlive the object.
  explicit RunDecks(const cases::Case& scene) : scene_(scene) {}

  /// The case with the overrides of the run after `common`, without the lists of commands that run
  /// many decks. Null for an invalid deck, whose fault is collected. ModelError with the name of
  /// the run.
  std::unique_ptr<cases::Case> read(const PlannedRun& run, const std::vector<std::string>& common);

  /// Collects a fault of the deck at `path`; equal ones once. Runs whose faults differ only in
  /// numbers are counted.
  void fault(const std::string& path, const std::string& sentence);
  /// DeckError with a line for each fault; returns if there is none.
  void raise() const;

 private:
  void relocate(const PlannedRun& run, const std::string& line);

  const cases::Case& scene_;
  LikewiseList faults_;
};

/// Index of the row `row` of `what` ("study", "map"), counted from 1 on the command line.
/// UsageError if it does not exist.
std::size_t rowNumber(const std::string& row, std::size_t rows, const std::string& what);

}  // namespace tooljoint::study
