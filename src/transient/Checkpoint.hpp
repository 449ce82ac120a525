// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Everything a run needs to go on as if it had never stopped: same steps, same factors, same numbers.
#pragma once

#include <string>
#include <vector>

#include "common/Types.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

struct Checkpoint {
  std::string integrator;
  double fingerprint = 0;  ///< of the model: a checkpoint goes on only with the model it came from
  State state;             ///< in positions of the compiled model
  Counters counters;
  long contactEvaluations = 0;
  long samples = 0;            ///< samples handed out so far
  std::vector<double> memory;  ///< of the integrator, the point batches and the ledger

  /// Write to / read from a file (numbers in the byte order of this machine). Throw FileError; the file is complete or not there.
  void write(const std::string& file) const;
  static Checkpoint read(const std::string& file);
};

/// A number that differs for different models: a weighted sum over their entries.
double fingerprint(const CompiledModel& model);

}  // namespace tooljoint::transient
