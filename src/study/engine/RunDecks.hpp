// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The decks of many runs of one case: each read and checked, with faults given where the override
/// stands.
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

  /// The case with the overrides of the run behind `common`, without the lists of commands that run
  /// many decks; null when that is no valid deck, which is kept as a fault. ModelError, naming the
  /// run.
  std::unique_ptr<cases::Case> read(const PlannedRun& run, const std::vector<std::string>& common);

  /// Keeps a fault of the deck at `path`; the same one once, and runs whose fault differs in
  /// numbers alone are counted.
  void fault(const std::string& path, const std::string& sentence);
  /// DeckError with a line for each fault; returns when there is none.
  void raise() const;

 private:
  void relocate(const PlannedRun& run, const std::string& line);

  const cases::Case& scene_;
  LikewiseList faults_;
};

/// Position of the row `row` of `what` ("study", "map"), counted from 1 on the command line.
/// UsageError when there is none.
std::size_t rowNumber(const std::string& row, std::size_t rows, const std::string& what);

}  // namespace tooljoint::study
