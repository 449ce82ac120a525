// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Equations of one implicit step and the size of their residual. From the q, a of a step with v =
/// 0 at its end,
///
///     M (a + ca delta) + cv C delta + K (q + delta) = F + R' f(q + delta, cv delta, t)
///
/// Rows are scaled by w, one over the diagonal of S, so that forces and moments both become
/// displacements. The equations hold if max |w R| is at most the tolerance times the largest scaled
/// force. That force is bounded by a multiple of the loads and of the state at the start of the
/// step.
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/implicit/RowScale.hpp"

namespace tooljoint::transient {

class StepEquations {
 public:
  /// \param tolerance of max |w R| over the largest scaled force
  void bind(CompiledModel& model, double tolerance);
  RowScale& scale() { return scale_; }
  const RowScale& scale() const { return scale_; }
  const Vector& weight() const { return scale_.weight(); }

  /// Starts a step: the linear residual at the q, a of a step with v = 0 at its end.
  void begin(const State& to, const StepScheme& scheme);
  /// linear() = M a + K q - F for v = 0 (the inertia of the predicted v counts in the largest
  /// force), or M a + C v + K q - F.
  void linearise(const State& to, const StepScheme* rest = nullptr);
  /// residual() = linear() - R' f, evaluated at the state; returns merit().
  double measure(const State& to);
  /// Takes the error and the largest force from another iteration.
  void take(double error, double force) { error_ = error, reference_ = force; }

  Vector& linear() { return linear_; }
  Vector& residual() { return residual_; }
  double error() const { return error_; }          ///< max |w R|
  double merit() const { return merit_; }          ///< |w R|_2
  double reference() const { return reference_; }  ///< largest scaled force
  double linearReference() const { return linearReference_; }
  double tolerance() const { return relative_ * std::min(reference_, mostForce_) + floor_; }
  bool converged() const { return error_ <= tolerance(); }
  /// max |w R| over the largest scaled force, and its location.
  double relativeError() const;
  std::string worstName() const;

 private:
  CompiledModel* model_ = nullptr;
  double relative_ = 0;
  RowScale scale_;
  Vector linear_, residual_, forces_;
  Vector atCut_;  ///< forces at the cut of a divided model
  double error_ = 0, merit_ = 0, reference_ = 0;
  double mostForce_ = 0;        ///< upper bound of the forces in this step
  double linearReference_ = 0;  ///< largest scaled force without points
  double floor_ = 0;            ///< scaled rounding of K q
};

}  // namespace tooljoint::transient
