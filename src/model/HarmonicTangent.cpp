// SPDX-License-Identifier: BSD-3-Clause
#include "model/HarmonicTangent.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "common/Index.hpp"

namespace tooljoint::model {
namespace {

using RowsOut = Eigen::Map<Eigen::Matrix<Complex, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;

/// Tangents of all points of a law in its initial state at (d, v).
StateTangentArrays tangentsAtStart(const StatefulPointLaw& law, double t, const Vector& d,
                                   const Vector& v) {
  const auto points = at(law.size());
  std::vector<int> all(points);
  std::iota(all.begin(), all.end(), 0);
  std::vector<double> x(points * at(law.states())), f(points * at(law.width())),
      g(points * at(law.rated()));
  StateTangentArrays tangents(law);
  law.initialState(t, d.data(), v.data(), x.data());
  law.forcesWithTangents(t, all, d.data(), v.data(), x.data(), f.data(), g.data(),
                         tangents.write());
  return tangents;
}

/// d and v of a set at the start of the motion.
struct Place {
  Place(const SecondOrderModel& model, const PointSet& set)
      : d(set.offset + set.rows * model.initialDisplacement), v(set.rows * model.initialVelocity) {}
  Vector d, v;
};

/// Frequency [rad/s] at which the states of a set are evaluated: fast and slow states both have a
/// lag.
constexpr double lookedAt = 1.0;
/// Smallest part of the tangent that is not rounding.
constexpr double rounding = 1e-12;

bool isUnknown(const StatefulPointLaw& law, double t, const Place& place) {
  for (int p = 0; p < law.size(); ++p)
    if (!law.heldFactor(t, Complex(0.0, lookedAt), p, place.d.data(), place.v.data())) return true;
  return false;
}

bool moves(const StatefulPointLaw& law, double t, const Place& place) {
  const auto change = tangentByStates(law, t, place.d, place.v, lookedAt);
  const auto held = tangentsAtStart(law, t, place.d, place.v);
  double largest = 0, whole = 0;
  for (const auto& entry : change) largest = std::max(largest, std::abs(entry));
  for (int p = 0; p < law.size(); ++p)
    whole =
        std::max({whole, held.of(p).fd.cwiseAbs().maxCoeff(), held.of(p).fv.cwiseAbs().maxCoeff()});
  return largest > rounding * whole;
}

}  // namespace

std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, double omega) {
  return tangentByStates(law, t, d, v, Complex(0.0, std::max(omega, slowestOmega)));
}

std::vector<Complex> tangentByStates(const StatefulPointLaw& law, double t, const Vector& d,
                                     const Vector& v, Complex s) {
  const auto all = tangentsAtStart(law, t, d, v);
  const int w = law.width(), r = law.rated();
  std::vector<Complex> change(at(law.size() * w * w));
  for (int p = 0; p < law.size(); ++p) {
    RowsOut sum(&change[at(p * w * w)], w, w);
    const auto held = law.heldFactor(t, s, p, d.data(), v.data());
    const auto own = all.of(p);
    sum = (held.value_or(1.0) - 1.0) * own.fd.cast<Complex>();
    if (r == 0) continue;
    ComplexMatrix follows = -own.gx.cast<Complex>();
    follows.diagonal().array() += s;
    const ComplexMatrix moved = own.gd.cast<Complex>() + s * own.gv.cast<Complex>();
    sum += own.fx.cast<Complex>() * follows.fullPivLu().solve(moved);
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
