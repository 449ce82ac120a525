// SPDX-License-Identifier: BSD-3-Clause
#include "laws/PythonLaw.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <pybind11/stl.h>

#include "Arrays.hpp"
#include "common/Index.hpp"

namespace tooljoint::python {

namespace {

void scatter(const std::vector<int>& points, int each, const std::vector<double>& some,
             double* all) {
  for (std::size_t i = 0; i < points.size(); ++i)
    std::copy_n(some.data() + i * at(each), each, all + points[i] * each);
}

/// Places and weights of Gauss's rule with 16 points on [0, 1].
std::array<std::vector<double>, 2> gaussRule() {
  using Values = std::vector<double>;
  std::array<Values, 2> rule;
  const py::gil_scoped_acquire gil;
  const auto numpy = py::module_::import("numpy.polynomial.legendre");
  const auto both = numpy.attr("leggauss")(16).cast<std::pair<Values, Values>>();
  for (const double x : both.first) rule[0].push_back((1 + x) / 2);
  for (const double w : both.second) rule[1].push_back(w / 2);
  return rule;
}

}  // namespace

void PythonLaw::evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                         double* f) const {
  scatter(active, width_, force(t, gather(active, d), gather(active, v), sizeOf(active)), f);
}

void PythonLaw::evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                                    const double* v, double* f, double* dfdd, double* dfdv) const {
  evaluate(t, active, d, v, f);
  const auto place = gather(active, d), velocity = gather(active, v);
  Values slopes[2];
  if ((*functions_.tangent).is_none())
    differences(t, place, velocity, sizeOf(active), slopes);
  else
    givenSlopes(t, place, velocity, sizeOf(active), slopes);
  scatter(active, width_ * width_, slopes[0], dfdd);
  scatter(active, width_ * width_, slopes[1], dfdv);
}

void PythonLaw::clearanceLeft(const std::vector<int>& points, const double*, double* gap) const {
  for (int p : points) gap[p] = 0.0;
}

model::PointLaw::Power PythonLaw::power(double t, const std::vector<int>& points, const double* d,
                                        const double* v) const {
  constexpr double instant = 1e-6;  // [s]: for dV/dt, below what a motion resolves
  const auto place = gather(points, d), velocity = gather(points, v);
  const int n = sizeOf(points);
  if (!(*functions_.power).is_none()) return givenPower(t, place, velocity, n);
  Power sum;
  sum.stored = potential(t, place, n);
  sum.drive = (potential(t + instant, place, n) - potential(t - instant, place, n)) / (2 * instant);
  const auto moving = force(t, place, velocity, n);
  const auto still = force(t, place, Values(place.size(), 0.0), n);
  for (std::size_t i = 0; i < moving.size(); ++i)
    sum.damping -= (moving[i] - still[i]) * velocity[i];
  return sum;
}

std::vector<model::Channel> PythonLaw::channels() const {
  return {{"force", "N", "Force along the first coordinate"}};
}

void PythonLaw::record(double t, const double* d, const double* v, double* out) const {
  const auto count = at(points_) * at(width_);
  const auto f = force(t, {d, d + count}, {v, v + count}, points_);
  for (int p = 0; p < points_; ++p) out[p] = f[at(p * width_)];
}

std::shared_ptr<const model::PointLaw> PythonLaw::subset(const std::vector<int>& points) const {
  return std::make_shared<PythonLaw>(name_, sizeOf(points), width_, functions_);
}

PythonLaw::Values PythonLaw::gather(const std::vector<int>& points, const double* all) const {
  Values some;
  some.reserve(points.size() * at(width_));
  for (int p : points) some.insert(some.end(), all + p * width_, all + (p + 1) * width_);
  return some;
}

/// With arrays of their own, which the function may keep.
py::object PythonLaw::call(const Kept& function, double t, const Values& d, const Values& v,
                           int n) const {
  const auto parameters = py::reinterpret_borrow<py::dict>(*functions_.parameters);
  std::vector<py::ssize_t> shape{n};
  if (width_ > 1) shape.push_back(width_);
  return (*function)(t, toNumpy(d, shape), toNumpy(v, shape), **parameters);
}

PythonLaw::Values PythonLaw::force(double t, const Values& d, const Values& v, int n) const {
  Values f(d.size());
  fromPython(who(),
             [&] { copyInto(call(functions_.force, t, d, v, n), n, width_, f.data(), who()); });
  return f;
}

model::PointLaw::Power PythonLaw::givenPower(double t, const Values& d, const Values& v,
                                             int n) const {
  Power sum;
  fromPython(who(), [&] {
    const auto values = call(functions_.power, t, d, v, n).cast<Values>();
    double* const parts[] = {&sum.stored, &sum.damping, &sum.friction, &sum.drive};
    for (std::size_t i = 0; i < std::min<std::size_t>(values.size(), 4); ++i) *parts[i] = values[i];
  });
  return sum;
}

/// V of all points; where a wall is on the way to 0.2 % of what its force would store from d = 0
/// on.
double PythonLaw::potential(double t, const Values& d, int n) const {
  static const auto* rule = new std::array<Values, 2>(gaussRule());
  const auto& [places, weights] = *rule;
  Values along;
  for (const double s : places)
    for (const double x : d) along.push_back(s * x);
  const auto f = force(t, along, Values(along.size(), 0.0), n * sizeOf(places));
  double work = 0.0;
  for (std::size_t k = 0; k < places.size(); ++k)
    for (std::size_t i = 0; i < d.size(); ++i) work += weights[k] * f[k * d.size() + i] * d[i];
  return -work;
}

void PythonLaw::givenSlopes(double t, const Values& d, const Values& v, int n,
                            Values* slopes) const {
  fromPython(who(), [&] {
    const auto both =
        call(functions_.tangent, t, d, v, n).cast<std::pair<py::object, py::object>>();
    const py::object arrays[] = {both.first, both.second};
    const int square = width_ * width_;
    for (int k = 0; k < 2; ++k) {
      slopes[k].resize(at(n * square));
      const auto rows =
          py::module_::import("numpy").attr("reshape")(arrays[k], py::make_tuple(n, square));
      copyInto(rows, n, square, slopes[k].data(), who());
    }
  });
}

/// Central differences of second order, all of them in one call.
void PythonLaw::differences(double t, const Values& d, const Values& v, int n,
                            Values* slopes) const {
  static const double relative = std::cbrt(std::numeric_limits<double>::epsilon());
  constexpr double least = 1e-9;  // [m, m/s]: below what a law resolves
  Values manyD, manyV, steps;
  for (int k = 0; k < 2 * width_; ++k)
    for (const double sign : {1.0, -1.0}) {
      Values moved[] = {d, v};
      for (int p = 0; p < n; ++p) {
        double& x = moved[k / width_][at(p * width_ + k % width_)];
        const double h = std::max(relative * std::abs(x), least);
        if (sign > 0) steps.push_back(h);
        x += sign * h;
      }
      manyD.insert(manyD.end(), moved[0].begin(), moved[0].end());
      manyV.insert(manyV.end(), moved[1].begin(), moved[1].end());
    }
  const Values f = force(t, manyD, manyV, 4 * width_ * n);
  for (int k = 0; k < 2 * width_; ++k) {
    Values& slope = slopes[k / width_];
    slope.resize(at(n * width_ * width_));
    for (int p = 0; p < n; ++p)
      for (int row = 0; row < width_; ++row) {
        const auto value = [&](int side) { return f[at(((2 * k + side) * n + p) * width_ + row)]; };
        slope[at((p * width_ + row) * width_ + k % width_)] =
            (value(0) - value(1)) / (2 * steps[at(k * n + p)]);
      }
  }
}

}  // namespace tooljoint::python
