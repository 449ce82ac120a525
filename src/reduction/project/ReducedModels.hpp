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

/// y = A x for many x; dense where A has few zeros.
class LinearMap {
 public:
  explicit LinearMap(Sparse A);
  Vector operator()(const Vector& x) const;
  /// A B
  LinearMap times(const Sparse& B) const;

 private:
  LinearMap() = default;
  Sparse sparse_;  ///< A, or empty where it is dense
  Matrix dense_;
};

/// Makes the reduced model of each of some identical parts. What does not differ among them, the
/// matrices, is one for all; loads, states and points are those of the part.
class ReducedModels {
 public:
  /// `like`, which must outlive this, is the part whose basis and matrices `core` holds.
  ReducedModels(const model::Substructure& like, std::shared_ptr<const ReducedCore> core,
                const ReductionOptions& options);
  /// Fills `out`, which is new, with the reduced part; `index` is the number of the part among all.
  void make(const model::Substructure& part, int index, ReducedSubstructure& out);

 private:
  /// What a stiffness term does to the reference state.
  struct Reaction {
    std::string name;
    LinearMap force;  ///< -Phi' K_i
    int law;
  };

  const LinearMap& transposedBasis();
  /// Phi' f.
  Vector projected(const Vector& load);
  /// -Phi' K_i of the terms of the stiffness. Not of a large basis, which is as large.
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
  model::SharedSparse recovery_;      ///< of `like` times Phi, for those parts that have one
  std::vector<Reaction> reactions_;   ///< for those parts that have a reference state
};

}  // namespace tooljoint::reduction
