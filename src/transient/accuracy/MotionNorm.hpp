// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Size of a displacement, or of a difference of two, in two norms: over the translations of the
/// nodes, and over the mass (as in kinetic energy), rotations included. The first shows small
/// translations beside large rotations, the second rotations beside small translations.
#pragma once

#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

/// Both norms: over the translations, over the mass.
using Norms = Eigen::Array2d;

/// sqrt(a / b) of each; 0 if both are 0, infinite if only b is 0.
Norms rootRatio(const Norms& a, const Norms& b);

class MotionNorm {
 public:
  /// The model must outlive the norm. Collective.
  explicit MotionNorm(const CompiledModel& model);
  /// Sum of the squares of the translations [m2]; q in positions. In a model without output, or
  /// without nodes that translate, each coordinate counts as a length. Collective.
  double translations(const Vector& q) const;
  /// translations(q) and q'M q. Collective.
  Norms squares(const Vector& q) const;
  /// Mass of the motion: v'M v is about inertia() * translations(v).
  double inertia() const { return inertia_; }

 private:
  const CompiledModel* model_;
  Sparse translations_;
  bool translated_;  ///< the model has translations
  double inertia_;
  mutable Vector product_;
};

}  // namespace tooljoint::transient
