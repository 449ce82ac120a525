// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Common parts of the explicit integrators: the acceleration M^-1 (F + R'f - C v - K q), the
/// classical Runge-Kutta step, and the largest rate, which limits its length.
#pragma once

#include <string>
#include <vector>

#include "linalg/blocks/BlockFactor.hpp"
#include "transient/Integrator.hpp"
#include "transient/accuracy/LargestRate.hpp"

namespace tooljoint::transient {

/// |lambda| h of a classical Runge-Kutta step for the rate of an impact: the impact then lasts six
/// steps, and its rebound is accurate within 1 %.
constexpr double rungeKuttaImpactLimit = 0.5;
/// The same for the damping rate of a law such as that of a bit. Deviations decay up to 2.78; at
/// this value to a third in a step.
constexpr double rungeKuttaLawLimit = 2.0;

class ExplicitRightHandSide {
 public:
  /// Factors M; evaluations are added to counters.rightHandSides. Throws ModelError naming a dof
  /// without mass.
  void bind(CompiledModel& model, const std::string& integrator, Counters& counters);

  /// a = M^-1 (F(t) + R'f(q, v, t) - C(t) v - K(t) q), with the active points selected by look();
  /// for point laws with states at x also their rates.
  void acceleration(double t, const Vector& q, const Vector& v, const Vector& x, Vector& a,
                    Vector& xDot) {
    model_->setTime(t);
    evaluate(t, q, v, x, a, xDot);
  }
  /// The same at t in a step of length h from `begin`, see CompiledModel::setStage().
  void stage(double t, double begin, double h, const Vector& q, const Vector& v, const Vector& x,
             Vector& a, Vector& xDot) {
    model_->timed().setStage(t, begin, h);
    evaluate(t, q, v, x, a, xDot);
  }
  /// The same for a state: a and xDot.
  void complete(State& state) {
    acceleration(state.t, state.q, state.v, state.x, state.a, state.xDot);
  }
  /// Updates the held states of point laws at the end of a step, then complete().
  void accept(State& state) {
    model_->states().accept(state.t, state.q.data(), state.v.data(), state.x.data());
    complete(state);
  }

  /// Select the points to evaluate in a step of length h from (t, q).
  void look(double t, double h, const double* q);
  /// True if a point that was not evaluated touches at q; it is active afterwards.
  bool missed(const double* q);

  /// Rates for a motion from `state` to the time `end`. The points lose the results of their last
  /// evaluation.
  LargestRate::Rates largestRates(const State& state, double end) {
    return LargestRate(*model_, mass_)(state, end);
  }

  /// Damping rate of laws without walls at `state`. The points lose the same results.
  double rateOfLaws(const State& state) { return LargestRate(*model_, mass_).ofDampingLaws(state); }

  CompiledModel& model() { return *model_; }

 private:
  void evaluate(double t, const Vector& q, const Vector& v, const Vector& x, Vector& a,
                Vector& xDot);

  CompiledModel* model_ = nullptr;
  Counters* counters_ = nullptr;
  linalg::BlockFactor mass_;
};

/// Detects swinging forces. If a law without a wall, such as that of a bit, is too steep for the
/// steps, its bounded force keeps the motion from growing without bound. The force swings about its
/// value from stage to stage, and the bit slides where it should stick. The mean of the stages then
/// differs from that of both ends.
class ForceSwings {
 public:
  /// Starts with the current forces.
  void bind(const CompiledModel& model);
  /// Adds the forces at the second, third or fourth stage of a step; the first stage is the end of
  /// the previous step.
  void addStage(const CompiledModel& model, int stage);
  /// Call after the step, with the forces at its end, which is the start of the next.
  void endStep(const CompiledModel& model);
  /// Fraction of the steps in which a force swings, the largest of all ranks. Collective.
  double share(const CompiledModel& model) const;
  void save(std::vector<double>& memory) const;
  void restore(const double*& memory);

 private:
  struct Seen {
    double atEnd = 0, mean = 0, largest = 0;
    int steps = 0;  ///< consecutive steps with a different mean
  };
  template <class Each>
  void forEach(const CompiledModel& model, const Each& each);

  std::vector<Seen> seen_;  ///< per coordinate of the points
  double steps_ = 0, swinging_ = 0;
};

/// Stages of one classical Runge-Kutta step (Nguyen et al. 2020, (B.1)-(B.5), with k41, k42 for
/// k31, k32 as printed in (B.4)).
class RungeKuttaStep {
 public:
  void resize(const State& like);
  /// q, v and x of `to`, a time h after `from`, which must be complete.
  void take(ExplicitRightHandSide& rhs, const State& from, double h, State& to,
            ForceSwings* swings = nullptr);

 private:
  Vector qi_, vi_, vj_, a2_, a3_, a4_;
  Vector xi_, x2_, x3_, x4_;  ///< states of point laws: a stage, and rates
};

}  // namespace tooljoint::transient
