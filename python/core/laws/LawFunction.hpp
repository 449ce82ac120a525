// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A function of Python that gives the forces of a point law, one call for a batch of points:
/// force(t, d, v, **parameters), and of a law with states force(t, d, v, x, **parameters) ->
/// (forces, rates). Arrays have one dimension if a point has one number, else points x numbers.
/// Needs no GIL.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "Arrays.hpp"
#include "Calls.hpp"
#include "model/laws/PointLaw.hpp"

namespace tooljoint::python {

using Values = std::vector<double>;

/// Functions of a law: `tangent`, `power` and `start` may be None.
struct LawFunctions {
  Kept force, tangent, power, start, parameters;
};

/// Positions, velocities and states of n points, point by point; `parts` of the three are given.
struct LawInput {
  double t;
  int n;
  std::array<Values, 3> at;
  int parts = 2;
};

/// Values of these points in `all`, `each` numbers per point.
Values gather(const std::vector<int>& points, int each, const double* all);
void scatter(const std::vector<int>& points, int each, const Values& some, double* all);

class LawFunction {
 public:
  LawFunction(const std::string& name, int width, int states, LawFunctions functions);

  int width() const { return width_; }
  int states() const { return states_; }
  const LawFunctions& functions() const { return functions_; }
  /// Begins messages: `The point law "A"`.
  const std::string& who() const { return who_; }

  LawInput input(double t, const std::vector<int>& points, const double* d, const double* v,
                 const double* x = nullptr) const;
  /// Passes new arrays, which the function may keep, and `more`. The GIL is held.
  py::object call(const Kept& function, const LawInput& input, const Values* more = nullptr) const;
  /// Forces and rates, n x width and n x states.
  std::array<Values, 2> operator()(const LawInput& input) const;
  /// Power by the function `power`. `more` as for call().
  model::PointLaw::Power power(const LawInput& input, const Values* more = nullptr) const;
  /// Central differences of second order, all of them in one call: of forces and rates by
  /// positions, velocities and states, each n x rows x columns.
  using Slopes = std::array<std::array<Values, 3>, 2>;
  Slopes differences(const LawInput& input) const;

 private:
  py::array array(Values values, int n, int each) const;
  int numbers(int input) const { return input < 2 ? width_ : states_; }

  std::string who_;
  int width_, states_;
  LawFunctions functions_;
};

}  // namespace tooljoint::python
