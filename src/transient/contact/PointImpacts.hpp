// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Points that meet their wall as an impact: where the wall is so stiff that the effective matrix S
/// without point laws gives way less than the wall does,
///
///     -tr(df/dd G0) > 1,   G0 = G (I + P G)^-1,   G = R S^-1 R',   P the tangent frozen in S
///
/// which is about two radians of the point's own contact frequency per step. A point on a dof
/// without mass has no impacts: it stays in balance with its neighbours.
#pragma once

#include <vector>

#include "transient/Strategies.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class PointImpacts {
 public:
  /// The strategies must outlive this.
  void bind(const CompiledModel& model, Strategies& strategies);
  /// In steps of length h the forces of impacts are multiplied by `impact`; 1: there are none.
  void set(CompiledModel& model, double h, double impact);
  /// After an evaluation with tangents: those of `points` that turn out to be stiff are impacts
  /// from now on. \param number of the batch \param compliance G of all its points, row-major
  void find(std::size_t number, PointBatch& batch, double t, const std::vector<int>& points,
            const std::vector<double>& compliance);

  /// What a restart needs to treat the same points as impacts.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  double yieldingDeeper(PointBatch& batch, int point, double t, const double* G0) const;

  Strategies* strategies_ = nullptr;
  std::vector<std::vector<double>> stiffness_;  ///< of each batch and point, the largest
                                                ///< -tr(df/dd G0) / h^2 seen
  std::vector<std::vector<char>> light_;        ///< of each: on a dof without mass
  double h_ = 0, impact_ = 1;
};

}  // namespace tooljoint::transient
