// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// S = ca M + cv C + K - R'PR of an implicit step, factored once for many steps, with P the
/// tangents frozen in the points. Changes of C and K by laws of time since then, (S(now) - S(then))
/// delta, act term by term on the displacement.
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/implicit/StepScheme.hpp"

namespace tooljoint::transient {

class EffectiveMatrix {
 public:
  void bind(CompiledModel& model);
  /// Scale of the rows in driftNorm().
  void setWeights(const Vector& weight);

  /// Factors the current matrices and the frozen tangents; see isFactored().
  void refactor(const StepScheme& scheme);
  /// Factors again, with the currently frozen tangents.
  void rebuild();
  bool isFactored() const { return factored_; }
  /// The factor lacks tangents and is invalid.
  void spoil() { factored_ = false; }
  bool isOf(const StepScheme& scheme) const { return factored_ && scheme_.h == scheme.h; }
  linalg::BlockFactor& factor() { return factor_; }
  const StepScheme& scheme() const { return scheme_; }

  bool hasDrifted() const { return stamp_ != model_->timed().matrixStamp(); }
  /// y += (S(now) - S(then)) delta
  void addDrift(const StepScheme& scheme, const Vector& delta, Vector& y);
  /// Bound of max |w (S(now) - S(then)) x| / max |x|.
  double driftNorm(const StepScheme& scheme) const;

  void save(std::vector<double>& memory) const;
  /// `rebuild` factors with the model at the time of the factor and the frozen tangents, which are
  /// already restored. Afterwards the model is at its own time again.
  template <class Rebuild>
  void restore(const double*& memory, const Rebuild& rebuild) {
    const bool current = take(memory);
    if (!factored_) return;
    const double now = model_->timed().time();
    model_->setTime(time_);
    rebuild();
    model_->setTime(now);
    stamp_ = current ? model_->timed().matrixStamp() : -1;
  }

 private:
  /// Reads the data of save(); returns whether C and K were those of the factor.
  bool take(const double*& memory);

  CompiledModel* model_ = nullptr;
  linalg::BlockFactor factor_;
  bool factored_ = false;
  StepScheme scheme_;  ///< scheme, time, matrix stamp and laws of the factor
  double time_ = 0;
  long stamp_ = -1;
  std::vector<double> laws_;
  std::vector<double> dampingNorms_,
      stiffnessNorms_;  ///< max_i w_i sum_j |A_ij| per term
  Vector rows_;
};

}  // namespace tooljoint::transient
