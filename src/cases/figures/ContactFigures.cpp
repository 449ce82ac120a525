// SPDX-License-Identifier: BSD-3-Clause
#include "cases/figures/ContactFigures.hpp"

#include <algorithm>

namespace tooljoint::cases {

void ContactFigures::add(const Vector& forces) {
  sum_ += forces.cwiseMax(0.0);
  peak_ = peak_.cwiseMax(forces);
  touching_ += (forces.array() > 0.0).cast<double>().matrix();
  ++samples_;
}

Vector ContactFigures::overSamples(const Vector& sum) const {
  return sum / static_cast<double>(std::max(samples_, 1L));
}

void ContactFigures::save(std::vector<double>& memory) const {
  memory.push_back(static_cast<double>(samples_));
  for (const Vector* each : {&sum_, &peak_, &touching_}) saveVector(*each, memory);
}

void ContactFigures::restore(const double*& memory) {
  samples_ = static_cast<long>(*memory++);
  for (Vector* each : {&sum_, &peak_, &touching_}) restoreVector(*each, memory);
}

}  // namespace tooljoint::cases
