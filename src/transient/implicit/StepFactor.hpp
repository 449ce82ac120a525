// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "transient/Integrator.hpp"
#include "transient/implicit/EffectiveMatrix.hpp"
#include "transient/implicit/PhaseCorrection.hpp"

namespace tooljoint::transient {

/// The factor of the effective matrix S, which many steps share, what belongs to it, and when it
/// pays to renew it.
class StepFactor {
 public:
  void bind(CompiledModel& model);
  void setWeights(const Vector& weight) { matrix_.setWeights(weight); }
  void reserve(const StepScheme& scheme) { phase_.reserve(scheme); }

  /// S = ca M + cv (C - df/dv) + K - df/dd at the state, but for forces that push on. False when it
  /// has no factor.
  bool renew(const StepScheme& scheme, const State& to, Counters& counters);
  /// Again with the tangents now frozen in the points.
  bool rebuild(Counters& counters);
  /// The factor lacks tangents now.
  void spoil();
  bool isOf(const StepScheme& scheme) const { return matrix_.isOf(scheme); }

  /// Convergence was slow: factor anew before the next iteration.
  void want() { wanted_ = true; }
  bool isWanted() const { return wanted_; }
  /// A step took this many relaxations: want a new factor once that would have paid.
  void account(double relaxations);
  /// Relaxations beside those of account().
  void charge(double relaxations) { debt_ += relaxations; }

  linalg::BlockFactor& factor() { return matrix_.factor(); }
  EffectiveMatrix& matrix() { return matrix_; }
  PhaseCorrection& phase() { return phase_; }
  /// Another number for each factor.
  long number() const { return number_; }

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  void finish();

  CompiledModel* model_ = nullptr;
  EffectiveMatrix matrix_;
  PhaseCorrection phase_;
  long number_ = 0;
  bool wanted_ = false;
  double usual_ = 0;  ///< relaxations of the first step with this factor
  double debt_ = 0;   ///< relaxations beyond that since
};

}  // namespace tooljoint::transient
