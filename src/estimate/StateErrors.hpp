// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Errors of the states of point laws in addition to those of a motion.
#pragma once

#include <vector>

#include "transient/points/PointBatch.hpp"

namespace tooljoint::estimate {

/// States of one batch along the motion and along the motion with its error e, interval by
/// interval. With the weight a of the end of an interval in the error equation, the rated states,
/// x' = g, obey to first order
///
///     (z_a - z_0)/(a h) = g_d e_d + g_v e_v + g_x z_a + dg,   z_1 = z_0 + (z_a - z_0)/a
///     force of the error = (f_d + f_x S a h g_d) e_d + (f_v + f_x S a h g_v) e_v
///                          + f_x S (z_0 + a h dg) + df,   S = (1 - a h g_x)^-1
///
/// The tangents in brackets are those of transient::PointStates. Held states (a delay line, plastic
/// strain) have no derivatives: both motions keep their own, accepted at the samples, and df, dg
/// are the resulting differences at the position of the motion. All rows are those of the batch,
/// width() per point.
class StateErrors {
 public:
  /// The batch must outlive this; its law must have states.
  explicit StateErrors(transient::PointBatch& batch);

  /// First sample; the batch must be gathered there. \param x states of the run \param e, eDot
  /// errors of its coordinates and their rates
  void begin(double t, const double* x, const Vector& e, const Vector& eDot);
  /// Call before the batch is evaluated in the middle of an interval: sets the states there. \param
  /// x states of the run at its end \param factor a h
  void bind(const double* x, double factor);
  /// Force of errors of states from before this interval, with the last tangents. ConvergenceError:
  /// the interval is longer than the memory of the law.
  Vector force(double t);
  /// Call after the solution of the error equation: \param e, eDot errors of the coordinates at the
  /// weighted time of the interval
  void follow(const Vector& e, const Vector& eDot, double weight);
  /// Sample at the end of the interval; the batch must be gathered there. `e`, `eDot` are the
  /// errors of its coordinates.
  void accept(double t, const Vector& e, const Vector& eDot);

 private:
  Vector ratedOf(const Vector& states) const;
  void setRated(Vector& states, const Vector& rated) const;

  transient::PointBatch* batch_;
  const model::StatefulPointLaw* law_;
  Vector own_, moved_;  ///< all states along the motion, and with its error
  Vector end_;          ///< states of the run at the end of the interval
  Vector middle_;
  Vector z_;       ///< error of the rated states
  Vector change_;  ///< z_0 + a h dg of the interval
  double factor_ = 0;
};

}  // namespace tooljoint::estimate
