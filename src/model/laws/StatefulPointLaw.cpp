// SPDX-License-Identifier: BSD-3-Clause
#include "model/laws/StatefulPointLaw.hpp"

#include <vector>

namespace tooljoint::model {
namespace {

std::size_t product(int a, int b) {
  return static_cast<std::size_t>(a) * static_cast<std::size_t>(b);
}

std::vector<double> initially(const StatefulPointLaw& law, double t, const double* d,
                              const double* v) {
  std::vector<double> x(product(law.size(), law.states()));
  law.initialState(t, d, v, x.data());
  return x;
}

}  // namespace

void StatefulPointLaw::evaluate(double t, const std::vector<int>& active, const double* d,
                                const double* v, double* f) const {
  const auto x = initially(*this, t, d, v);
  std::vector<double> g(product(size(), rated()));
  forces(t, active, d, v, x.data(), f, g.data());
}

void StatefulPointLaw::evaluateWithTangent(double t, const std::vector<int>& active,
                                           const double* d, const double* v, double* f,
                                           double* dfdd, double* dfdv) const {
  const auto x = initially(*this, t, d, v);
  std::vector<double> g(product(size(), rated()));
  StateTangentArrays arrays(*this);
  auto tangents = arrays.write();
  tangents.fd = dfdd;
  tangents.fv = dfdv;
  forcesWithTangents(t, active, d, v, x.data(), f, g.data(), tangents);
}

PointLaw::Power StatefulPointLaw::power(double t, const std::vector<int>& points, const double* d,
                                        const double* v) const {
  const auto x = initially(*this, t, d, v);
  return powers(t, points, d, v, x.data(), std::vector<double>(x.size()).data());
}

void StatefulPointLaw::record(double t, const double* d, const double* v, double* out) const {
  recordState(t, d, v, initially(*this, t, d, v).data(), out);
}

void StatefulPointLaw::clearanceLeft(const std::vector<int>& points, const double*,
                                     double* gap) const {
  for (int p : points) gap[p] = 0.0;
}

StateTangentArrays::StateTangentArrays(int points, int width, int rated)
    : width_(width),
      rated_(rated),
      fd_(product(points, width * width)),
      fv_(fd_.size()),
      fx_(product(points, width * rated)),
      gd_(fx_.size()),
      gv_(fx_.size()),
      gx_(product(points, rated * rated)) {}

StateTangentArrays::OfPoint StateTangentArrays::of(int point) const {
  const auto rows = [&](const std::vector<double>& all, int n, int m) {
    return Rows(all.data() + point * n * m, n, m);
  };
  return {rows(fd_, width_, width_), rows(fv_, width_, width_), rows(fx_, width_, rated_),
          rows(gd_, rated_, width_), rows(gv_, rated_, width_), rows(gx_, rated_, rated_)};
}

StateTangents StateTangentArrays::write() {
  return {fd_.data(), fv_.data(), fx_.data(), gd_.data(), gv_.data(), gx_.data()};
}

}  // namespace tooljoint::model
