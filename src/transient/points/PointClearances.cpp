// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/PointClearances.hpp"

#include <utility>

namespace tooljoint::transient {

PointClearances::PointClearances(int points, ContactBroadPhase watch) : watch_(std::move(watch)) {
  for (auto* gap : {&gap_, &lastGap_, &check_}) gap->assign(at(points), 0.0);
}

void PointClearances::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {time_, lastTime_, static_cast<double>(seen_)});
  for (const auto* gap : {&gap_, &lastGap_}) memory.insert(memory.end(), gap->begin(), gap->end());
  watch_.save(memory);
}

void PointClearances::restore(const double*& memory) {
  time_ = *memory++;
  lastTime_ = *memory++;
  seen_ = static_cast<int>(*memory++);
  for (auto* gap : {&gap_, &lastGap_})
    for (double& value : *gap) value = *memory++;
  watch_.restore(memory);
}

}  // namespace tooljoint::transient
