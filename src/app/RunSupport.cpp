// SPDX-License-Identifier: BSD-3-Clause
#include "app/RunSupport.hpp"

#include <filesystem>
#include <sys/resource.h>

#include "common/Parallel.hpp"

namespace tooljoint::app {

double since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

double peakMemory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return parallel::sum(static_cast<double>(usage.ru_maxrss) / 1024.0);
}

std::string resultsFolder(const RunOptions& options, const std::string& ofDeck) {
  if (!options.output.empty()) return options.output;
  if (!options.restart.empty()) return options.restart;
  if (!ofDeck.empty()) return ofDeck;
  return (std::filesystem::path("results") / std::filesystem::path(options.deck).stem()).string();
}

void Both::sample(double t, const Vector& q, const Vector& qDot, const Vector& qDDot) {
  first_.sample(t, q, qDot, qDDot);
  second_.sample(t, q, qDot, qDDot);
}

}  // namespace tooljoint::app
