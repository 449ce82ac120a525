// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The nonlinear equations of one implicit step. From the q, a of a step that
/// would end at rest,
///
///     M (a + ca delta) + cv C delta + K (q + delta) = F + R' f(q + delta, cv
///     delta, t)
///
/// (with M replaced by M - k M (I - s ca (s ca M + K)^-1 M) where the scheme
/// asks for it, see AlphaStep::setPhaseCorrection) is solved for delta = v /
/// cv, first by relaxation of the point forces with the effective matrix S = ca
/// M + cv C + K - R'PR factored once (ContactForceIteration), and where that is
/// slow by modified Newton with exact tangents: the factor is renewed, each
/// update backtracked on the residual scaled by the diagonal of S, and points
/// whose force jumps are solved by themselves (CoupledPointSolve).
#pragma once

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "transient/Integrator.hpp"
#include "transient/compiled/CompiledModel.hpp"
#include "transient/contact/ContactForceIteration.hpp"
#include "transient/contact/CoupledPointSolve.hpp"
#include "transient/schemes/EffectiveMatrix.hpp"
#include "transient/schemes/PhaseCorrection.hpp"

namespace tooljoint::transient {

class ImplicitStep {
 public:
  struct Options {
    double tolerance = 0;  ///< on max |w R| over the largest scaled force
    int maxIterations = 25;
    StrategySet without;  ///< strategies not to use
  };

  void bind(CompiledModel& model, const Options& options);

  /// What depends on the scheme alone; solve() calls it when it has another
  /// one.
  void prepare(const StepScheme& scheme, double t);
  /// Completes `to`, which has q and a as they are where v = 0, and the
  /// predicted v; false when nothing converged (`to` then holds the last
  /// iterate).
  bool solve(State& to, const StepScheme& scheme, Counters& counters);

  /// Whether the iterate left by a failed solve() is made of numbers.
  bool isFinite() const { return std::isfinite(merit_); }
  /// max |w R| over the largest scaled force, and where, at the end of the last
  /// solve().
  double relativeError() const;
  std::string worstName() const;

  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  void scale(const StepScheme& scheme, double t);
  enum class From { Rest, Motion };
  void linearResidual(const State& to, From from);
  void predict(State& to) const;
  bool relax(State& to);
  bool settle(State& to, bool again);
  bool finish(State& to);
  void account(double relaxations);
  bool iterate(State& to);
  double measure(const State& to);
  bool isSlow(double rate) const;
  bool converged() const { return error_ <= tolerance(); }
  double tolerance() const {
    return options_.tolerance * std::min(reference_, mostForce_) + floor_;
  }
  void refactor(const State& to);
  void finishFactor();
  void guess(const State& to, double norm);
  double relaxOnce(const State& to, bool near, double norm);
  bool begin(const State& to, double norm);
  bool join(const State& to);
  void findDrift();
  const Vector* otherForces(double norm);
  bool backtrack(State& to);
  bool solveTroubledPoints(State& to, double before);
  void place(State& to, double fraction);
  void findChange();

  CompiledModel* model_ = nullptr;
  Options options_;
  StepScheme scheme_;
  Counters* counters_ = nullptr;

  EffectiveMatrix matrix_;
  bool fresh_ = false;   ///< the tangent in the factor is that of the current iterate
  bool wanted_ = false;  ///< convergence was slow: factor anew
  PhaseCorrection phase_;

  Strategies strategies_;
  ContactForceIteration relaxation_;
  bool relaxes_ = false;    ///< points have few enough coordinates for it
  bool compliant_ = false;  ///< its compliance belongs to the factor
  double usual_ = 0;        ///< relaxations of the first step with this factor
  double debt_ = 0;         ///< relaxations beyond that since
  Vector guess_, drift_;    ///< where iterations began, and what the changes of
                            ///< the laws make of it
  State predicted_;         ///< to go back to

  Vector linear_, residual_, delta_, change_;
  CoupledPointSolve nodal_;
  int rescues_ = 0;  ///< its uses in this step
  Vector base_, saved_, savedChange_;
  Vector q0_, v0_, a0_, linear0_;  ///< iterate to go back to in the line search
  Vector weight_, rowSize_, scratch_;
  Vector atCut_;          ///< forces at the cut of a model that is divided among ranks
  Vector inertia_;        ///< w_i M_ii
  double scaleTime_ = 0;  ///< of the scale of the rows
  double error_ = 0;      ///< max |w R|
  double merit_ = 0;      ///< |w R|_2
  double reference_ = 0;  ///< largest scaled force of this step
  double mostForce_ = 0;  ///< what forces of this step are believed to reach
  double linearReference_ = 0;
  double floor_ = 0;  ///< rounding of K q, scaled alike
};

}  // namespace tooljoint::transient
