// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/ImpactAccelerations.hpp"

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void ImpactAccelerations::bind(const CompiledModel& model) {
  pattern_ = &model.pattern();
  a_.setZero(model.size());
  blocks_.clear();
  blocks_.reserve(4 * static_cast<std::size_t>(pattern_->blocks()));
}

void ImpactAccelerations::find(const CompiledModel& model, const MassFactor& mass) {
  for (int b : blocks_) a_.segment(pattern_->start(b), pattern_->width(b)).setZero();
  blocks_.clear();
  for (const auto& batch : model.points())
    if (batch.isScaled()) batch.addScaledForce(a_.data(), blocks_);
  if (model.cut().any(!blocks_.empty())) mass.solveNear(a_, blocks_, Tuned::rounding);
}

void ImpactAccelerations::add(double factor, Vector& y) const {
  for (int b : blocks_) {
    const int start = pattern_->start(b), width = pattern_->width(b);
    y.segment(start, width) += factor * a_.segment(start, width);
  }
}

void ImpactAccelerations::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), a_.begin(), a_.end());
}

void ImpactAccelerations::restore(const double*& memory) {
  for (double& x : a_) x = *memory++;
  blocks_.clear();
  for (int b = 0; b < pattern_->blocks(); ++b)
    if (!a_.segment(pattern_->start(b), pattern_->width(b)).isZero(0.0)) blocks_.push_back(b);
}

}  // namespace tooljoint::transient
