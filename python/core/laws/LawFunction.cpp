// SPDX-License-Identifier: BSD-3-Clause
#include "laws/LawFunction.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <pybind11/stl.h>
#include <utility>

#include "common/Index.hpp"

namespace tooljoint::python {

Values gather(const std::vector<int>& points, int each, const double* all) {
  Values some;
  some.reserve(points.size() * at(each));
  for (int p : points) some.insert(some.end(), all + p * each, all + (p + 1) * each);
  return some;
}

void scatter(const std::vector<int>& points, int each, const Values& some, double* all) {
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy_n(some.data() + i * at(each), each, all + points[i] * each);
}

LawFunction::LawFunction(const std::string& name, int width, int states, LawFunctions functions)
    : who_("The point law \"" + name + "\""),
      width_(width),
      states_(states),
      functions_(std::move(functions)) {}

LawInput LawFunction::input(double t, const std::vector<int>& points, const double* d,
                            const double* v, const double* x) const {
  return {t,
          sizeOf(points),
          {gather(points, width_, d), gather(points, width_, v),
           x != nullptr ? gather(points, states_, x) : Values()},
          x != nullptr ? 3 : 2};
}

py::array LawFunction::array(Values values, int n, int each) const {
  std::vector<py::ssize_t> shape{n};
  if (each > 1) shape.push_back(each);
  return toNumpy(std::move(values), std::move(shape));
}

py::object LawFunction::call(const Kept& function, const LawInput& input,
                             const Values* more) const {
  py::list arguments;
  arguments.append(input.t);
  for (int k = 0; k < input.parts; ++k)
    arguments.append(array(input.at[at(k)], input.n, numbers(k)));
  if (more != nullptr) arguments.append(array(*more, input.n, states_));
  const auto parameters = py::reinterpret_borrow<py::dict>(*functions_.parameters);
  return (*function)(*arguments, **parameters);
}

std::array<Values, 2> LawFunction::operator()(const LawInput& input) const {
  std::array<Values, 2> out{Values(at(input.n * width_)), Values(at(input.n * states_))};
  fromPython(who_, [&] {
    const py::object found = call(functions_.force, input);
    if (states_ == 0) return copyInto(found, input.n, width_, out[0].data(), who_);
    if (!py::isinstance<py::tuple>(found) || py::len(found) != 2)
      throw ModelError(who_ + " has states: return a pair, forces and rates of the states.");
    const auto both = py::reinterpret_borrow<py::tuple>(found);
    copyInto(both[0], input.n, width_, out[0].data(), who_);
    copyInto(both[1], input.n, states_, out[1].data(), who_);
  });
  return out;
}

model::PointLaw::Power LawFunction::power(const LawInput& input, const Values* more) const {
  model::PointLaw::Power sum;
  fromPython(who_, [&] {
    const auto values = call(functions_.power, input, more).cast<Values>();
    double* const parts[] = {&sum.stored, &sum.damping, &sum.friction, &sum.drive};
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 4); ++i) *parts[i] = values[i];
  });
  return sum;
}

LawFunction::Slopes LawFunction::differences(const LawInput& input) const {
  static const double relative = std::cbrt(std::numeric_limits<double>::epsilon());
  constexpr double least = 1e-9;  // [m, m/s, unit of a state]: below the resolution of laws
  const int columns = 2 * width_ + states_;
  // all inputs once for each column, up and then down
  LawInput many{input.t, 2 * columns * input.n, {}, input.parts};
  Values steps;
  for (int k = 0; k < 3; ++k)
    for (int column = 0; column < numbers(k); ++column)
      for (const double sign : {1.0, -1.0}) {
        auto moved = input.at;
        for (int p = 0; p < input.n; ++p) {
          double& x = moved[at(k)][at(p * numbers(k) + column)];
          const double h = std::max(relative * std::abs(x), least);
          if (sign > 0) steps.push_back(h);
          x += sign * h;
        }
        for (std::size_t each = 0; each < moved.size(); ++each)
          many.at[each].insert(many.at[each].end(), moved[each].begin(), moved[each].end());
      }
  const auto found = (*this)(many);
  Slopes slopes;
  for (int out = 0; out < 2; ++out) {
    const int rows = out == 0 ? width_ : states_;
    for (int k = 0, first = 0; k < 3; first += numbers(k++)) {
      Values& slope = slopes[at(out)][at(k)];
      slope.resize(at(input.n * rows * numbers(k)));
      for (int column = 0; column < numbers(k); ++column)
        for (int p = 0; p < input.n; ++p)
          for (int row = 0; row < rows; ++row) {
            const int number = first + column;
            const auto value = [&](int side) {
              return found[at(out)][at(((2 * number + side) * input.n + p) * rows + row)];
            };
            slope[at((p * rows + row) * numbers(k) + column)] =
                (value(0) - value(1)) / (2 * steps[at(number * input.n + p)]);
          }
    }
  }
  return slopes;
}

}  // namespace tooljoint::python
