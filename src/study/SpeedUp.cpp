// SPDX-License-Identifier: BSD-3-Clause
#include "study/SpeedUp.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace tooljoint::study {

std::optional<double> bestCostAt(double error, const std::vector<CostPoint>& points) {
  std::optional<double> best;
  const auto offer = [&](double cost) { best = best ? std::min(*best, cost) : cost; };
  std::map<std::string, std::vector<CostPoint>> lines;
  for (const auto& point : points) {
    if (point.error <= error) offer(point.cost);
    if (point.error > 0.0 && point.cost > 0.0) lines[point.line].push_back(point);
  }
  for (auto& [name, line] : lines) {
    std::sort(line.begin(), line.end(),
              [](const CostPoint& a, const CostPoint& b) { return a.error < b.error; });
    for (std::size_t i = 1; i < line.size(); ++i) {
      const auto& a = line[i - 1];
      const auto& b = line[i];
      if (!(a.error < error && error < b.error)) continue;
      const double x = std::log(error / a.error) / std::log(b.error / a.error);
      offer(a.cost * std::pow(b.cost / a.cost, x));
    }
  }
  return best;
}

}  // namespace tooljoint::study
