// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Errors of the states of point laws beside those of a motion.
#pragma once

#include <vector>

#include "transient/compiled/PointBatch.hpp"

namespace tooljoint::estimate {

/// The states of one batch along the motion and along the motion with its error e, interval by
/// interval. The rated ones, x' = g, obey to first order, with the weight a of the end of an
/// interval in the error equation,
///
///     (z_a - z_0)/(a h) = g_d e_d + g_v e_v + g_x z_a + dg,   z_1 = z_0 + (z_a - z_0)/a
///     force of the error = (f_d + f_x S a h g_d) e_d + (f_v + f_x S a h g_v) e_v
///                          + f_x S (z_0 + a h dg) + df,   S = (1 - a h g_x)^-1
///
/// The tangents in brackets are those of transient::PointStates. Held states (a delay line, plastic
/// strain) have no derivatives: both motions keep theirs, accepted at the samples, and df, dg are
/// what they differ by where the motion is. All rows are those of the batch, width() per point.
class StateErrors {
 public:
  /// The batch must outlive this. Its law has states.
  explicit StateErrors(transient::PointBatch& batch);

  /// The first sample, the batch gathered there. \param x states of the run \param e, eDot errors
  /// of its coordinates and their rates
  void begin(double t, const double* x, const Vector& e, const Vector& eDot);
  /// Before the batch is evaluated in the middle of an interval: the states are those of the
  /// middle. \param x states of the run at its end \param factor a h
  void bind(const double* x, double factor);
  /// What errors of states from before this interval exert, with the tangents last evaluated.
  /// ConvergenceError: the motion of the interval is longer than what the law remembers.
  Vector force(double t);
  /// After the error equation has been solved: \param e, eDot errors of the coordinates at the
  /// weighted time of the interval
  void follow(const Vector& e, const Vector& eDot, double weight);
  /// The sample at the end of the interval, the batch gathered there; `e`, `eDot` errors of its
  /// coordinates.
  void accept(double t, const Vector& e, const Vector& eDot);

 private:
  Vector ratedOf(const Vector& states) const;
  void setRated(Vector& states, const Vector& rated) const;

  transient::PointBatch* batch_;
  const model::StatefulPointLaw* law_;
  Vector own_, moved_;  ///< all states along the motion and with its error
  Vector end_;          ///< states of the run at the end of the interval
  Vector middle_;
  Vector z_;       ///< error of the rated states
  Vector change_;  ///< z_0 + a h dg of the interval
  double factor_ = 0;
};

}  // namespace tooljoint::estimate
