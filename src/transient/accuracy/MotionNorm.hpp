// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Size of a displacement, or of a difference of two: over the translations of the nodes, as an
/// engineer sees it, and over the mass, as kinetic energy measures it, rotations included. The
/// first sees motion along beside a large rotation, the second rotation beside little motion along.
#pragma once

#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

/// Of both norms: over the translations, over the mass.
using Norms = Eigen::Array2d;

/// sqrt(a / b) of each; 0 where both are, infinite beside nothing.
Norms rootRatio(const Norms& a, const Norms& b);

class MotionNorm {
 public:
  /// The model must outlive the norm. Collective.
  explicit MotionNorm(const CompiledModel& model);
  /// Sum of the squares of the translations [m2]; q in positions. In a model without output, or
  /// where no node moves along, each coordinate counts as a length. Collective.
  double translations(const Vector& q) const;
  /// That, and q'M q. Collective.
  Norms squares(const Vector& q) const;
  /// Of the mass that moves: v'M v over translations(v), about.
  double inertia() const { return inertia_; }

 private:
  const CompiledModel* model_;
  Sparse translations_;
  bool translated_;  ///< there are some
  double inertia_;
  mutable Vector product_;
};

}  // namespace tooljoint::transient
