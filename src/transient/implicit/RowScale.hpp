// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "transient/compiled/CompiledModel.hpp"
#include "transient/implicit/StepScheme.hpp"

namespace tooljoint::transient {

/// Scale of the rows of an implicit step: one over the diagonal of ca M + cv C + K at one time,
/// kept as long as the scheme does not change.
class RowScale {
 public:
  void bind(CompiledModel& model);
  /// Sets the time of the model to t.
  void find(const StepScheme& scheme, double t);
  const Vector& weight() const { return weight_; }
  const Vector& inertia() const { return inertia_; }    ///< w_i M_ii
  const Vector& rounding() const { return rounding_; }  ///< of K q, per |q_i|

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory, const StepScheme& scheme);

 private:
  CompiledModel* model_ = nullptr;
  Vector weight_, inertia_, rounding_;
  double time_ = 0;
};

}  // namespace tooljoint::transient
