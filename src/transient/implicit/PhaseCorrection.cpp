// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/PhaseCorrection.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Sets 1 on the diagonal of empty rows: a dof with damping only has no acceleration to filter.
void determineEmptyRows(const linalg::BlockPattern& pattern, double* values, Vector& rows) {
  rowSums(pattern, values, rows);
  for (int i = 0; i < rows.size(); ++i)
    if (rows[i] == 0.0 && pattern.cut().owns(i)) values[pattern.address(i, i)] = 1.0;
}

}  // namespace

void rowSums(const linalg::BlockPattern& pattern, const double* values, Vector& rows) {
  rows.setZero();
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e)
      for (int j = 0; j < pattern.width(pattern.column(e)); ++j)
        for (int i = 0; i < pattern.width(b); ++i)
          rows[pattern.start(b) + i] +=
              std::abs(values[pattern.offset(e) + at(j * pattern.width(b) + i)]);
  pattern.cut().complete(rows.data());
}

void PhaseCorrection::bind(const CompiledModel& model) {
  model_ = &model;
  for (Vector* x : {&force_, &filtered_, &acceleration_, &rowSums_}) x->setZero(model.size());
}

void PhaseCorrection::reserve(const StepScheme& scheme) {
  if (scheme.phase != 0.0 && filter_.empty()) filter_ = linalg::BlockFactor(model_->pattern());
}

bool PhaseCorrection::factor(const StepScheme& scheme) {
  if (scheme.phase == 0.0) return true;
  model_->combine(scheme.filter * scheme.acceleration, 0.0, 1.0, filter_.values());
  for (const auto& batch : model_->points()) batch.subtractPositionTangent(filter_.values());
  determineEmptyRows(model_->pattern(), filter_.values(), rowSums_);
  return filter_.factor() < 0;
}

bool PhaseCorrection::applies(const StepScheme& scheme) const {
  if (scheme.phase == 0.0) return false;
  const auto& points = model_->points();
  return !model_->cut().any(std::any_of(points.begin(), points.end(),
                                        [](const auto& batch) { return batch.isScaled(); }));
}

/// k M q'' - k s ca M (s ca M + K - R' df/dd R)^-1 M q''
void PhaseCorrection::take(const StepScheme& scheme, const Vector& a, const Vector& delta) {
  const auto& pattern = model_->pattern();
  const double k = scheme.phase, kF = k * scheme.filter * scheme.acceleration;
  acceleration_ = a + scheme.acceleration * delta;
  for (const auto& run : model_->runs()) {
    const int begin = pattern.start(run.begin), length = pattern.start(run.end) - begin;
    auto inertia = filtered_.segment(begin, length);
    inertia.setZero();
    model_->addMass(acceleration_.data(), filtered_.data(), run);
    force_.segment(begin, length) = k * inertia;
  }
  filter_.solve(filtered_.data());
  for (const auto& run : model_->runs()) model_->addMass(filtered_.data(), force_.data(), run, -kF);
  taken_ = true;
}

}  // namespace tooljoint::transient
