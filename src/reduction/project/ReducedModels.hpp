// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The models of identical parts in the coordinates of one basis.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "model/Substructure.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/ReducedSubstructure.hpp"
#include "reduction/project/Distribution.hpp"

namespace tooljoint::reduction {

/// (v'M v + |x'K x|) / 2 with K at t = 0 [J].
double energyOf(const model::SecondOrderModel& model, const Vector& x, const Vector& v);

/// y = A x for many x; dense if A has few zeros.
class LinearMap {
 public:
  explicit LinearMap(Sparse A);
  Vector operator()(const Vector& x) const;
  /// A B
  LinearMap times(const Sparse& B) const;

 private:
  LinearMap() = default;
  Sparse sparse_;  ///< A, or empty if dense
  Matrix dense_;
};

/// Makes the reduced models of several identical parts. The matrices, which are equal, are shared;
/// loads, states and points belong to each part.
class ReducedModels {
 public:
  /// `like`, whose basis and matrices `core` holds, must outlive this object.
  ReducedModels(const model::Substructure& like, std::shared_ptr<const ReducedCore> core,
                const ReductionOptions& options);
  /// Fills the new `out` with the reduced part; `index` is the number of the part among all.
  void make(const model::Substructure& part, int index, ReducedSubstructure& out);

 private:
  /// Force of a stiffness term in the reference state.
  struct Reaction {
    std::string name;
    LinearMap force;  ///< -Phi' K_i
    int law;
  };

  const LinearMap& transposedBasis();
  /// Phi' f.
  Vector projected(const Vector& load);
  /// -Phi' K_i of the terms of the stiffness. Not stored for a large basis, since it would be as
  /// large.
  const std::vector<Reaction>& reactions();
  void addLoads(const model::Substructure& part, const Vector& offset,
                model::SecondOrderModel& reduced);
  void addPoints(const model::Substructure& part, const Vector& offset,
                 model::SecondOrderModel& reduced);
  DerivedInterface forcesAsCoordinates(const model::Substructure& part, const Vector& offset) const;

  const model::Substructure& like_;
  std::shared_ptr<const ReducedCore> core_;
  bool keepStatic_;
  std::optional<LinearMap> project_;  ///< Phi'
  model::SharedSparse recovery_;      ///< of `like` times Phi, for parts with the same recovery
  std::vector<Reaction> reactions_;   ///< for parts with a reference state
};

}  // namespace tooljoint::reduction
