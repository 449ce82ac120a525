// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/RowScale.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "transient/Tuned.hpp"
#include "transient/implicit/PhaseCorrection.hpp"

namespace tooljoint::transient {

void RowScale::bind(CompiledModel& model) {
  model_ = &model;
  for (Vector* x : {&weight_, &inertia_, &rounding_}) x->setZero(model.size());
}

void RowScale::find(const StepScheme& scheme, double t) {
  model_->setTime(t);
  time_ = t;
  model_->diagonal(scheme.acceleration, scheme.velocity, 1.0, weight_.data());
  const double smallest = Tuned::rounding * model_->largest(weight_);
  for (double& w : weight_) w = 1.0 / std::max(std::abs(w), smallest);
  model_->diagonal(1.0, 0.0, 0.0, inertia_.data());
  inertia_ = inertia_.cwiseProduct(weight_);
  // Row sums of |K| bound the rounding of K q.
  rounding_.setZero();
  if (!model_->timed().stiffness().empty())
    rowSums(model_->pattern(), model_->timed().stiffness().current(), rounding_);
  rounding_ = 2 * std::numeric_limits<double>::epsilon() * rounding_.cwiseProduct(weight_);
}

void RowScale::save(std::vector<double>& memory) const {
  memory.push_back(time_);
  memory.insert(memory.end(), weight_.begin(), weight_.end());
}

/// Restores the weights, which belong to the laws at their time.
void RowScale::restore(const double*& memory, const StepScheme& scheme) {
  time_ = *memory++;
  const double now = model_->timed().time();
  if (scheme.h > 0) find(scheme, time_);
  model_->setTime(now);
  for (double& x : weight_) x = *memory++;
}

}  // namespace tooljoint::transient
