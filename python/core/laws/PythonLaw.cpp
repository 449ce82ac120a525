// SPDX-License-Identifier: BSD-3-Clause
#include "laws/PythonLaw.hpp"

#include <array>
#include <pybind11/stl.h>
#include <string>

#include "Arrays.hpp"
#include "common/Index.hpp"

namespace tooljoint::python {

namespace {

/// Places and weights of Gauss's rule with 16 points on [0, 1].
std::array<Values, 2> gaussRule() {
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
  scatter(active, width(), function_(function_.input(t, active, d, v))[0], f);
}

void PythonLaw::evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                                    const double* v, double* f, double* dfdd, double* dfdv) const {
  evaluate(t, active, d, v, f);
  const auto input = function_.input(t, active, d, v);
  std::array<Values, 2> slopes;
  if ((*function_.functions().tangent).is_none()) {
    auto all = function_.differences(input);
    slopes = {std::move(all[0][0]), std::move(all[0][1])};
  } else {
    slopes = givenSlopes(input);
  }
  scatter(active, width() * width(), slopes[0], dfdd);
  scatter(active, width() * width(), slopes[1], dfdv);
}

void PythonLaw::clearanceLeft(const std::vector<int>& points, const double*, double* gap) const {
  for (int p : points) gap[p] = 0.0;
}

model::PointLaw::Power PythonLaw::power(double t, const std::vector<int>& points, const double* d,
                                        const double* v) const {
  constexpr double instant = 1e-6;  // [s]: for dV/dt, below the resolution of a motion
  const auto input = function_.input(t, points, d, v);
  if (!(*function_.functions().power).is_none()) return function_.power(input);
  const auto& [place, velocity, none] = input.at;
  Power sum;
  sum.stored = potential(t, place, input.n);
  sum.drive = (potential(t + instant, place, input.n) - potential(t - instant, place, input.n)) /
              (2 * instant);
  const auto moving = force(t, place, velocity, input.n);
  const auto still = force(t, place, Values(place.size(), 0.0), input.n);
  for (std::size_t i = 0; i < moving.size(); ++i)
    sum.damping -= (moving[i] - still[i]) * velocity[i];
  return sum;
}

std::vector<model::Channel> PythonLaw::channels() const {
  return {{"force", "N", "Force along the first coordinate"}};
}

void PythonLaw::record(double t, const double* d, const double* v, double* out) const {
  const auto count = at(points_) * at(width());
  const auto f = force(t, {d, d + count}, {v, v + count}, points_);
  for (int p = 0; p < points_; ++p) out[p] = f[at(p * width())];
}

std::shared_ptr<const model::PointLaw> PythonLaw::subset(const std::vector<int>& points) const {
  return std::make_shared<PythonLaw>(sizeOf(points), function_);
}

Values PythonLaw::force(double t, Values d, Values v, int n) const {
  return function_(LawInput{t, n, {std::move(d), std::move(v), {}}})[0];
}

/// V of all points; with a wall on the path, accurate to 0.2 % of the energy of its force from d =
/// 0 on.
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

std::array<Values, 2> PythonLaw::givenSlopes(const LawInput& input) const {
  std::array<Values, 2> slopes;
  const std::string& who = function_.who();
  fromPython(who, [&] {
    const auto both = function_.call(function_.functions().tangent, input)
                          .cast<std::pair<py::object, py::object>>();
    const py::object arrays[] = {both.first, both.second};
    const int square = width() * width();
    for (int k = 0; k < 2; ++k) {
      slopes[at(k)].resize(at(input.n * square));
      const auto rows =
          py::module_::import("numpy").attr("reshape")(arrays[k], py::make_tuple(input.n, square));
      copyInto(rows, input.n, square, slopes[at(k)].data(), who);
    }
  });
  return slopes;
}

}  // namespace tooljoint::python
