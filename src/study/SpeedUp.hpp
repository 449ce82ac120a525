// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// What the best of several methods costs at a given error.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tooljoint::study {

/// One run: the line (method) it belongs to, its error and its cost.
struct CostPoint {
  std::string line;
  double error = 0.0;
  double cost = 0.0;
};

/// The lowest cost at which any of the lines reaches `error`: that of a run at most as wrong, or,
/// where two neighbours of one line have errors on both sides, the straight line between them in
/// log(error), log(cost). Nothing when no run is as good as `error`.
std::optional<double> bestCostAt(double error, const std::vector<CostPoint>& points);

}  // namespace tooljoint::study
