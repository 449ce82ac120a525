// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Forces of the points of one batch in an implicit step, each against its own compliance. With
/// f(y) the law at the end of the step, P the tangent frozen in the effective matrix and p = f - P
/// y,
///
///     p_i += B_i (f_i - P_i y_i - p_i),   B_i = (I - (J_i - P_i) G_ii)^-1,   J_i = df_i/dy_i
///
/// Functions act on the points taken last; they are given the batch, which is always the same.
#pragma once

#include <vector>

#include "transient/Strategies.hpp"
#include "transient/contact/PointSolve.hpp"
#include "transient/points/PointBatch.hpp"

namespace tooljoint::transient {

class PointForces {
 public:
  /// The strategies must outlive this.
  PointForces(const PointBatch& batch, Strategies& strategies);
  /// Scale of the force at each dof.
  void setWeights(const PointBatch& batch, const Vector& weight);
  /// The factor of the effective matrix has changed.
  void forgetCompliance();
  /// A new step: no point has started.
  void forgetStart();

  void takeAll(const PointBatch& batch) { points_ = batch.active(); }
  /// Takes the points that have not started.
  void takeNew(const PointBatch& batch);
  /// Adds the points in these blocks to those taken. The change of a taken point may be too small
  /// to appear in the blocks.
  void takeReached(const PointBatch& batch, const std::vector<int>& blocks);
  /// Keeps only the wrong ones of the taken points; the others have not moved.
  void keepWrong(double small);
  /// Takes every Tuned::colours-th of all points, counted from `place`, if it is wrong.
  void takeTurn(const PointBatch& batch, double small, int colour, long& place);
  const std::vector<int>& taken() const { return points_; }

  /// Starts the taken points at q, where v = 0. \param inverse of the diagonal blocks of the factor
  void start(PointBatch& batch, const double* q, const double* inverse);
  /// y = R delta / c.
  void gather(const PointBatch& batch, const Vector& delta, double c);
  /// Laws at y, v = c y.
  void evaluate(PointBatch& batch, double t, double c, bool tangents);
  /// Sets forces consistent with the laws, and the response of each point.
  void agree(const PointBatch& batch, double c);
  /// The taken points had no force so far.
  void removeForces(const PointBatch& batch);
  /// Defects of the laws against p, and errors of the points; `force` becomes the maximum of itself
  /// and |w f|.
  void measure(const PointBatch& batch, double small, double& force);
  /// The next p: full steps if Newton converges, else the local equilibrium of the point.
  void correct(PointBatch& batch, double t, double c);
  /// Laws at the end of the iteration, for points solved by themselves: evaluated at the
  /// equilibrium found there, which may differ from y within the tolerance. On a stiff wall this
  /// decides between a contact force in the step and none.
  void stand(PointBatch& batch, double t, double c);

  bool isWrong(int point, double small) const;
  /// Largest error of these points and `known`; NaN if one of them is NaN.
  double worst(const std::vector<int>& points, double known) const;
  /// Adds |w (f - P y - p)|^2 and |w f|^2 of all points.
  void addSquares(const PointBatch& batch, double& wrong, double& whole) const;
  const std::vector<double>& forces() const { return p_; }
  const std::vector<double>& change() const { return change_; }  ///< of p in the last correct()
  const std::vector<double>& compliance() const { return compliance_; }

 private:
  template <class Width>
  void answer(const PointBatch& batch, int point, double c, Width width);
  void solveAlone(PointBatch& batch, int point, double t, double c);

  Strategies* strategies_;
  std::vector<int> points_;  ///< points taken
  // rows of all points
  std::vector<double> d_;       ///< at delta = 0
  std::vector<double> y_, p_;   ///< rows of delta; forces
  std::vector<double> defect_;  ///< f - P y - p
  std::vector<double> weight_;  ///< largest weight of the dofs of a row
  std::vector<double> target_;  ///< y of the points solved by themselves
  std::vector<double> change_;
  // width x width per point, row-major
  std::vector<double> compliance_, answer_;  ///< G, B
  // per point
  std::vector<char> started_;  ///< taken by start() in this step
  std::vector<char> known_;    ///< its compliance belongs to the current factor
  std::vector<double> error_;  ///< error in the last iteration
  std::vector<char> alone_;    ///< solved by itself in this step
  std::vector<char> moved_;    ///< corrected in the last correction
  std::vector<char> listed_;   ///< already in points_, in takeReached()
  PointSolve problem_;
  PointSolve::Local guess_, phi_;
};

}  // namespace tooljoint::transient
