// SPDX-License-Identifier: BSD-3-Clause
#include "transient/implicit/ContactForceIteration.hpp"

#include <cmath>

#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void ContactForceIteration::bind(const StepParts& parts) {
  parts_ = parts;
  points_.bind(*parts.model, *parts.strategies);
  drift_.bind(parts);
  for (Vector* x : {&delta_, &q_, &others_}) x->setZero(parts.model->size());
  possible_ = parts.strategies->has(Strategy::Relaxation);
  for (const auto& batch : parts.model->points())
    possible_ = possible_ && batch.width() <= PointSolve::widest;
}

void ContactForceIteration::prepare(const StepScheme& scheme) {
  points_.setWeights(parts_.equations->weight());
  if (possible_) points_.impacts().set(*parts_.model, scheme.h, scheme.impact);
}

void ContactForceIteration::restore(const double*& memory, const StepScheme& scheme) {
  if (scheme.h > 0) points_.setWeights(parts_.equations->weight());
  points_.impacts().restore(memory);
  if (scheme.h > 0) points_.impacts().set(*parts_.model, scheme.h, scheme.impact);
}

bool ContactForceIteration::solve(State& to, const StepScheme& scheme, Counters& counters) {
  scheme_ = &scheme;
  counters_ = &counters;
  if (compliance_ != parts_.factor->number()) points_.setCompliance(parts_.factor->factor());
  compliance_ = parts_.factor->number();
  points_.start(to.q, parts_.equations->linear());
  for (bool again = false;; again = true) {
    if (!settle(to, again)) return false;
    q_ = to.q + delta_;
    if (!parts_.model->addMissed(q_.data(), to.t)) break;
  }
  complete(to);
  points_.finish(to.t, scheme.velocity);
  return true;
}

void ContactForceIteration::complete(State& to) const {
  to.q += delta_;
  to.v = scheme_->velocity * delta_;
  to.a += scheme_->acceleration * delta_;
}

/// The iteration for delta_. If delta_ was found before missed points were detected, it continues
/// from there, at these points first.
bool ContactForceIteration::settle(const State& to, bool again) {
  const double c = scheme_->velocity, tolerance = parts_.equations->tolerance();
  drift_.start(*scheme_);
  bool changed = again && join(to), near = false;
  bool phase = !again && begin(to);
  double work = again ? 0 : 1;
  Turns turns(*parts_.strategies, parts_.maxIterations);
  for (int iteration = 1; turns.areTaken() || iteration <= parts_.maxIterations; ++iteration) {
    const bool joins = again && iteration == 1;
    if (!joins) {
      work += relaxOnce(to, near);
      changed = false;
    }
    const double error = parts_.equations->error();
    bool good = parts_.equations->converged() && !joins && !phase;
    if (phase && (parts_.equations->converged() || points_.wrongShare() <= Tuned::counted)) {
      parts_.factor->phase().take(*scheme_, to.a, delta_);
      phase = false;
      changed = true;
    }
    if (drift_.follow(delta_)) {
      changed = true;
      good = false;
    }
    if (good) {
      parts_.factor->account(work);
      return true;
    }
    if (!std::isfinite(error) || !turns.goOn(iteration, error)) return false;
    near = turns.areTaken() ? points_.sweepEveryFourth(to.t, c, tolerance, turns.next()) && !changed
                            : points_.correct(to.t, c, tolerance, changed);
    if (!near) work += 1.0;
  }
  return false;
}

/// Starts at the predicted v; returns whether the phase is to be corrected. Points whose tangent in
/// S is far stiffer than their current one keep this position in the first iterate, from which the
/// phase correction is taken. A further extrapolation would make vibration of a few steps per
/// period grow.
bool ContactForceIteration::begin(const State& to) {
  points_.guess(to.t, scheme_->velocity, to.v);
  if (drift_.isAny()) drift_.begin(to.v / scheme_->velocity);
  parts_.factor->phase().leaveOut();
  return parts_.factor->phase().applies(*scheme_);
}

/// Adds the missed points. The phase correction is kept, because they have only just touched. True
/// if one of them is an impact, so that the correction must be dropped.
bool ContactForceIteration::join(const State& to) {
  double force = parts_.equations->reference();
  const double error =
      points_.join(to.t, scheme_->velocity, delta_, parts_.equations->tolerance(), force);
  parts_.equations->take(error, force);
  PhaseCorrection& phase = parts_.factor->phase();
  if (!phase.isTaken() || phase.applies(*scheme_)) return false;
  phase.leaveOut();
  return true;
}

/// One relaxation, of all points or of few (near). Returns the cost of a near one relative to one
/// of all.
double ContactForceIteration::relaxOnce(const State& to, bool near) {
  double work = 0;
  if (near) {
    parts_.strategies->count(Strategy::NearSolves);
    points_.solveNear(parts_.factor->factor(), parts_.equations->tolerance(), delta_);
    work = points_.nearShare();
  } else {
    points_.solve(parts_.factor->factor(), otherForces(), delta_);
  }
  ++counters_->newtonIterations;
  double force = near ? parts_.equations->reference() : parts_.equations->linearReference();
  const double error =
      points_.evaluate(to.t, scheme_->velocity, delta_, parts_.equations->tolerance(), force);
  parts_.equations->take(error, force);
  return work;
}

/// Forces besides the linear residual and the points, if any.
const Vector* ContactForceIteration::otherForces() {
  const PhaseCorrection& phase = parts_.factor->phase();
  if (!drift_.isAny()) return phase.isTaken() ? &phase.force() : nullptr;
  others_ = -drift_.force();
  if (phase.isTaken()) others_ += phase.force();
  return &others_;
}

}  // namespace tooljoint::transient
