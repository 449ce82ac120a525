// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Size of a displacement, or of a difference of two, as an engineer sees it: over the translations
/// of the nodes. In a model without output each coordinate counts as a length.
#pragma once

#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class TranslationNorm {
 public:
  /// The model must outlive the norm. Collective.
  explicit TranslationNorm(const CompiledModel& model);
  /// Sum of the squares of the translations [m2]; q in positions. Collective.
  double square(const Vector& q) const;
  /// Of the mass that moves: v'M v over square(v), about.
  double inertia() const { return inertia_; }

 private:
  const CompiledModel* model_;
  Sparse translations_;
  bool translated_;  ///< there are some
  double inertia_;
  mutable Vector product_;
};

}  // namespace tooljoint::transient
