// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Evaluates a batch with states. The scheme defines the rated states at the end of a step,
///
///     x = base + factor g(t, d, v, x),
///
/// with factor 0 if x is known (stages of explicit schemes). The force at each point is then a
/// function of its d and v alone, with the tangents
///
///     df/dd + df/dx S factor dg/dd,   S = (I - factor dg/dx)^-1,   likewise for v
///
/// Solvers of first-order systems iterate on x themselves and eliminate it from their Newton
/// equations: bindKnown() and the functions after it.
#pragma once

#include <Eigen/LU>
#include <vector>

#include "common/Types.hpp"
#include "model/laws/StatefulPointLaw.hpp"

namespace tooljoint::transient {

class PointStates {
 public:
  explicit PointStates(const model::StatefulPointLaw& law);

  /// Number of states of all points.
  int size() const { return points_ * states_; }
  /// Sets the states; `base` must outlive their use. `rate` is used by power(), null for none.
  void bind(const double* base, double factor, const double* rate);
  /// Sets known states x, with the tangents for this factor.
  void bindKnown(const double* x, double factor);
  /// From the last tangents and r, with rated() numbers per point: the forces df/dx S r, width()
  /// rows per point.
  void forceOf(double factor, const double* r, double* rows);
  /// r := S (r + factor (dg/dd d + dg/dv v)); d and v are rows.
  void follow(double factor, const double* d, const double* v, double* r);
  int points() const { return points_; }
  int states() const { return states_; }
  int rated() const { return rated_; }

  /// As the functions of model::PointLaw. If the states of a point cannot be found, its force is
  /// NaN, so that the step fails.
  void evaluate(double t, const std::vector<int>& points, const double* d, const double* v,
                double* f);
  void evaluateWithTangent(double t, const std::vector<int>& points, const double* d,
                           const double* v, double* f, double* dfdd, double* dfdv);
  model::PointLaw::Power power(double t, const std::vector<int>& points, const double* d,
                               const double* v) const;

  /// Rates of the last evaluation of all points, 0 for held states.
  void rates(double* xDot) const;
  /// End (d, v) of a step, all points: sets states and rates, accepts held states.
  void complete(double t, const std::vector<int>& all, const double* d, const double* v, double* x,
                double* xDot);
  /// Updates the held states of x at the end of a step.
  void accept(double t, const double* d, const double* v, double* x) const {
    law_->accept(t, d, v, x);
  }
  void initial(double t, const double* d, const double* v, double* x) const {
    law_->initialState(t, d, v, x);
  }
  bool isRated(int state) const { return state % states_ < rated_; }

  /// Tangents of the last evaluation with tangents.
  model::StateTangentArrays::OfPoint tangentsOf(int point) const { return tangents_.of(point); }

 private:
  bool solve(double t, int point, const double* d, const double* v);
  void setJacobian(int point, double factor);

  const model::StatefulPointLaw* law_;
  int points_, width_, states_, rated_;
  const double* base_ = nullptr;
  double factor_ = 0;
  bool known_ = true;  ///< x is base_
  const double* rate_ = nullptr;
  std::vector<double> x_, g_, f_, still_;
  model::StateTangentArrays tangents_;
  std::vector<int> one_;
  Matrix jacobian_, slope_, right_;
  Vector defect_, step_;
  Eigen::PartialPivLU<Matrix> factorised_;
};

}  // namespace tooljoint::transient
