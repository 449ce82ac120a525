// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// CPU and wall time since a moment.
#pragma once

#include <chrono>

namespace tooljoint {

/// Runs from its construction on.
class Stopwatch {
 public:
  /// CPU time of all threads of this process [s].
  double cpu() const { return processSeconds() - cpu_; }
  /// Wall time [s].
  double wall() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - wall_).count();
  }

 private:
  static double processSeconds();
  double cpu_ = processSeconds();
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
};

}  // namespace tooljoint
