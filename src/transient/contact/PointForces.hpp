// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Forces of the points of one batch in an implicit step, each against its own compliance: with
/// f(y) the law at the end of the step, P the tangent frozen in the effective matrix and p = f - P
/// y,
///
///     p_i += B_i (f_i - P_i y_i - p_i),   B_i = (I - (J_i - P_i) G_ii)^-1,   J_i = df_i/dy_i
///
/// Calls are about the points taken last, and pass the batch, which is always the same.
#pragma once

#include <vector>

#include "transient/Strategies.hpp"
#include "transient/compiled/PointBatch.hpp"
#include "transient/contact/PointSolve.hpp"

namespace tooljoint::transient {

class PointForces {
 public:
  /// The strategies must outlive this.
  PointForces(const PointBatch& batch, Strategies& strategies);
  /// Scale of each dof's force.
  void setWeights(const PointBatch& batch, const Vector& weight);
  /// The factor of the effective matrix is another one.
  void forgetCompliance();
  /// Another step: no point has started.
  void forgetStart();

  void takeAll(const PointBatch& batch) { points_ = batch.active(); }
  /// Those that have not started.
  void takeNew(const PointBatch& batch);
  /// Those taken, whose small change may have ended where it began, and those in these blocks.
  void takeReached(const PointBatch& batch, const std::vector<int>& blocks);
  /// Of those taken, those that are wrong; the others have not moved.
  void keepWrong(double small);
  /// Of all, counted from `place` on, every Tuned::colours-th if it is wrong.
  void takeTurn(const PointBatch& batch, double small, int colour, long& place);
  const std::vector<int>& taken() const { return points_; }

  /// They count from q, where v = 0; \param inverse of the diagonal blocks of the factor
  void start(PointBatch& batch, const double* q, const double* inverse);
  /// y = R delta / c.
  void gather(const PointBatch& batch, const Vector& delta, double c);
  /// Laws at y, v = c y.
  void evaluate(PointBatch& batch, double t, double c, bool tangents);
  /// Forces that agree with the laws, and how each point answers.
  void agree(const PointBatch& batch, double c);
  /// They have had no force up to now.
  void removeForces(const PointBatch& batch);
  /// What the laws say beyond p, and by how much points are wrong; `force` becomes the largest of
  /// itself and |w f|.
  void measure(const PointBatch& batch, double small, double& force);
  /// The next p; whole steps where Newton helps, else to where the point is alone in equilibrium.
  void correct(PointBatch& batch, double t, double c);
  /// Laws at the end of the iteration where points have been solved by themselves: the equilibrium
  /// found there, which may be beside y by the tolerance. On a stiff wall that is the difference
  /// between the force that acts in the step and none.
  void stand(PointBatch& batch, double t, double c);

  bool isWrong(int point, double small) const;
  /// The largest error of these points; not a number where one of them is.
  double worst(const std::vector<int>& points, double known) const;
  /// |w (f - P y - p)|^2 and |w f|^2 of all points are added.
  void addSquares(const PointBatch& batch, double& wrong, double& whole) const;
  const std::vector<double>& forces() const { return p_; }
  const std::vector<double>& change() const { return change_; }  ///< of p in the last correct()
  const std::vector<double>& compliance() const { return compliance_; }

 private:
  template <class Width>
  void answer(const PointBatch& batch, int point, double c, Width width);
  void solveAlone(PointBatch& batch, int point, double t, double c);

  Strategies* strategies_;
  std::vector<int> points_;  ///< taken
  // rows of all points
  std::vector<double> d_;       ///< at delta = 0
  std::vector<double> y_, p_;   ///< rows of delta; forces
  std::vector<double> defect_;  ///< f - P y - p
  std::vector<double> weight_;  ///< largest weight of the dofs a row acts on
  std::vector<double> target_;  ///< y of the points solved by themselves
  std::vector<double> change_;
  // width x width per point, row-major
  std::vector<double> compliance_, answer_;  ///< G, B
  // per point
  std::vector<char> started_;  ///< taken by start() in this step
  std::vector<char> known_;    ///< its compliance belongs to the factor
  std::vector<double> error_;  ///< of the last iteration
  std::vector<char> alone_;    ///< solved by itself in this step
  std::vector<char> moved_;    ///< corrected last time
  std::vector<char> listed_;   ///< in points_ already, in takeReached()
  PointSolve problem_;
  PointSolve::Local guess_, phi_;
};

}  // namespace tooljoint::transient
