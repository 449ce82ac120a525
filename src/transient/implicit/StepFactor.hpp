// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "transient/Integrator.hpp"
#include "transient/implicit/EffectiveMatrix.hpp"
#include "transient/implicit/PhaseCorrection.hpp"

namespace tooljoint::transient {

/// Factor of the effective matrix S, which many steps share, with its dependent data and the
/// decision when to renew it.
class StepFactor {
 public:
  void bind(CompiledModel& model);
  void setWeights(const Vector& weight) { matrix_.setWeights(weight); }
  void reserve(const StepScheme& scheme) { phase_.reserve(scheme); }

  /// S = ca M + cv (C - df/dv) + K - df/dd at the state, without destabilising parts of point
  /// tangents. False if the factorisation fails.
  bool renew(const StepScheme& scheme, const State& to, Counters& counters);
  /// Factors again with the tangents currently frozen in the points.
  bool rebuild(Counters& counters);
  /// The factor lacks tangents and is invalid.
  void spoil();
  bool isOf(const StepScheme& scheme) const { return matrix_.isOf(scheme); }

  /// Convergence is slow: factor again before the next iteration.
  void want() { wanted_ = true; }
  bool isWanted() const { return wanted_; }
  /// A step took this many relaxations: requests a new factor once it would have paid.
  void account(double relaxations);
  /// Adds relaxations besides those of account().
  void charge(double relaxations) { debt_ += relaxations; }

  linalg::BlockFactor& factor() { return matrix_.factor(); }
  EffectiveMatrix& matrix() { return matrix_; }
  PhaseCorrection& phase() { return phase_; }
  /// A different number for each factor.
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
  double debt_ = 0;   ///< relaxations in excess of that since
};

}  // namespace tooljoint::transient
