// SPDX-License-Identifier: BSD-3-Clause
#include "transient/points/ActivePoints.hpp"

#include <utility>

namespace tooljoint::transient {

ActivePoints::ActivePoints(int points, std::vector<int> all)
    : all_(std::move(all)), isActive_(at(points), 0), hasActed_(at(points), 0) {
  active_.reserve(at(points));
  acted_.reserve(at(points));
}

void ActivePoints::update() {
  active_.clear();
  for (int p : all_)
    if (isMarked(p)) active_.push_back(p), hasActed_[at(p)] = 1;
}

const std::vector<int>& ActivePoints::acted() {
  acted_.clear();
  for (int p : all_)
    if (hasActed_[at(p)]) acted_.push_back(p);
  return acted_;
}

void ActivePoints::save(std::vector<double>& memory) const {
  for (const auto* flags : {&isActive_, &hasActed_})
    memory.insert(memory.end(), flags->begin(), flags->end());
}

void ActivePoints::restore(const double*& memory) {
  for (char& on : isActive_) on = *memory++ != 0.0 ? 1 : 0;
  update();
  for (char& on : hasActed_) on = *memory++ != 0.0 ? 1 : 0;
}

}  // namespace tooljoint::transient
