// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The contact forces of an implicit step and their update in an iteration: the effective matrix S
/// is factored once, and the point forces are found by nodal compliance. With f = P y + p, P the
/// tangents frozen in S and y = R delta,
///
///     S delta = -R0 + R'p,      p = f(y) - P y
///
/// holds at the solution, the residual of any other p is R'(p - f + P y), and each point knows how
/// its own motion answers its force: y_i = ... + G_ii p_i with G_ii = R_i S^-1 R_i'. So
///
///     p_i += (I - (J_i - P_i) G_ii)^-1 (f_i - P_i y_i - p_i),     J_i = df_i/dy_i
///
/// with J taken once where the step is expected to end is Newton point by point (PointForces): one
/// solve and one evaluation of the laws per iteration, no product, no factorisation. It converges
/// with the effect of each point's change of tangent on the others. Where only few points are left
/// to correct, only what they reach is solved and evaluated: a force moves a few neighbours in a
/// step. A point whose force jumps (contact that switches within the step, friction that reverses)
/// is solved as what it is, see PointSolve; its error is then measured in y.
#pragma once

#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/Strategies.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/contact/PointForces.hpp"
#include "transient/contact/PointImpacts.hpp"

namespace tooljoint::transient {

class ContactForceUpdate {
 public:
  /// The strategies, which must outlive this, say what may be used.
  void bind(CompiledModel& model, Strategies& strategies);
  /// Scale of each dof's force.
  void setWeights(const Vector& weight);

  PointImpacts& impacts() { return impacts_; }
  const PointImpacts& impacts() const { return impacts_; }

  /// The compliance of the active points, from the factor of the effective matrix (invert() is
  /// called), which must outlive its use.
  void setCompliance(linalg::BlockFactor& factor);

  /// Remember where delta counts from: q where v = 0, and the residual R0 of all linear terms
  /// there, which must outlive the step.
  void start(const Vector& q, const Vector& residual);
  /// Evaluate the laws at delta = v / c, with tangents, and set p so that it is consistent with
  /// them.
  void guess(double t, double c, const Vector& v);
  /// delta for the present p; `force`, if any, acts as well.
  void solve(const linalg::BlockFactor& factor, const Vector* force, Vector& delta);
  /// The same after a correct() that says so: delta changes by what the forces of the points
  /// corrected have changed, but for residuals below `small`.
  void solveNear(const linalg::BlockFactor& factor, double small, Vector& delta);
  /// What such a solve costs beside one of all, by the number of points: how far it reaches depends
  /// on where the model is cut for the ranks, and what is decided by costs must not.
  double nearShare() const { return nearShare_; }
  /// Blocks of this rank that the last solveNear() reached.
  std::size_t reached() const { return live_.size(); }
  /// Evaluate the laws at delta (v is c delta). Returns max |w R'(f - P y - p)| by rows; `force`
  /// becomes the largest of itself and |w f|; an error below `small` needs no care. After
  /// solveNear() only what moved is evaluated.
  double evaluate(double t, double c, const Vector& delta, double small, double& force);
  /// |w (f - P y - p)|_2 over |w f|_2 where they were evaluated: how much of the forces of all
  /// points is not accounted for (infinite where there are none any more).
  double wrongShare() const;
  /// Take in the points active since start(): they have had no force up to now, and are
  /// evaluated at delta as by evaluate(). Only they are corrected next.
  double join(double t, double c, const Vector& delta, double small, double& force);
  /// One Newton step at every point, and the whole way at those where Newton does not help. True
  /// when it was only taken at the few points wrong by more than a part of `small` (never if `all`
  /// are wanted), and solveNear() can follow.
  bool correct(double t, double c, double small, bool all);
  /// Every Tuned::colours-th point, from the one of this colour, if it is wrong: solved by itself
  /// while its neighbours stand still. In turns for all colours this is block Gauss-Seidel over the
  /// points, which converges where neighbours that stick and slip disturb each other when all
  /// move at once. Returns as correct().
  bool sweepEveryFourth(double t, double c, double small, int colour);
  /// Leaves the forces that act in the step with the points.
  void finish(double t, double c);

 private:
  void prepare(std::size_t number, double t, double c);
  bool isFew(long here);
  double largestOfAll(double worst, double& force) const;

  CompiledModel* model_ = nullptr;
  Strategies* strategies_ = nullptr;
  std::vector<PointForces> forces_;  ///< of each batch
  PointImpacts impacts_;
  std::vector<char> blocks_;  ///< that points act on
  const double* inverse_ = nullptr;
  const Vector* q_ = nullptr;
  const Vector* residual_ = nullptr;
  Vector weight_;
  Vector near_;            ///< change of delta in solveNear(), zero between calls
  std::vector<int> live_;  ///< blocks where it is not zero
  bool isNear_ = false;    ///< the last solve was solveNear()
  bool allMoved_ = true;   ///< the last correction was of all points that were wrong: those it did
                           ///< not reach are right
  double nearShare_ = 0;
};

}  // namespace tooljoint::transient
