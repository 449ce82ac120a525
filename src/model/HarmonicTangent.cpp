// SPDX-License-Identifier: BSD-3-Clause
#include "model/HarmonicTangent.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Index.hpp"

namespace tooljoint::model {
namespace {

using Rows =
    Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
using RowsOut = Eigen::Map<Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// Tangents of all points of a law in its initial state at (d, v).
struct Tangents {
  Tangents(const StatefulPointLaw& law, double t, const Vector& d, const Vector& v) {
    const auto points = at(law.size()), w = at(law.width()), r = at(law.rated());
    std::vector<int> all(points);
    std::iota(all.begin(), all.end(), 0);
    std::vector<double> x(points * at(law.states())), f(points * w), g(points * r);
    for (auto* own : {&fd, &fv}) own->assign(points * w * w, 0.0);
    for (auto* own : {&fx, &gd, &gv}) own->assign(points * w * r, 0.0);
    gx.assign(points * r * r, 0.0);
    law.initialState(t, d.data(), v.data(), x.data());
    law.forcesWithTangents(t, all, d.data(), v.data(), x.data(), f.data(), g.data(),
                           {fd.data(), fv.data(), fx.data(), gd.data(), gv.data(), gx.data()});
  }
  std::vector<double> fd, fv, fx, gd, gv, gx;
};

/// d and v of a set at the start of the motion.
struct Place {
  Place(const SecondOrderModel& model, const PointSet& set)
      : d(set.offset + set.rows * model.initialDisplacement), v(set.rows * model.initialVelocity) {}
  Vector d, v;
};

/// At this frequency [rad/s] the states of a set are looked at: neither a fast nor a slow one
/// follows it without a lag.
constexpr double lookedAt = 1.0;
/// Smallest share of the tangent that is no rounding.
constexpr double rounding = 1e-12;

bool isUnknown(const StatefulPointLaw& law, double t, const Place& place) {
  for (int p = 0; p < law.size(); ++p)
    if (!law.heldFactor(t, lookedAt, p, place.d.data(), place.v.data())) return true;
  return false;
}

bool moves(const StatefulPointLaw& law, double t, const Place& place) {
  const auto change = tangentByStates(law, t, place.d, place.v, lookedAt);
  const Tangents held(law, t, place.d, place.v);
  double largest = 0, whole = 0;
  for (const auto& entry : change) largest = std::max(largest, std::abs(entry));
  for (const auto* part : {&held.fd, &held.fv})
    for (const double entry : *part) whole = std::max(whole, std::abs(entry));
  return largest > rounding * whole;
}

}  // namespace

std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, double omega) {
  const Tangents all(law, t, d, v);
  const int w = law.width(), r = law.rated();
  const Complex s(0.0, std::max(omega, slowestOmega));
  std::vector<Complex> change(at(law.size() * w * w));
  for (int p = 0; p < law.size(); ++p) {
    RowsOut sum(&change[at(p * w * w)], w, w);
    const auto held = law.heldFactor(t, s.imag(), p, d.data(), v.data());
    sum = (held.value_or(1.0) - 1.0) * Rows(&all.fd[at(p * w * w)], w, w).cast<Complex>();
    if (r == 0) continue;
    ComplexMatrix follows = -Rows(&all.gx[at(p * r * r)], r, r).cast<Complex>();
    follows.diagonal().array() += s;
    const ComplexMatrix moved = Rows(&all.gd[at(p * r * w)], r, w).cast<Complex>() +
                                s * Rows(&all.gv[at(p * r * w)], r, w).cast<Complex>();
    sum += Rows(&all.fx[at(p * w * r)], w, r).cast<Complex>() * follows.fullPivLu().solve(moved);
  }
  return change;
}

std::vector<std::string> setsWithMovingStates(const SecondOrderModel& model, double t) {
  std::vector<std::string> names;
  for (const auto& set : model.points)
    if (const auto* law = stateful(*set.law); law != nullptr && law->states() > 0) {
      const Place place(model, set);
      if (isUnknown(*law, t, place) || moves(*law, t, place)) names.push_back(set.name);
    }
  return names;
}

std::vector<std::string> setsWithUnknownStates(const SecondOrderModel& model, double t) {
  std::vector<std::string> names;
  for (const auto& set : model.points)
    if (const auto* law = stateful(*set.law); law != nullptr && law->states() > 0)
      if (isUnknown(*law, t, Place(model, set))) names.push_back(set.name);
  return names;
}

}  // namespace tooljoint::model
