// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// r(x) = 0 with an analytic Jacobian, as handed to the NOX drivers of src/statics.
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
  /// Positive weight per row that makes forces and moments comparable: solvers measure |scale .*
  /// r|.
  virtual Vector residualScale() const = 0;
  /// Largest factor in (0, 1] by which the step dx may be taken from x (a cap on lateral motion,
  /// say). 1 by default.
  virtual double stepLimit(const Vector& /*x*/, const Vector& /*dx*/) const { return 1.0; }
  /// Where the step s dx from x leads: x + s dx, or what agrees with it to first order and keeps
  /// clear of a curved stiff constraint.
  virtual Vector moved(const Vector& x, const Vector& dx, double s) const { return x + s * dx; }
  /// Name of an unknown for messages ("theta_z of node 17").
  virtual std::string unknownName(int i) const = 0;
};

/// A problem whose unknowns stand node by node, those of a node coupled to that node and to the two
/// beside it only, and whose rows can be evaluated apart: solvers divide its work among ranks.
class ChainProblem : public NonlinearProblem {
 public:
  /// First unknown of each node that has any, and size() at the end; empty: cannot be divided.
  virtual std::vector<int> firstOfNodes() const = 0;
  /// These rows of residual(), bit by bit; what stands in other rows of r, which has size() rows,
  /// is of no use.
  virtual void residualRows(const Vector& x, RowRange rows, Vector& r) const = 0;
  /// The pattern of jacobian() and its values in these rows; others are of no use.
  virtual void jacobianRows(const Vector& x, RowRange rows, Sparse& J) const = 0;
};

/// A problem in the unknowns of another one, which must outlive it: what is said of unknowns is
/// said by that one.
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
