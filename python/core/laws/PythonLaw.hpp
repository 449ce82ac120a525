// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A point law without states whose force is a function of Python.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "laws/LawFunction.hpp"
#include "model/laws/PointLaw.hpp"

namespace tooljoint::python {

/// f(t, d, v) of LawFunction.
class PythonLaw final : public model::PointLaw {
 public:
  PythonLaw(int points, LawFunction function) : points_(points), function_(std::move(function)) {}

  int size() const override { return points_; }
  int width() const override { return function_.width(); }
  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override;
  /// By the function `tangent`, or by central differences.
  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override;
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override;
  /// By the function `power`. Without it the force at rest has a potential, V(t, d) =
  /// -int_0^1 f(t, s d, 0) d ds, whose dV/dt at fixed d is supplied power; the part of the force
  /// that depends on velocities is damping.
  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const override;
  std::vector<model::Channel> channels() const override;
  void record(double t, const double* d, const double* v, double* out) const override;
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override;

 private:
  Values force(double t, Values d, Values v, int n) const;
  double potential(double t, const Values& d, int n) const;
  /// (df/dd, df/dv), each points x width x width.
  std::array<Values, 2> givenSlopes(const LawInput& input) const;

  int points_;
  LawFunction function_;
};

}  // namespace tooljoint::python
