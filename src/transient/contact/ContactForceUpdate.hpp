// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact forces of an implicit step and their update in an iteration. The effective matrix S is
/// factored once, and the point forces are found by nodal compliance. With f = P y + p, P the
/// tangents frozen in S and y = R delta,
///
///     S delta = -R0 + R'p,      p = f(y) - P y
///
/// holds at the solution; for any other p the residual is R'(p - f + P y). The compliance G_ii =
/// R_i S^-1 R_i' gives the displacement of each point due to its own force: y_i = ... + G_ii p_i.
/// So
///
///     p_i += (I - (J_i - P_i) G_ii)^-1 (f_i - P_i y_i - p_i),     J_i = df_i/dy_i
///
/// with J evaluated once at the expected end of the step is Newton's method point by point
/// (PointForces): one solve and one evaluation of the laws per iteration, no product, no
/// factorisation. Its convergence is governed by the effect of each point's change of tangent on
/// the others. If only few points remain to be corrected, only their surroundings are solved and
/// evaluated, because a force affects few neighbours within a step. A point whose force jumps
/// (contact that switches within the step, friction that reverses) is solved by PointSolve; its
/// error is then measured in y.
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
  /// The strategies define what may be used; they must outlive this.
  void bind(CompiledModel& model, Strategies& strategies);
  /// Scale of the force at each dof.
  void setWeights(const Vector& weight);

  PointImpacts& impacts() { return impacts_; }
  const PointImpacts& impacts() const { return impacts_; }

  /// Compliance of the active points from the factor of the effective matrix (invert() is called).
  /// The factor must outlive its use.
  void setCompliance(linalg::BlockFactor& factor);

  /// Sets the origin of delta: q for v = 0, and the residual R0 of all linear terms there. Both
  /// must outlive the step.
  void start(const Vector& q, const Vector& residual);
  /// Evaluates the laws at delta = v / c, with tangents, and sets p consistently.
  void guess(double t, double c, const Vector& v);
  /// delta for the current p; `force`, if any, acts as well.
  void solve(const linalg::BlockFactor& factor, const Vector* force, Vector& delta);
  /// The same after a correct() that returned true: adds the change of delta due to the corrected
  /// forces, dropping residuals below `small`.
  void solveNear(const linalg::BlockFactor& factor, double small, Vector& delta);
  /// Cost of such a solve relative to a full one, estimated from the number of points. The actual
  /// extent depends on where the model is cut for the ranks, and decisions by cost must not.
  double nearShare() const { return nearShare_; }
  /// Number of blocks of this rank in the last solveNear().
  std::size_t reached() const { return live_.size(); }
  /// Evaluates the laws at delta (v is c delta). Returns max |w R'(f - P y - p)| by rows; `force`
  /// becomes the maximum of itself and |w f|. Errors below `small` need no correction. After
  /// solveNear() only the affected points are evaluated.
  double evaluate(double t, double c, const Vector& delta, double small, double& force);
  /// |w (f - P y - p)|_2 over |w f|_2 of the last evaluations: the fraction of all point forces
  /// that is not in balance (infinite if no force is left).
  double wrongShare() const;
  /// Adds the points that became active after start(). They had no force so far and are evaluated
  /// at delta as by evaluate(). Only they are corrected next.
  double join(double t, double c, const Vector& delta, double small, double& force);
  /// One Newton step at every point, and a local solution at points where Newton fails. True if
  /// only few points, wrong by more than a part of `small`, were corrected (never if `all` is set),
  /// so that solveNear() can follow.
  bool correct(double t, double c, double small, bool all);
  /// Corrects every Tuned::colours-th point, from the one of this colour, if it is wrong: solved by
  /// itself while its neighbours are held. Over all colours this is block Gauss-Seidel, which
  /// converges where sticking and slipping neighbours disturb each other when all are corrected at
  /// once. Returns as correct().
  bool sweepEveryFourth(double t, double c, double small, int colour);
  /// Stores the forces of the step in the points.
  void finish(double t, double c);

 private:
  void prepare(std::size_t number, double t, double c);
  bool isFew(long here);
  double largestOfAll(double worst, double& force) const;

  CompiledModel* model_ = nullptr;
  Strategies* strategies_ = nullptr;
  std::vector<PointForces> forces_;  ///< of each batch
  PointImpacts impacts_;
  std::vector<char> blocks_;  ///< blocks with points
  const double* inverse_ = nullptr;
  const Vector* q_ = nullptr;
  const Vector* residual_ = nullptr;
  Vector weight_;
  Vector near_;            ///< change of delta in solveNear(), zero between calls
  std::vector<int> live_;  ///< nonzero blocks of near_
  bool isNear_ = false;    ///< the last solve was solveNear()
  bool allMoved_ = true;   ///< the last correction included all wrong points: others are right
  double nearShare_ = 0;
};

}  // namespace tooljoint::transient
