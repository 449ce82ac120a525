// SPDX-License-Identifier: BSD-3-Clause
#include "transient/verdict/CutOffEnergy.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Fraction of the frequency at which the modes of a part end.
constexpr double upper = 0.5;

}  // namespace

CutOffEnergy::CutOffEnergy(const CompiledModel& model, const std::vector<double>& cutOffs)
    : model_(&model) {
  const auto& source = model.source();
  const Vector mass = source.mass.diagonal();
  const Vector stiffness = source.stiffnessAt(model.timed().time()).diagonal();
  const auto& position = model.pattern().partition().position;
  for (Eigen::Index i = 0; i < mass.size(); ++i) {
    const auto& dof = source.dofs[at(i)];
    if (dof.kind != model::DofLabel::Kind::Modal || at(dof.entity) >= cutOffs.size()) continue;
    const double least = upper * cutOffs[at(dof.entity)];
    if (stiffness[i] > least * least * mass[i]) high_.push_back({position[at(i)], mass[i]});
  }
}

void CutOffEnergy::look(const State& state) {
  for (const auto& mode : high_) highest_ += mode.mass * std::pow(state.v[mode.position], 2);
  whole_ += model_->ownMassForm(state.v.data());
}

double CutOffEnergy::share() const {
  double sums[2] = {highest_, whole_};
  model_->cut().reduce(nullptr, 0, sums, 2);
  return sums[1] > 0 ? std::min(1.0, sums[0] / sums[1]) : 0.0;
}

void CutOffEnergy::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {highest_, whole_});
}

void CutOffEnergy::restore(const double*& memory) {
  highest_ = *memory++;
  whole_ = *memory++;
}

}  // namespace tooljoint::transient
