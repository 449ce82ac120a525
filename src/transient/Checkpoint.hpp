// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Everything a run needs to go on as if it had never stopped: same steps, same factors, same
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
  std::string run;      ///< what the run computes, a line "PATH = VALUE" per input; empty when the
                        ///< caller says nothing
  std::string program;  ///< version and commit of the program that wrote it
  std::string integrator;       ///< its name in the deck
  std::string model;            ///< digest of the model and the options (ModelIdentity)
  int ranks = 1;                ///< of the run that wrote it
  std::vector<double> figures;  ///< of the model, as other ranks find it
  State state;                  ///< in dofs of the model
  Counters counters;
  long contactEvaluations = 0;
  long samples = 0;            ///< samples handed out so far
  int runawaySamples = 0;      ///< samples in a row with an energy balance that is wrong
  std::vector<double> memory;  ///< of the model, the integrator, the point batches and the ledger
  CarriedMemory carried;       ///< of the integrator, vectors in dofs of the model
  std::vector<int> shares;  ///< of a divided motion: numbers of each rank in `memory`; else empty
  std::vector<double>
      recorder;  ///< of the sink of the samples, set by whoever keeps the checkpoint
  std::map<std::string, std::uint64_t> rows;  ///< rows of each time series of the results, likewise

  /// The file as bytes.
  std::string encode() const;
  /// Verifies all bytes before it uses one. `file` is what errors call them. Throws FileError.
  static Checkpoint decode(const std::string& bytes, const std::string& file);

  /// Write to / read from a file. Throw FileError; the file is complete, on the disk, or not there.
  void write(const std::string& file) const;
  static Checkpoint read(const std::string& file);
};

}  // namespace tooljoint::transient
