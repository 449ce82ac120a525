// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Cost of the best of several methods at a given error.
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

/// The lowest cost at which any of the lines reaches `error`: that of a run with at most this
/// error, or, between two neighbours of one line with errors on both sides, by linear interpolation
/// in log(error), log(cost). None if no run reaches `error`.
std::optional<double> bestCostAt(double error, const std::vector<CostPoint>& points);

}  // namespace tooljoint::study
