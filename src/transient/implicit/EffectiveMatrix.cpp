// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/EffectiveMatrix.hpp"

#include <cmath>

#include "common/Index.hpp"
#include "transient/implicit/PhaseCorrection.hpp"

namespace tooljoint::transient {
namespace {

/// max_i w_i sum_j |A_ij|
double rowNorm(const linalg::BlockPattern& pattern, const double* values, const Vector& weight,
               Vector& rows) {
  rowSums(pattern, values, rows);
  return pattern.cut().largest(rows.cwiseProduct(weight).maxCoeff());
}

}  // namespace

void EffectiveMatrix::bind(CompiledModel& model) {
  model_ = &model;
  laws_.assign(model.timed().lawValues().size(), 0.0);
  rows_.setZero(model.size());
  factor_ = linalg::BlockFactor(model.pattern());
  if (!model.points().empty()) factor_.reserveInverse();
}

void EffectiveMatrix::setWeights(const Vector& weight) {
  const auto& pattern = model_->pattern();
  dampingNorms_.clear();
  stiffnessNorms_.clear();
  for (const auto& term : model_->timed().damping().terms())
    dampingNorms_.push_back(rowNorm(pattern, term.values.data(), weight, rows_));
  for (const auto& term : model_->timed().stiffness().terms())
    stiffnessNorms_.push_back(rowNorm(pattern, term.values.data(), weight, rows_));
}

void EffectiveMatrix::refactor(const StepScheme& scheme) {
  scheme_ = scheme;
  time_ = model_->timed().time();
  stamp_ = model_->timed().matrixStamp();
  laws_ = model_->timed().lawValues();
  rebuild();
}

void EffectiveMatrix::rebuild() {
  model_->combine(scheme_.acceleration, scheme_.velocity, 1.0, factor_.values());
  for (const auto& batch : model_->points()) batch.subtractTangent(factor_.values());
  factored_ = factor_.factor() < 0;
}

void EffectiveMatrix::addDrift(const StepScheme& scheme, const Vector& delta, Vector& y) {
  model_->timed().addChangeSince(laws_, scheme.velocity, delta.data(), y.data());
}

double EffectiveMatrix::driftNorm(const StepScheme& scheme) const {
  double norm = 0;
  const auto& laws = model_->timed().lawValues();
  const auto& damping = model_->timed().damping().terms();
  for (std::size_t i = 0; i < damping.size(); ++i)
    norm += scheme.velocity * std::abs(laws[at(damping[i].law)] - laws_[at(damping[i].law)]) *
            dampingNorms_[i];
  const auto& stiffness = model_->timed().stiffness().terms();
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    norm += std::abs(laws[at(stiffness[i].law)] - laws_[at(stiffness[i].law)]) * stiffnessNorms_[i];
  return norm;
}

void EffectiveMatrix::save(std::vector<double>& memory) const {
  scheme_.save(memory);
  memory.insert(memory.end(), {factored_ ? 1.0 : 0.0, time_, hasDrifted() ? 0.0 : 1.0});
  memory.insert(memory.end(), laws_.begin(), laws_.end());
}

bool EffectiveMatrix::take(const double*& memory) {
  scheme_.restore(memory);
  factored_ = *memory++ != 0.0;
  time_ = *memory++;
  const bool current = *memory++ != 0.0;
  for (double& x : laws_) x = *memory++;
  return current;
}

}  // namespace tooljoint::transient
