// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A point law with states x' = g(t, d, v, x) whose forces and rates are a function of Python.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "laws/LawFunction.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::python {

/// (f, g) of LawFunction. All states are rated; none is held.
class PythonStateLaw final : public model::StatefulPointLaw {
 public:
  PythonStateLaw(int points, LawFunction function)
      : points_(points), function_(std::move(function)) {}

  int size() const override { return points_; }
  int width() const override { return function_.width(); }
  int states() const override { return function_.states(); }
  int rated() const override { return function_.states(); }
  /// By the function `start`; 0 without it.
  void initialState(double t, const double* d, const double* v, double* x) const override;
  void forces(double t, const std::vector<int>& points, const double* d, const double* v,
              const double* x, double* f, double* g) const override;
  /// By central differences.
  void forcesWithTangents(double t, const std::vector<int>& points, const double* d,
                          const double* v, const double* x, double* f, double* g,
                          const model::StateTangents& tangents) const override;
  /// By the function `power`, which gets xDot after the states. Without it no energy is stored, and
  /// all work of the forces is damping.
  Power powers(double t, const std::vector<int>& points, const double* d, const double* v,
               const double* x, const double* xDot) const override;
  std::vector<model::Channel> channels() const override;
  void recordState(double t, const double* d, const double* v, const double* x,
                   double* out) const override;
  std::shared_ptr<const model::PointLaw> subset(const std::vector<int>& points) const override;

 private:
  std::vector<int> all() const;

  int points_;
  LawFunction function_;
};

}  // namespace tooljoint::python
