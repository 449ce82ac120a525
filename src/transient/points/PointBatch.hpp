// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// One PointSet in compiled form: gathers d = offset + R q, evaluates the law at points that may be
/// in contact (PointClearances), scatters R' f and its tangents (FrozenTangent) into the block
/// matrix.
#pragma once

#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "linalg/blocks/BlockSparse.hpp"
#include "model/SecondOrderModel.hpp"
#include "transient/points/ActivePoints.hpp"
#include "transient/points/FrozenTangent.hpp"
#include "transient/points/PointClearances.hpp"
#include "transient/points/PointRows.hpp"
#include "transient/points/PointStates.hpp"

namespace tooljoint::transient {

class PointBatch {
 public:
  /// \param own  points to evaluate, increasing; null for all
  PointBatch(const model::PointSet& set, const linalg::BlockPattern& pattern,
             const std::vector<int>* own = nullptr);

  int points() const { return points_; }
  int width() const { return rows_.width(); }
  /// Points that are evaluated; all points of this rank.
  const std::vector<int>& active() const { return selected_.active(); }
  const std::vector<int>& everyPoint() const { return selected_.all(); }
  ActivePoints& selected() { return selected_; }
  long evaluations() const { return evaluations_; }
  const model::PointLaw& law() const { return *law_; }
  const std::string& name() const { return name_; }
  std::int64_t entity(int point) const { return entities_[static_cast<std::size_t>(point)]; }

  /// Evaluator of a law with states; null for a law without.
  PointStates* states() const { return states_.get(); }

  /// Evaluates the clearances at q (time t) and selects the points to evaluate in a step of length
  /// h from there.
  void look(double t, double h, const double* q);
  /// Evaluates the clearances at q and adds touching points that were not evaluated; true if there
  /// are any. A following look() at the time t is at the same q and reuses the clearances.
  bool addMissed(const double* q, double t = std::numeric_limits<double>::quiet_NaN());
  /// True if a point is closed at q and was open at the last look(), or vice versa.
  bool meetsOrLeavesWall(const double* q);

  /// Forces of the active points at (q, v).
  void evaluate(double t, const double* q, const double* v);
  /// Forces and tangents of the active points at (q, v); the tangents are kept until the next call.
  void evaluateWithTangent(double t, const double* q, const double* v);
  /// y += R' f.
  void addForce(double* y) const;

  /// Multiplies force and tangents of a point by this factor in all later evaluations (initially
  /// 1).
  void setScale(int point, double scale);
  double scale(int point) const { return scale_[static_cast<std::size_t>(point)]; }
  /// y += R' f of the points with a scale other than 1, f scaled; appends their blocks.
  void addScaledForce(double* y, std::vector<int>& blocks) const;
  /// Applies a new scale to the results of the last evaluation with tangents.
  void rescale(int point) { scalePoint(point, true); }
  bool isScaled() const { return scaled_ > 0; }

  // The same in rows (point * width() + coordinate) of the given points, for iterations that never
  // form q and v.
  /// rows = R x.
  void gather(const std::vector<int>& points, const double* x, double* rows) const {
    rows_.gather(points, x, rows);
  }
  /// y += R' rows.
  void scatter(const std::vector<int>& points, const double* rows, double* y) const {
    rows_.scatter(points, rows, y);
  }
  /// d() at q.
  void gatherPositions(const std::vector<int>& points, const double* q);
  /// Coordinates for the next evaluateHere(), offsets included.
  double* position() { return d_.data(); }
  double* velocity() { return v_.data(); }
  /// Forces at position() and velocity(), with tangents if requested.
  void evaluateHere(double t, const std::vector<int>& points, bool tangent);
  void evaluateHere(double t, int point, bool tangent);
  /// df/dd and df/dv of the last evaluation with tangents, width() x width() per point, row-major.
  const double* dfdd() const { return dfdd_.data(); }
  const double* dfdv() const { return dfdv_.data(); }
  /// P of the last freezeTangent(); zero at other points.
  const double* frozen() const { return frozen_.values(); }
  /// R_p Z R_p' of a point for a matrix Z on the pattern, row-major.
  void project(int point, const double* values, double* block) const {
    rows_.project(point, values, block);
  }
  /// Marks the blocks of the pattern used by the rows of any point.
  void markBlocks(std::vector<char>& blocks) const;
  /// Appends the blocks of one point.
  void appendBlocks(int point, std::vector<int>& blocks) const {
    rows_.appendBlocks(point, blocks);
  }
  /// act(p) for the active points with rows in a block.
  template <class Act>
  void forActiveIn(int block, const Act& act) const {
    rows_.forPointsIn(block, [&](int p) {
      if (selected_.isMarked(p)) act(p);
    });
  }

  /// P = cd df/dd + cv df/dv of the last evaluateWithTangent(), frozen for the calls below
  /// (FrozenTangent).
  void freezeTangent(double cd, double cv) {
    frozen_.freeze(active(), dfdd_.data(), dfdv_.data(), cd, cv);
  }
  void takeOutPush() { frozen_.takeOutPush(); }
  /// Evaluates df/dd of the active points at q + h v (time t), for leaveOutTurning(). Before
  /// evaluateWithTangent().
  void lookAheadAlong(double t, double h, const double* q, const double* v);
  /// Leaves points whose df/dd turns by more than `most` [rad] there out of
  /// subtractPositionTangent(). Between freezeTangent() and takeOutPush().
  void leaveOutTurning(double most) { frozen_.leaveOutTurning(ahead_.data(), most); }
  void dropTangent(int point) { frozen_.drop(point); }
  void subtractTangent(double* values) const { frozen_.subtract(rows_, values); }
  void subtractPositionTangent(double* values) const { frozen_.subtractOfPosition(rows_, values); }
  void addTangentTimes(const double* x, double* y) const { frozen_.addTimes(rows_, x, y); }
  double frozenTimes(int row, const double* x) const { return frozen_.times(rows_, row, x); }

  // One point or one row (point * width() + coordinate) at a time, for local iterations.
  /// R_row x and y += factor R_row'.
  double rowTimesVector(int row, const double* x) const { return rows_.times(row, x); }
  void addRow(int row, double factor, double* y) const { rows_.add(row, factor, y); }
  /// Largest |R_row,i| weight_i.
  double rowWeight(int row, const double* weight) const { return rows_.weight(row, weight); }
  /// Evaluates the law at one point for width() coordinates d, v, which the batch then contains.
  /// Tangents are row-major, both null if not requested.
  void evaluateOne(double t, int point, const double* d, const double* v, double* f, double* dfdd,
                   double* dfdv);
  /// The same with tangents at other coordinates of the point; the data of the batch are unchanged.
  void evaluateElsewhere(double t, int point, const double* d, const double* v, double* f,
                         double* dfdd, double* dfdv);

  /// Powers at (q, v), summed over these points.
  model::PointLaw::Power power(double t, const double* q, const double* v,
                               const std::vector<int>& points);
  /// Mean of these powers over a step of h seconds that ends at (q, v) at the time t and changes
  /// them by dq and dv: Gauss' rule with two points on the cubic through both ends. If an impact
  /// changes the velocity within the step (scale() other than 1), the power in the middle of the
  /// chord is used.
  model::PointLaw::Power meanPower(double t, double h, const double* q, const double* v,
                                   const double* dq, const double* dv,
                                   const std::vector<int>& points);
  /// Gathers position and velocity of all points, for recording.
  void gatherAll(const double* q, const double* v);
  const double* d() const { return d_.data(); }
  const double* v() const { return v_.data(); }
  /// Forces, valid for active points only.
  const double* force() const { return f_.data(); }

  /// Data for a restart with the same selection of points and the same frozen tangent.
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  void gatherThese(const std::vector<int>& points, const double* q, const double* v);
  /// Function that evaluates the clearances at q, for PointClearances.
  auto measure(const double* q);
  void applyScale(const std::vector<int>& points, bool tangent);
  void scalePoint(int point, bool tangent);
  /// Evaluates the law at d_, v_ of these points.
  void callLaw(double t, const std::vector<int>& points, bool tangent);
  model::PointLaw::Power callPower(double t, const std::vector<int>& points) const;

  std::string name_;
  std::shared_ptr<const model::PointLaw> law_;
  std::unique_ptr<PointStates> states_;
  std::vector<std::int64_t> entities_;
  int points_ = 0;
  int width_ = 0;
  PointRows rows_;
  std::vector<double> offset_;

  ActivePoints selected_;
  PointClearances clearances_;
  std::vector<double> d_, v_, f_, dfdd_, dfdv_, ahead_;
  std::vector<double> scale_;
  int scaled_ = 0;  ///< number of scales other than 1
  FrozenTangent frozen_;
  std::vector<double> dd_, dv_;  ///< of a step; half the distance of the Gauss points
  std::vector<double> own_;      ///< d, v of a point during evaluateElsewhere()
  std::vector<int> one_;
  long evaluations_ = 0;
};

}  // namespace tooljoint::transient
