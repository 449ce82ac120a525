// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "common/Types.hpp"
#include "linalg/blocks/RankCut.hpp"
#include "transient/points/PointBatch.hpp"

namespace tooljoint::transient {

/// States of the point laws of a model, one after the other in the order of its batches; most
/// models have none. A rank has the states of its own points, and zeros for those of other ranks.
class ModelStates {
 public:
  ModelStates() = default;
  /// Both arguments must outlive the object.
  ModelStates(std::vector<PointBatch>& batches, const linalg::RankCut& cut);

  int size() const { return size_; }
  /// States x of one rank -> of all ranks. Collective.
  void join(Vector& x) const;
  /// States x of all ranks -> of this rank.
  void keepOwn(Vector& x) const { keepOwn(x.data()); }
  /// States at the start of a motion at (q, v).
  void initial(double t, const double* q, const double* v, double* x);
  /// States for the following evaluations of points, see PointStates::bind(); arrays of size()
  /// that must outlive their use.
  void bind(const double* base, double factor = 0.0, const double* rate = nullptr);
  /// See PointStates::bindKnown().
  void bindKnown(const double* x, double factor);
  /// Rates of the last evaluation of all points.
  void rates(double* xDot) const;
  /// End (q, v) of an implicit step: sets states and rates, accepts held states.
  void complete(double t, const double* q, const double* v, double* x, double* xDot);
  /// End of an explicit step, with known rated states.
  void accept(double t, const double* q, const double* v, double* x);
  /// out = from + s (to - from) for rated states; held states are copied from `held`.
  void blend(const Vector& from, const Vector& to, double s, const Vector& held, Vector& out) const;
  /// Norm of the difference of rated states. Collective.
  double distance(const Vector& a, const Vector& b) const;

 private:
  void keepOwn(double* x) const;

  std::vector<PointBatch>* batches_ = nullptr;
  const linalg::RankCut* cut_ = nullptr;
  int size_ = 0;
};

}  // namespace tooljoint::transient
