// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/StepFactor.hpp"

#include <algorithm>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void StepFactor::bind(CompiledModel& model) {
  model_ = &model;
  matrix_.bind(model);
  phase_.bind(model);
}

bool StepFactor::renew(const StepScheme& scheme, const State& to, Counters& counters) {
  for (auto& batch : model_->points()) {
    if (scheme.phase != 0.0) batch.lookAheadAlong(to.t, scheme.h, to.q.data(), to.v.data());
    batch.evaluateWithTangent(to.t, to.q.data(), to.v.data());
    batch.freezeTangent(1.0, scheme.velocity);
    if (scheme.phase != 0.0) batch.leaveOutTurning(Tuned::mostTurn);
    batch.takeOutPush();
  }
  matrix_.refactor(scheme);
  finish();
  ++counters.factorisations;
  wanted_ = false;
  debt_ = usual_ = 0;
  return matrix_.isFactored();
}

bool StepFactor::rebuild(Counters& counters) {
  matrix_.rebuild();
  finish();
  ++counters.factorisations;
  return matrix_.isFactored();
}

void StepFactor::spoil() {
  wanted_ = true;
  matrix_.spoil();
}

/// Updates the data that belong to a factor.
void StepFactor::finish() {
  ++number_;
  if (matrix_.isFactored() && !phase_.factor(matrix_.scheme())) matrix_.spoil();
}

void StepFactor::account(double relaxations) {
  if (usual_ == 0) usual_ = relaxations;
  debt_ += std::max(0.0, relaxations - usual_);
  if (debt_ > Tuned::factorPrice) wanted_ = true;
}

void StepFactor::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {wanted_ ? 1.0 : 0.0, debt_, usual_});
  matrix_.save(memory);
}

void StepFactor::restore(const double*& memory) {
  wanted_ = *memory++ != 0.0;
  debt_ = *memory++;
  usual_ = *memory++;
  matrix_.restore(memory, [this] {
    matrix_.rebuild();
    finish();
  });
}

}  // namespace tooljoint::transient
