// SPDX-License-Identifier: BSD-3-Clause
#include "transient/MissingModes.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Index.hpp"

namespace tooljoint::transient {

MissingModes::MissingModes(const CompiledModel& model, const std::vector<MissingMode>& modes,
                           const State& start)
    : model_(&model) {
  for (const auto& missing : modes) {
    Mode mode{missing.omega, missing.damping, {}};
    Vector row;
    model.toPositions(missing.row, row);
    for (Eigen::Index i = 0; i < row.size(); ++i)
      if (row[i] != 0.0) mode.row.push_back({static_cast<int>(i), row[i]});
    if (sizeOf(mode.row) < (missing.row.array() != 0.0).count()) mode.row.clear();
    mode.drive = driveOf(mode, start);
    modes_.push_back(std::move(mode));
  }
}

double MissingModes::driveOf(const Mode& mode, const State& state) {
  double sum = 0.0;
  for (const auto& entry : mode.row) sum += entry.value * state.v[entry.position];
  return sum;
}

// Trapezoidal rule in which the change of l q' replaces l q'' h: no numerical damping, and a jump
// of velocity within a step counts in full.
void MissingModes::step(const State& from, const State& to) {
  const double h = to.t - from.t;
  for (auto& mode : modes_) {
    if (mode.row.empty()) continue;
    const double drive = driveOf(mode, to);
    const double half = 0.5 * h * mode.damping + 0.25 * std::pow(h * mode.omega, 2);
    const double velocity = ((1.0 - half) * mode.velocity - (drive - mode.drive) -
                             h * std::pow(mode.omega, 2) * mode.eta) /
                            (1.0 + half);
    mode.eta += 0.5 * h * (mode.velocity + velocity);
    mode.velocity = velocity;
    mode.drive = drive;
  }
}

void MissingModes::look(const State& state) {
  for (auto& mode : modes_) mode.energy += mode.velocity * mode.velocity;
  whole_ += model_->ownMassForm(state.v.data());
}

double MissingModes::share() const {
  double missing = 0.0;
  for (const auto& mode : modes_) missing += model_->cut().largest(mode.energy);
  const double whole = model_->cut().sum(whole_);
  return whole > 0 ? std::min(1.0, missing / whole) : 0.0;
}

void MissingModes::save(std::vector<double>& memory) const {
  for (const auto& mode : modes_)
    memory.insert(memory.end(), {mode.drive, mode.eta, mode.velocity, mode.energy});
  memory.push_back(whole_);
}

void MissingModes::restore(const double*& memory) {
  for (auto& mode : modes_)
    for (double* value : {&mode.drive, &mode.eta, &mode.velocity, &mode.energy}) *value = *memory++;
  whole_ = *memory++;
}

}  // namespace tooljoint::transient
