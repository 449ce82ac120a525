// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// How far an analysis of many points is.
#pragma once

#include <string>

#include "common/Error.hpp"
#include "common/Interrupt.hpp"
#include "common/Parallel.hpp"
#include "common/report/Progress.hpp"

namespace tooljoint::response {

/// A progress bar that ends all ranks when one of them is interrupted.
class SweepProgress {
 public:
  SweepProgress(const std::string& title, std::size_t points)
      : points_(points), progress_(title, static_cast<double>(points)) {}

  /// So many points are done. InterruptedError. Collective.
  void done(std::size_t points) {
    if (parallel::maximum(interruptRequested() ? 1.0 : 0.0) > 0.0)
      throw InterruptedError("Interrupted after " + std::to_string(points) + " of " +
                             std::to_string(points_) + " points. Run the command again.");
    progress_.update(static_cast<double>(points));
    if (points == points_) progress_.finish();
  }

 private:
  std::size_t points_;
  Progress progress_;
};

}  // namespace tooljoint::response
