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
  std::vector<double> g(product(size(), rated())), fx(product(size(), width() * rated())),
      gd = fx, gv = fx, gx(product(size(), rated() * rated()));
  forcesWithTangents(t, active, d, v, x.data(), f, g.data(),
                     {dfdd, dfdv, fx.data(), gd.data(), gv.data(), gx.data()});
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

}  // namespace tooljoint::model
