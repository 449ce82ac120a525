// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What runs of strings and runs of imported parts share.
#pragma once

#include <chrono>
#include <string>

#include "app/Commands.hpp"
#include "transient/Transient.hpp"

namespace tooljoint::app {

using Clock = std::chrono::steady_clock;

/// Wall time [s].
double since(Clock::time_point start);

/// Largest resident memory so far, summed over the ranks [MB].
double peakMemory();

/// Folder of the command line, else of the run that goes on, else of the deck's list "Output" (may
/// be empty), else results/<deck>.
std::string resultsFolder(const RunOptions& options, const std::string& ofDeck);

/// Hands every sample to two sinks.
class Both : public transient::SampleSink {
 public:
  Both(transient::SampleSink& first, transient::SampleSink& second)
      : first_(first), second_(second) {}
  void sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) override;

 private:
  transient::SampleSink& first_;
  transient::SampleSink& second_;
};

}  // namespace tooljoint::app
