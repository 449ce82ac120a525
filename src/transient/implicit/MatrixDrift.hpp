// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Effect of the changes of S by laws of time since it was factored: (S(now) - S(then)) d, for a
/// displacement d close to the solution. It is evaluated again if the iterate has moved so far from
/// d that the difference exceeds a part of the tolerance.
#pragma once

#include "transient/Tuned.hpp"
#include "transient/implicit/StepParts.hpp"

namespace tooljoint::transient {

class MatrixDrift {
 public:
  /// The referenced parts must outlive this.
  void bind(const StepParts& parts) {
    parts_ = parts;
    for (Vector* x : {&at_, &force_}) x->setZero(parts.model->size());
  }
  /// Call before iterations with S of the scheme.
  void start(const StepScheme& scheme) {
    scheme_ = &scheme;
    auto& matrix = parts_.factor->matrix();
    norm_ = matrix.hasDrifted() ? matrix.driftNorm(scheme) : 0.0;
  }
  bool isAny() const { return norm_ > 0; }
  /// Sets d = guess, or 0 if its force is negligible.
  template <class Expression>
  void begin(const Expression& guess) {
    at_ = guess;
    if (norm_ * parts_.model->largest(at_) > negligible())
      find();
    else
      at_.setZero(), force_.setZero();
  }
  /// Sets d = delta if delta is far from d; true in that case.
  bool follow(const Vector& delta) {
    if (!isAny() ||
        !(norm_ * parts_.model->cut().largest((delta - at_).cwiseAbs().maxCoeff()) > negligible()))
      return false;
    at_ = delta;
    find();
    parts_.factor->charge(Tuned::driftPrice);
    return true;
  }
  const Vector& force() const { return force_; }

 private:
  double negligible() const { return Tuned::rightEnough * parts_.equations->tolerance(); }
  void find() {
    force_.setZero();
    parts_.factor->matrix().addDrift(*scheme_, at_, force_);
  }

  StepParts parts_;
  const StepScheme* scheme_ = nullptr;
  double norm_ = 0;    ///< bound of max |w (S(now) - S(then)) x| / max |x|; 0: no change
  Vector at_, force_;  ///< d, and its force
};

}  // namespace tooljoint::transient
