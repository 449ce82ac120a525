// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/Rainflow.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::cases {

void Rainflow::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {started_ ? 1.0 : 0.0, last_, static_cast<double>(direction_),
                               static_cast<double>(reversals_.size())});
  memory.insert(memory.end(), reversals_.begin(), reversals_.end());
}

void Rainflow::restore(const double*& memory) {
  started_ = *memory++ != 0.0;
  last_ = *memory++;
  direction_ = static_cast<int>(*memory++);
  const auto count = static_cast<std::size_t>(*memory++);
  reversals_.assign(memory, memory + count);
  memory += count;
}

void CycleTotals::add(const LoadCycle& cycle, double exponent) {
  cycles += cycle.count;
  largestRange = std::max(largestRange, cycle.range);
  if (exponent > 0.0) damage += cycle.count * std::pow(cycle.range, exponent);
}

}  // namespace tooljoint::cases
