// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A point law whose force is a function of Python.
#pragma once

#include <memory>
#include <pybind11/pybind11.h>
#include <string>
#include <utility>
#include <vector>

#include "Calls.hpp"
#include "model/laws/PointLaw.hpp"

namespace tooljoint::python {

/// force(t, d, v, **parameters); tangent and power likewise, or None.
struct LawFunctions {
  Kept force, tangent, power, parameters;
};

/// f(t, d, v) as a function of Python, one call for a batch of points. With width 1 its arrays have
/// one dimension, else points x width. Needs no GIL.
class PythonLaw final : public model::PointLaw {
 public:
  PythonLaw(std::string name, int points, int width, LawFunctions functions)
      : name_(std::move(name)), points_(points), width_(width), functions_(std::move(functions)) {}

  int size() const override { return points_; }
  int width() const override { return width_; }
  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const override;
  /// By the function `tangent`, or by central differences.
  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const override;
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override;
  /// By the function `power`. Without it the force at rest has a potential, V(t, d) =
  /// -int_0^1 f(t, s d, 0) d ds, of which dV/dt at fixed d is fed in; what else velocities add to
  /// the force is damping.
  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const override;
  std::vector<model::Channel> channels() const override;
  void record(double t, const double* d, const double* v, double* out) const override;
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override;

 private:
  using Values = std::vector<double>;
  std::string who() const { return "The point law \"" + name_ + "\""; }
  Values gather(const std::vector<int>& points, const double* all) const;
  pybind11::object call(const Kept& function, double t, const Values& d, const Values& v,
                        int n) const;
  Values force(double t, const Values& d, const Values& v, int n) const;
  double potential(double t, const Values& d, int n) const;
  Power givenPower(double t, const Values& d, const Values& v, int n) const;
  /// (df/dd, df/dv), each points x width x width.
  void givenSlopes(double t, const Values& d, const Values& v, int n, Values* slopes) const;
  void differences(double t, const Values& d, const Values& v, int n, Values* slopes) const;

  std::string name_;
  int points_, width_;
  LawFunctions functions_;
};

}  // namespace tooljoint::python
