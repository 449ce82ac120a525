// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The equations of one implicit step and how large what they leave is. From the q, a of a step
/// that would end at rest,
///
///     M (a + ca delta) + cv C delta + K (q + delta) = F + R' f(q + delta, cv delta, t)
///
/// Rows are scaled by w, one over the diagonal of S, so that forces and moments both read as
/// displacements. They hold where max |w R| is the tolerance times the largest scaled force, but no
/// more of it than loads and the state at the beginning of the step give reason for.
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

  /// A step begins: the linear residual at the q, a of one that would end at rest.
  void begin(const State& to, const StepScheme& scheme);
  /// linear() = M a + K q - F where v = 0 (the inertia that the predicted v brings counts in the
  /// largest force), or M a + C v + K q - F.
  void linearise(const State& to, const StepScheme* rest = nullptr);
  /// residual() = linear() - R' f, evaluated at the state; returns merit().
  double measure(const State& to);
  /// What an iteration of its own has measured.
  void take(double error, double force) { error_ = error, reference_ = force; }

  Vector& linear() { return linear_; }
  Vector& residual() { return residual_; }
  double error() const { return error_; }          ///< max |w R|
  double merit() const { return merit_; }          ///< |w R|_2
  double reference() const { return reference_; }  ///< largest scaled force
  double linearReference() const { return linearReference_; }
  double tolerance() const { return relative_ * std::min(reference_, mostForce_) + floor_; }
  bool converged() const { return error_ <= tolerance(); }
  /// max |w R| over the largest scaled force, and where.
  double relativeError() const;
  std::string worstName() const;

 private:
  CompiledModel* model_ = nullptr;
  double relative_ = 0;
  RowScale scale_;
  Vector linear_, residual_, forces_;
  Vector atCut_;  ///< forces at the cut of a model that is divided among ranks
  double error_ = 0, merit_ = 0, reference_ = 0;
  double mostForce_ = 0;        ///< what forces of this step are believed to reach
  double linearReference_ = 0;  ///< largest scaled force without points
  double floor_ = 0;            ///< rounding of K q, scaled alike
};

}  // namespace tooljoint::transient
