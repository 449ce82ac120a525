// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// r(x, p) = 0 with one parameter p, for the continuation of src/statics.
#pragma once

#include <optional>
#include <string>

#include "common/Types.hpp"

namespace tooljoint::model {

/// A square nonlinear problem with a parameter. Implementations are evaluated on every rank alike.
class ParametricProblem {
 public:
  virtual ~ParametricProblem() = default;
  virtual int size() const = 0;
  /// r = residual(x, p); r has size() rows.
  virtual void residual(const Vector& x, double p, Vector& r) const = 0;
  /// J = dr/dx.
  virtual void jacobian(const Vector& x, double p, Sparse& J) const = 0;
  /// drdp = dr/dp; size() rows.
  virtual void parameterDerivative(const Vector& x, double p, Vector& drdp) const = 0;
  /// Positive weight per row: solvers use |scale .* r|.
  virtual Vector residualScale() const = 0;
  /// Non-negative weight a_i per unknown for the length of a path, ds^2 = sum_i a_i dx_i^2 +
  /// (dp/p_0)^2.
  virtual Vector pathWeights() const = 0;
  /// p_0, the change of the parameter that corresponds to a length of 1.
  virtual double parameterScale() const = 0;
  /// Number of negative eigenvalues of the tangent that decides about stability; empty: not known.
  virtual std::optional<int> negativePivots(const Vector& /*x*/, double /*p*/) const { return {}; }
  /// Name of an unknown for messages ("theta_z of node 17").
  virtual std::string unknownName(int i) const = 0;
};

}  // namespace tooljoint::model
