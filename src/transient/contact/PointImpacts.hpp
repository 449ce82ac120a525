// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Points that meet their wall as an impact, because the wall is stiffer than the effective matrix
/// S without point laws at the point:
///
///     -tr(df/dd G0) > 1,   G0 = G (I + P G)^-1,   G = R S^-1 R',   P the tangent frozen in S
///
/// This is about two radians of the contact frequency of the point per step. A point on a massless
/// dof has no impacts: it stays in balance with its neighbours.
#pragma once

#include <vector>

#include "transient/Strategies.hpp"
#include "transient/compiled/CompiledModel.hpp"

namespace tooljoint::transient {

class PointImpacts {
 public:
  /// The strategies must outlive this.
  void bind(const CompiledModel& model, Strategies& strategies);
  /// In steps of length h the forces of impacts are multiplied by `impact`; 1: no impacts.
  void set(CompiledModel& model, double h, double impact);
  /// After an evaluation with tangents: sufficiently stiff ones of `points` become impacts.
  /// \param number of the batch
  /// \param compliance G of all its points, row-major
  void find(std::size_t number, PointBatch& batch, double t, const std::vector<int>& points,
            const std::vector<double>& compliance);

  /// Data for a restart with the same impacts.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  double yieldingDeeper(PointBatch& batch, int point, double t, const double* G0) const;

  Strategies* strategies_ = nullptr;
  std::vector<std::vector<double>> stiffness_;  ///< of each batch and point: largest -tr(df/dd G0)
                                                ///< / h^2 so far
  std::vector<std::vector<char>> light_;        ///< of each: on a massless dof
  double h_ = 0, impact_ = 1;
};

}  // namespace tooljoint::transient
