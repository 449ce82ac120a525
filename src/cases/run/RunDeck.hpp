// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Runs a deck in this process, as `tooljoint run` does, and returns its results.
#pragma once

#include <map>
#include <mpi.h>
#include <string>
#include <vector>

#include "cases/run/RunFiles.hpp"
#include "io/ResultsReader.hpp"

namespace tooljoint {

/// Results of a run; the same on all ranks.
class Results {
 public:
  /// Reads the summary in the folder of a run. Collective. FileError.
  explicit Results(std::string folder);

  const std::string& folder() const { return folder_; }
  /// Names of the files in the folder: results.h5, summary.json, tables.
  std::vector<std::string> files() const { return list("files"); }
  std::vector<std::string> warnings() const { return list("warnings"); }
  /// "finished", or "interrupted" or "failed" for the folder of a run that threw.
  std::string status() const { return text("status"); }

  /// A value of summary.json by its keys joined by dots, rows of arrays counted from 0:
  /// "static.top_axial_force", "reduction.substructures.0.modes". docs/file-formats.md lists them.
  /// UsageError for a key that does not exist, is null (its stage did not run) or has another type.
  double number(const std::string& key) const;
  std::string text(const std::string& key) const;
  bool flag(const std::string& key) const;
  /// True if the summary has the key and its value is not null.
  bool has(const std::string& key) const;

  /// results.h5: /transient/time, /transient/displacement (samples x nodes x components) and all
  /// other recorded data. Any rank may read. FileError.
  io::ResultsReader histories() const;

 private:
  const std::string& find(const std::string& key) const;
  std::vector<std::string> list(const std::string& key) const;

  std::string folder_;
  std::map<std::string, std::string> values_;  ///< JSON text of each value
};

/// Runs a deck of any kind of case, full or reduced. `overrides` as for `--set`, "PATH=VALUE", and
/// "!PATH" to remove a list. The kinds of cases are those registered by the linked libraries
/// (CaseKinds.hpp). Log lines go to standard output (log::setQuiet()).
///
/// Collective over `comm`. Call it after MPI and Kokkos have been initialised
/// (`Tpetra::ScopeGuard scope(&argc, &argv);` in main). Errors are exceptions with the sentence
/// that the program prints and its exit code, the same on all ranks: DeckError, ModelError,
/// ConvergenceError, FileError, InterruptedError (common/Error.hpp).
Results runDeck(const std::string& file, const std::vector<std::string>& overrides = {},
                MPI_Comm comm = MPI_COMM_WORLD, const cases::RunOptions& options = {});

}  // namespace tooljoint
