// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Static equilibrium under a growing load, for the path continuation of src/statics.
#pragma once

#include <optional>
#include <string>

#include "model/ParametricProblem.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"

namespace tooljoint::equilibrium {

/// Negative pivots of K_pa + K_gpo(D) with closed contacts as springs and without friction, D at
/// all dofs. None if the matrix is almost singular.
std::optional<int> negativePivots(const StaticInput& input, const Vector& displacement);

/// A load p l and the measure of path length. Vectors have 6 entries per node.
struct GrowingLoad {
  Vector direction;        ///< l, load of p = 1 [N, N m]
  double contained = 0.0;  ///< value of p whose load is part of StaticInput::load
  double scale = 1.0;      ///< p_0 of model::ParametricProblem
  Vector pathWeights;      ///< a_i of model::ParametricProblem
};

/// r(D, p) = (K_pa + K_gpo(D)) D - F_s - (p - p_F) l - F_cs(D) - R_ipa on the free dofs, without
/// friction and with walls that only push. F_s contains p_F l.
class LoadPath : public model::ParametricProblem {
 public:
  /// `input` must outlive the object. Errors as StaticProblem; ModelError if the load acts on held
  /// dofs only.
  LoadPath(const StaticInput& input, const GrowingLoad& load);

  int size() const override { return problem_.size(); }
  void residual(const Vector& x, double p, Vector& r) const override;
  void jacobian(const Vector& x, double p, Sparse& J) const override;
  /// -l.
  void parameterDerivative(const Vector& x, double p, Vector& drdp) const override;
  Vector residualScale() const override { return problem_.residualScale(); }
  Vector pathWeights() const override { return weights_; }
  double parameterScale() const override { return scale_; }
  /// Negative pivots of K_pa + K_gpo(D) with closed contacts as springs. Axial force and torque are
  /// held, since they do not depend on the deflection.
  std::optional<int> negativePivots(const Vector& x, double p) const override;
  /// The tangent of negativePivots().
  Sparse symmetricTangent(const Vector& x) const;
  std::string unknownName(int i) const override { return problem_.unknownName(i); }

  /// The static problem; its loads are those of p = GrowingLoad::contained.
  const StaticProblem& problem() const { return problem_; }

 private:
  StaticProblem problem_;  ///< problem of the path
  StaticProblem tangent_;  ///< the same with a symmetric Jacobian
  Vector load_, weights_;
  double contained_, scale_;
};

}  // namespace tooljoint::equilibrium
