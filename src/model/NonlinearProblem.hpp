// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// r(x) = 0 with an analytic Jacobian, for the NOX drivers of src/statics.
#pragma once

#include <string>
#include <vector>

#include "common/RowRange.hpp"
#include "common/Types.hpp"

namespace tooljoint::model {

/// A square nonlinear problem. Implementations are evaluated on every rank alike.
class NonlinearProblem {
 public:
  virtual ~NonlinearProblem() = default;
  virtual int size() const = 0;
  /// r = residual(x); r has size() rows.
  virtual void residual(const Vector& x, Vector& r) const = 0;
  /// J = dr/dx. The pattern may not change between calls.
  virtual void jacobian(const Vector& x, Sparse& J) const = 0;
  /// Positive weight per row that makes forces and moments comparable: solvers use |scale .* r|.
  virtual Vector residualScale() const = 0;
  /// Largest factor in (0, 1] of the step dx from x (for example a cap on lateral motion). 1 by
  /// default.
  virtual double stepLimit(const Vector& /*x*/, const Vector& /*dx*/) const { return 1.0; }
  /// End of the step s dx from x: x + s dx, or a point that agrees with it to first order and stays
  /// clear of a curved stiff constraint.
  virtual Vector moved(const Vector& x, const Vector& dx, double s) const { return x + s * dx; }
  /// Name of an unknown for messages ("theta_z of node 17").
  virtual std::string unknownName(int i) const = 0;
};

/// A problem whose unknowns are ordered by nodes, each node coupled only to itself and its two
/// neighbours, and whose rows can be evaluated separately: solvers divide its work among ranks.
class ChainProblem : public NonlinearProblem {
 public:
  /// First unknown of each node with unknowns, and size() at the end; empty: cannot be divided.
  virtual std::vector<int> firstOfNodes() const = 0;
  /// These rows of residual(), bitwise equal; other rows of r, which has size() rows, are
  /// undefined.
  virtual void residualRows(const Vector& x, RowRange rows, Vector& r) const = 0;
  /// The pattern of jacobian() and its values in these rows; other values are undefined.
  virtual void jacobianRows(const Vector& x, RowRange rows, Sparse& J) const = 0;
};

/// A problem in the unknowns of another one, which must outlive it and provides size, scale, step
/// limit and names.
template <class Problem>
class InUnknownsOf : public Problem {
 public:
  explicit InUnknownsOf(const NonlinearProblem& other) : other_(other) {}
  int size() const override { return other_.size(); }
  Vector residualScale() const override { return other_.residualScale(); }
  double stepLimit(const Vector& x, const Vector& dx) const override {
    return other_.stepLimit(x, dx);
  }
  Vector moved(const Vector& x, const Vector& dx, double s) const override {
    return other_.moved(x, dx, s);
  }
  std::string unknownName(int i) const override { return other_.unknownName(i); }

 private:
  const NonlinearProblem& other_;
};

}  // namespace tooljoint::model
