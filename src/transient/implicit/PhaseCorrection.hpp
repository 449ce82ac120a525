// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The force that makes up for the period error of a scheme
/// (AlphaStep::setPhaseCorrection): M is replaced by M - k M (I - F), F = s ca
/// (s ca M + K - R' df/dd R)^-1 M. The force k M (I - F) q'' is taken once in a
/// step, from the first iterate that is near, which is without it: what that
/// misses is of the order of the square of k (I - F) F.
#pragma once

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/implicit/StepScheme.hpp"

namespace tooljoint::transient {

class PhaseCorrection {
 public:
  void bind(const CompiledModel& model);
  /// Room for the filter of a scheme that has one; factor() allocates nothing
  /// then.
  void reserve(const StepScheme& scheme);
  /// Factors s ca M + K - R' df/dd R, df/dd of the tangents frozen in the
  /// points. False when it has no inverse.
  bool factor(const StepScheme& scheme);

  /// Whether a step of the scheme is corrected: impacts are of first order
  /// anyway, and their acceleration is not one to be filtered. Collective.
  bool applies(const StepScheme& scheme) const;
  /// A step begins without.
  void leaveOut() { taken_ = false; }
  bool isTaken() const { return taken_; }
  /// The force of the acceleration a + ca delta.
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
