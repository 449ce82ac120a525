// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Everything a run needs to continue as if it had never stopped: same steps, same factors, same
/// numbers.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/Types.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

/// A state of a run and the identity of the run. The file is a header (magic, layout, length and
/// SHA-256 of the body) and a body in the portable binary format of cereal; docs/file-formats.md
/// describes it.
struct Checkpoint {
  std::string run;              ///< inputs of the run, a line "PATH = VALUE" each; may be empty
  std::string program;          ///< version and commit of the program that wrote it
  std::string integrator;       ///< its name in the deck
  std::string model;            ///< digest of the model and the options (ModelIdentity)
  int ranks = 1;                ///< number of ranks of the run that wrote it
  std::vector<double> figures;  ///< of the model, comparable between numbers of ranks
  State state;                  ///< in dofs of the model
  Counters counters;
  long contactEvaluations = 0;
  long samples = 0;              ///< samples handed out so far
  int runawaySamples = 0;        ///< samples in a row with an energy balance that is wrong
  std::vector<double> memory;    ///< of the model, the integrator, the points and the ledger
  CarriedMemory carried;         ///< by the integrator; vectors in dofs of the model
  std::vector<int> shares;       ///< size of each rank's part of `memory`; empty if not divided
  std::vector<double> recorder;  ///< memory of the sample sink, set by the owner of the checkpoint
  std::map<std::string, std::uint64_t> rows;  ///< rows of each time series, set likewise

  /// The file as bytes.
  std::string encode() const;
  /// Verifies all bytes before any is used. `file` is the name used in error messages. Throws
  /// FileError.
  static Checkpoint decode(const std::string& bytes, const std::string& file);

  /// Write to / read from a file. Throw FileError; then the file is either complete or absent.
  void write(const std::string& file) const;
  static Checkpoint read(const std::string& file);
};

}  // namespace tooljoint::transient
