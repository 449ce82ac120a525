// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Point laws with internal state: rate-dependent springs, plastic links, bristle friction, cutting
/// forces that depend on earlier motion.
///
/// A state belongs to the motion and not to the law. Integrators keep the states of all points with
/// displacement and velocity, so that iterations and rejected steps do not change accepted values,
/// and a checkpoint contains them. A law is a constant function of them.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <optional>
#include <vector>

#include "model/laws/PointLaw.hpp"

namespace tooljoint::model {

/// Derivatives of forces f and rates g at points, row-major, point by point.
struct StateTangents {
  double* fd;  ///< df/dd, width x width
  double* fv;  ///< df/dv, width x width
  double* fx;  ///< df/dx, width x rated
  double* gd;  ///< dg/dd, rated x width
  double* gv;  ///< dg/dv, rated x width
  double* gx;  ///< dg/dx, rated x rated
};

/// A batch of points with states() numbers x per point, point-major. The first rated() states have
/// rates x' = g(t, d, v, x) and are integrated by the scheme of the motion: functions receive them
/// at the time t. The others are held: they keep the values accepted at the end of the last step
/// until accept() replaces them at the end of the next one.
///
/// All points are evaluated in every step, even far from a wall, because states change there too
/// (clearanceLeft() reports that; only a law without states may report otherwise). Implementations
/// allocate only in initialState().
class StatefulPointLaw : public PointLaw {
 public:
  virtual int states() const = 0;
  virtual int rated() const = 0;
  /// States of all points at the start of a motion.
  virtual void initialState(double t, const double* d, const double* v, double* x) const = 0;

  /// Forces f (width() per point) and rates g (rated() per point).
  virtual void forces(double t, const std::vector<int>& points, const double* d, const double* v,
                      const double* x, double* f, double* g) const = 0;
  /// The same with exact derivatives.
  virtual void forcesWithTangents(double t, const std::vector<int>& points, const double* d,
                                  const double* v, const double* x, double* f, double* g,
                                  const StateTangents& tangents) const = 0;

  /// End (t, d, v) of a step of the motion: updates the held states of all points to this time.
  /// Also called for steps that may still be rejected, with a copy of the states.
  virtual void accept(double /*t*/, const double* /*d*/, const double* /*v*/, double* /*x*/) const {
  }

  /// Effect of held states in a small motion e^{s t} of a point about (d, v), as a factor of df/dd:
  /// 1 if they do not move, 1 - e^{-s tau} if forces depend on y(t) - y(t - tau). Empty if not
  /// known, the default for a law with held states.
  virtual std::optional<std::complex<double>> heldFactor(double /*t*/, std::complex<double> /*s*/,
                                                         int /*point*/, const double* /*d*/,
                                                         const double* /*v*/) const {
    if (states() > rated()) return std::nullopt;
    return 1.0;
  }

  /// As PointLaw::power() in the middle of a chord of the motion, with rated states x and rates
  /// xDot of all states (states() per point); held states are those at its end. `damping` and
  /// `friction` include losses inside the law.
  virtual Power powers(double t, const std::vector<int>& points, const double* d, const double* v,
                       const double* x, const double* xDot) const = 0;
  /// As PointLaw::record().
  virtual void recordState(double t, const double* d, const double* v, const double* x,
                           double* out) const = 0;

  // For set-up code without states: the law in its initial state at (d, v). Tangents are those of
  // motion too fast for the states to change.
  void evaluate(double t, const std::vector<int>& active, const double* d, const double* v,
                double* f) const final;
  void evaluateWithTangent(double t, const std::vector<int>& active, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv) const final;
  Power power(double t, const std::vector<int>& points, const double* d,
              const double* v) const final;
  void record(double t, const double* d, const double* v, double* out) const final;
  void clearanceLeft(const std::vector<int>& points, const double* d, double* gap) const override;
};

/// Tangents of all points of a law.
class StateTangentArrays {
 public:
  StateTangentArrays(int points, int width, int rated);
  explicit StateTangentArrays(const StatefulPointLaw& law)
      : StateTangentArrays(law.size(), law.width(), law.rated()) {}

  using Rows =
      Eigen::Map<const Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>>;
  struct OfPoint {
    Rows fd, fv, fx, gd, gv, gx;
  };
  OfPoint of(int point) const;
  /// Pointers for the law to write to.
  StateTangents write();

 private:
  int width_, rated_;
  std::vector<double> fd_, fv_, fx_, gd_, gv_, gx_;
};

/// The law as one with states; null for a law without.
inline const StatefulPointLaw* stateful(const PointLaw& law) {
  return dynamic_cast<const StatefulPointLaw*>(&law);
}

/// Number of states of all points; 0 for a law without states.
inline int stateSize(const PointLaw& law) {
  const auto* with = stateful(law);
  return with != nullptr ? law.size() * with->states() : 0;
}

/// PointLaw::record() with the states x, which a law without states does not read.
inline void record(const PointLaw& law, double t, const double* d, const double* v, const double* x,
                   double* out) {
  if (const auto* with = stateful(law))
    with->recordState(t, d, v, x, out);
  else
    law.record(t, d, v, out);
}

}  // namespace tooljoint::model
