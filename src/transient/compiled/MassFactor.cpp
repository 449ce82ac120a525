// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/MassFactor.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"
#include "model/NodalFrequency.hpp"

namespace tooljoint::transient {

MassFactor::MassFactor(const CompiledModel& model)
    : pattern_(model.pattern()), factor_(pattern_), missing_(at(model.size()), 0) {
  Vector diagonal(model.size());
  model.combine(1.0, 0.0, 0.0, factor_.values());
  model.diagonal(1.0, 0.0, 0.0, diagonal.data());
  perUnit_.setOnes(model.size());
  for (int i = 0; i < model.size(); ++i)
    if (diagonal[i] == 0.0) {
      if (model.cut().owns(i)) factor_.values()[pattern_.address(i, i)] = 1.0;
      missing_[at(i)] = 1;
    } else {
      perUnit_[i] = 1.0 / diagonal[i];
    }
  singularAt_ = factor_.factor(model::roundingOfMass);
}

void MassFactor::invert(const CompiledModel& model) {
  if (!values_.empty()) return;
  std::vector<char> wanted(at(pattern_.blocks()), 0);
  for (const auto& batch : model.points()) batch.markBlocks(wanted);
  factor_.invert(wanted);
  values_.assign(factor_.inverse(), factor_.inverse() + pattern_.storage());
  for (int b = 0; b < pattern_.blocks(); ++b)
    for (int e = pattern_.rowBegin(b); e < pattern_.rowBegin(b + 1); ++e) {
      const int c = pattern_.column(e);
      for (int j = 0; j < pattern_.width(c); ++j)
        for (int i = 0; i < pattern_.width(b); ++i)
          if (missing_[at(pattern_.start(b) + i)] || missing_[at(pattern_.start(c) + j)])
            values_[pattern_.offset(e) + at(j * pattern_.width(b) + i)] = 0.0;
    }
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
  largest = pattern_.cut().largest(largest);
  factor_.solveNear(a.data(), blocks, perUnit_.data(), negligible * largest);
}

}  // namespace tooljoint::transient
