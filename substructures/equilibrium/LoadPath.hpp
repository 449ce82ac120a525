// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The static equilibrium under a load that grows, as the continuation of src/statics follows it.
#pragma once

#include <optional>
#include <string>

#include "model/ParametricProblem.hpp"
#include "substructures/equilibrium/StaticProblem.hpp"

namespace tooljoint::equilibrium {

/// Of K_pa + K_gpo(D) with closed contacts as springs and without friction, D at all dofs; none
/// where it is almost singular.
std::optional<int> negativePivots(const StaticInput& input, const Vector& displacement);

/// A load p l, and how the length of a path is measured. Vectors have 6 entries per node.
struct GrowingLoad {
  Vector direction;        ///< l, load of p = 1 [N, N m]
  double contained = 0.0;  ///< p whose load is part of StaticInput::load
  double scale = 1.0;      ///< p_0 of model::ParametricProblem
  Vector pathWeights;      ///< a_i of model::ParametricProblem
};

/// r(D, p) = (K_pa + K_gpo(D)) D - F_s - (p - p_F) l - F_cs(D) - R_ipa on the free dofs, without
/// friction and with walls that only push; p_F l is part of F_s.
class LoadPath : public model::ParametricProblem {
 public:
  /// `input` must outlive the object. Errors as StaticProblem; ModelError: the load acts on held
  /// dofs alone.
  LoadPath(const StaticInput& input, const GrowingLoad& load);

  int size() const override { return problem_.size(); }
  void residual(const Vector& x, double p, Vector& r) const override;
  void jacobian(const Vector& x, double p, Sparse& J) const override;
  /// -l.
  void parameterDerivative(const Vector& x, double p, Vector& drdp) const override;
  Vector residualScale() const override { return problem_.residualScale(); }
  Vector pathWeights() const override { return weights_; }
  double parameterScale() const override { return scale_; }
  /// Of K_pa + K_gpo(D) with closed contacts as springs: axial force and torque held, since they do
  /// not depend on the deflection.
  std::optional<int> negativePivots(const Vector& x, double p) const override;
  /// That tangent.
  Sparse symmetricTangent(const Vector& x) const;
  std::string unknownName(int i) const override { return problem_.unknownName(i); }

  /// The static problem; its loads are those of p = GrowingLoad::contained.
  const StaticProblem& problem() const { return problem_; }

 private:
  StaticProblem problem_;  ///< of the path
  StaticProblem tangent_;  ///< with a symmetric Jacobian
  Vector load_, weights_;
  double contained_, scale_;
};

}  // namespace tooljoint::equilibrium
