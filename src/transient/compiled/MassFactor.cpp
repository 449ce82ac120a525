// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/MassFactor.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {

MassFactor::MassFactor(const CompiledModel& model)
    : pattern_(model.pattern()), factor_(pattern_), missing_(at(model.size()), 0) {
  Vector diagonal(model.size());
  model.combine(1.0, 0.0, 0.0, factor_.values());
  model.diagonal(1.0, 0.0, 0.0, diagonal.data());
  perUnit_.setOnes(model.size());
  for (int i = 0; i < model.size(); ++i)
    if (diagonal[i] == 0.0) {
      factor_.values()[pattern_.address(i, i)] = 1.0;
      missing_[at(i)] = 1;
    } else {
      perUnit_[i] = 1.0 / diagonal[i];
    }
  singularAt_ = factor_.factor();
}

void MassFactor::solve(Vector& a) const {
  for (int i = 0; i < a.size(); ++i)
    if (missing_[at(i)]) a[i] = 0.0;
  factor_.solve(a.data());
}

void MassFactor::solveNear(Vector& a, std::vector<int>& blocks, double negligible) const {
  double largest = 0;
  for (int b : blocks)
    for (int i = pattern_.start(b); i < pattern_.start(b + 1); ++i) {
      if (missing_[at(i)]) a[i] = 0.0;
      largest = std::max(largest, std::abs(perUnit_[i] * a[i]));
    }
  factor_.solveNear(a.data(), blocks, perUnit_.data(), negligible * largest);
}

}  // namespace tooljoint::transient
