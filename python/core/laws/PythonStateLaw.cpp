// SPDX-License-Identifier: BSD-3-Clause
#include "laws/PythonStateLaw.hpp"

#include <algorithm>
#include <numeric>

#include "Arrays.hpp"
#include "common/Index.hpp"

namespace tooljoint::python {

std::vector<int> PythonStateLaw::all() const {
  std::vector<int> points(at(points_));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

void PythonStateLaw::initialState(double t, const double* d, const double* v, double* x) const {
  const auto& start = function_.functions().start;
  std::fill_n(x, points_ * states(), 0.0);
  if ((*start).is_none()) return;
  fromPython(function_.who(), [&] {
    const auto found = function_.call(start, function_.input(t, all(), d, v));
    copyInto(found, points_, states(), x, function_.who());
  });
}

void PythonStateLaw::forces(double t, const std::vector<int>& points, const double* d,
                            const double* v, const double* x, double* f, double* g) const {
  const auto found = function_(function_.input(t, points, d, v, x));
  scatter(points, width(), found[0], f);
  scatter(points, states(), found[1], g);
}

void PythonStateLaw::forcesWithTangents(double t, const std::vector<int>& points, const double* d,
                                        const double* v, const double* x, double* f, double* g,
                                        const model::StateTangents& tangents) const {
  forces(t, points, d, v, x, f, g);
  const auto slopes = function_.differences(function_.input(t, points, d, v, x));
  double* const to[2][3] = {{tangents.fd, tangents.fv, tangents.fx},
                            {tangents.gd, tangents.gv, tangents.gx}};
  const int rows[] = {width(), states()}, columns[] = {width(), width(), states()};
  for (int out = 0; out < 2; ++out)
    for (int in = 0; in < 3; ++in)
      scatter(points, rows[out] * columns[in], slopes[at(out)][at(in)], to[out][in]);
}

model::PointLaw::Power PythonStateLaw::powers(double t, const std::vector<int>& points,
                                              const double* d, const double* v, const double* x,
                                              const double* xDot) const {
  const auto input = function_.input(t, points, d, v, x);
  if (!(*function_.functions().power).is_none()) {
    const Values rates = gather(points, states(), xDot);
    return function_.power(input, &rates);
  }
  const Values f = function_(input)[0], &velocity = input.at[1];
  return {0.0, -std::inner_product(f.begin(), f.end(), velocity.begin(), 0.0)};
}

std::vector<model::Channel> PythonStateLaw::channels() const {
  return {{"force", "N", "Force along the first coordinate"}};
}

void PythonStateLaw::recordState(double t, const double* d, const double* v, const double* x,
                                 double* out) const {
  const Values f = function_(function_.input(t, all(), d, v, x))[0];
  for (int p = 0; p < points_; ++p) out[p] = f[at(p * width())];
}

std::shared_ptr<const model::PointLaw> PythonStateLaw::subset(
    const std::vector<int>& points) const {
  return std::make_shared<PythonStateLaw>(sizeOf(points), function_);
}

}  // namespace tooljoint::python
