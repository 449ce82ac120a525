// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// M^-1 R'f of the points that met walls as impacts in a step, f times the factor of the scheme:
/// zero except in a few blocks.
#pragma once

#include <vector>

#include "transient/compiled/CompiledModel.hpp"
#include "transient/compiled/MassFactor.hpp"

namespace tooljoint::transient {

class ImpactAccelerations {
 public:
  /// Sets none, for a model whose pattern outlives this.
  void bind(const CompiledModel& model);
  /// Computes those of the forces in the batches of the model. Collective.
  void find(const CompiledModel& model, const MassFactor& mass);
  bool none() const { return blocks_.empty(); }
  /// y += factor a
  void add(double factor, Vector& y) const;

  /// Append / restore.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  const linalg::BlockPattern* pattern_ = nullptr;
  Vector a_;
  std::vector<int> blocks_;  ///< nonzero blocks of a
};

}  // namespace tooljoint::transient
