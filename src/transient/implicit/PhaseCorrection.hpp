// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Force that corrects the period error of a scheme (AlphaCoefficients::setPhaseCorrection): M is
/// replaced by M - k M (I - F), F = s ca (s ca M + K - R' df/dd R)^-1 M. The force k M (I - F) q''
/// is taken once per step, from the first sufficiently close iterate, which is computed without it.
/// The resulting error is of the order of the square of k (I - F) F.
#pragma once

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/implicit/StepScheme.hpp"

namespace tooljoint::transient {

class PhaseCorrection {
 public:
  void bind(const CompiledModel& model);
  /// Allocates the filter if the scheme has one; factor() then allocates nothing.
  void reserve(const StepScheme& scheme);
  /// Factors s ca M + K - R' df/dd R, with df/dd from the tangents frozen in the points. False if
  /// the matrix is singular.
  bool factor(const StepScheme& scheme);

  /// Whether a step of the scheme is corrected. Steps with impacts are not: impacts are of first
  /// order anyway, and their acceleration must not be filtered. Collective.
  bool applies(const StepScheme& scheme) const;
  /// Starts a step without correction.
  void leaveOut() { taken_ = false; }
  bool isTaken() const { return taken_; }
  /// Takes the force of the acceleration a + ca delta.
  void take(const StepScheme& scheme, const Vector& a, const Vector& delta);
  const Vector& force() const { return force_; }

 private:
  const CompiledModel* model_ = nullptr;
  linalg::BlockFactor filter_;
  Vector force_, filtered_, acceleration_, rowSums_;
  bool taken_ = false;
};

/// sum_j |A_ij|, the same on all ranks that share a row.
void rowSums(const linalg::BlockPattern& pattern, const double* values, Vector& rows);

}  // namespace tooljoint::transient
