// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `RK4 adaptive`: classical Runge-Kutta, comparing one step with two half steps, Nguyen et al.
/// 2020, appendix B:
///
///     error = (|q1 - q2|_2 + |v1 - v2|_2) / 15
///     error <= e0/100: keep the half steps, dt := growth * dt
///     error <= e0: keep them;   else dt := dt / shrink and again
///
/// over all coordinates, in their own units, as printed there; |x1 - x2|_2 of the states of point
/// laws is added.
///
/// If a point meets or leaves a wall within the step, the force has a kink, and one step and two
/// half steps can agree on a rebound that both miss. Then half a step is at most 0.5 over the rate
/// of the stiffest contact.
///
/// If a law such as that of a bit is steep, a velocity within the tolerance does not determine its
/// force: steps at the limit of stability would grow until the force swings about its value. So
/// half a step is at most 2 over the damping rate of the laws, which is updated every 100 steps.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "transient/schemes/Explicit.hpp"

namespace tooljoint::transient {
namespace {

/// A warning is given if the errors of the steps in the first `judged` seconds (the same time as
/// for equal steps) add up to more than this part of the motion. Without damping the error of the
/// motion is as large.
constexpr double coarse = 0.05, judged = 3.0;

/// Steps for which the rate of laws is kept: computing it takes some products, and memory.
constexpr int stepsOfARate = 100;

deck::ListSpec rungeKutta4AdaptiveParameters() {
  return deck::ListSpec("RK4 adaptive", "Parameters of the adaptive Runge-Kutta integrator.")
      .real("Tolerance", "", 1e-4, deck::Range::positive(),
            "Threshold e0 of the error of a step, a sum of norms in m, rad, m/s and rad/s.")
      .real("First Step", "s", 1e-5, deck::Range::positive(), "Length of the first step.")
      .expert()
      .real("Growth", "", 1.01, deck::Range::atLeast(1.0),
            "Factor on the step after an error below a hundredth of the tolerance.")
      .expert()
      .real("Shrink", "", 1.1, deck::Range{1.0, 100.0, true, false},
            "Divisor of the step after an error above the tolerance.")
      .expert()
      .real("Smallest Step", "s", 1e-9, deck::Range::positive(),
            "A step that would have to be shorter than this ends the run.")
      .expert();
}

class RungeKutta4Adaptive final : public Integrator {
 public:
  explicit RungeKutta4Adaptive(const Teuchos::ParameterList& given) {
    const auto own = withDefaults(given, rungeKutta4AdaptiveParameters());
    tolerance_ = own.get<double>("Tolerance");
    step_ = own.get<double>("First Step");
    growth_ = own.get<double>("Growth");
    shrink_ = own.get<double>("Shrink");
    smallest_ = own.get<double>("Smallest Step");
  }

  bool isExplicit() const override { return true; }
  bool carriesPointStates() const override { return true; }
  bool dividesAmongRanks() const override { return true; }
  bool judgesSteps() const override { return true; }
  std::string advice() const override {
    return "Reduce Transient/RK4 adaptive/Tolerance, or use the integrator "
           "\"Generalized-alpha\"";
  }

  void prepare(CompiledModel& model, const Window& window, State& state) override {
    rhs_.bind(model, "RK4 adaptive", counters_);
    ++counters_.factorisations;
    stage_.resize(state);
    end_ = window.end;
    judgedUntil_ = std::min(end_, window.begin + judged);
    begin_ = state;
    if (window.step > 0) step_ = window.step;
    whole_ = half_ = state;
    difference_ = state.q;
    const double impact = rhs_.largestRates(state, window.end).impact;
    longestAtWalls_ = impact > 0 ? 2.0 * rungeKuttaImpactLimit / impact : end_ - window.begin;
    boundByLaws(state);
    rhs_.look(state.t, 0.0, state.q.data());
    rhs_.complete(state);
  }

  void advance(const State& from, State& to) override {
    for (;;) {
      // A step ends at the end of the run, or at a corner of a law, without a sliver before it.
      const double end = rhs_.model().timed().nextCorner(from.t, end_), left = end - from.t;
      step_ = std::min(step_, longestOfLaws_);
      const bool last = step_ >= left * (1 - 1e-9);
      const double h = last ? left : step_;
      const double error = tryStep(from, to, h);
      const bool missesImpact = error <= tolerance_ && isLongAtWalls(to, h);
      if (error <= tolerance_ && !missesImpact) {
        to.t = last ? end : from.t + h;
        rhs_.accept(to);
        if (++sinceRate_ >= stepsOfARate) {
          boundByLaws(to);
          rhs_.complete(to);
        }
        addUp(to, error);
        counters_.accept(h);
        if (error <= tolerance_ / 100 && !last) step_ *= growth_;
        return;
      }
      ++counters_.rejected;
      step_ = missesImpact ? longestAtWalls_ : h / shrink_;
      if (step_ < smallest_) giveUp(from, to, error);
    }
  }

  void carry(CarriedMemory& memory) const override { save(memory.numbers); }
  void takeUp(const CarriedMemory& memory) override {
    const double* numbers = memory.numbers.data();
    restore(numbers);
  }
  void save(std::vector<double>& memory) const override {
    memory.insert(memory.end(),
                  {step_, longestAtWalls_, longestOfLaws_, sinceRate_, errors_, largest_});
  }
  void restore(const double*& memory) override {
    step_ = *memory++;
    longestAtWalls_ = *memory++;
    longestOfLaws_ = *memory++;
    sinceRate_ = *memory++;
    errors_ = *memory++;
    largest_ = *memory++;
  }

 private:
  void boundByLaws(const State& state) {
    const double rate = rhs_.rateOfLaws(state);
    longestOfLaws_ =
        rate > 0 ? 2.0 * rungeKuttaLawLimit / rate : std::numeric_limits<double>::infinity();
    sinceRate_ = 0;
  }

  /// Takes two half steps into `to`; returns their error against one whole step (NaN if the step
  /// diverged).
  double tryStep(const State& from, State& to, double h) {
    rhs_.look(from.t, h, from.q.data());
    do {
      stage_.take(rhs_, from, h, whole_);
      stage_.take(rhs_, from, 0.5 * h, half_);
      half_.t = from.t + 0.5 * h;
      rhs_.accept(half_);
      stage_.take(rhs_, half_, 0.5 * h, to);
    } while (rhs_.missed(half_.q.data()) || rhs_.missed(to.q.data()));
    const auto distance = [this](const Vector& a, const Vector& b) {
      difference_ = a - b;
      return std::sqrt(rhs_.model().squaredNorm(difference_));
    };
    return (distance(whole_.q, to.q) + distance(whole_.v, to.v) +
            rhs_.model().states().distance(whole_.x, to.x)) /
           15.0;
  }

  /// Warns if the errors of the judged steps are a significant part of the motion.
  void addUp(const State& to, double error) {
    if (errors_ < 0.0) return;
    errors_ += error;
    const auto length = [this](const Vector& a, const Vector& b) {
      difference_ = a - b;
      return std::sqrt(rhs_.model().squaredNorm(difference_));
    };
    largest_ = std::max(largest_, length(to.q, begin_.q) + length(to.v, begin_.v));
    if (to.t < judgedUntil_) return;
    const double sum = errors_;
    errors_ = -1.0;
    if (sum <= coarse * largest_) return;
    std::ostringstream text;
    text.precision(2);
    text << "Transient/RK4 adaptive/Tolerance (" << tolerance_
         << ") is coarse for this motion: the errors of the steps up to t = " << to.t
         << " s add up to " << 100.0 * sum / largest_ << " % of it. Lower the tolerance.";
    log::warn(text.str());
  }

  /// Whether the last try, from half_ to `to`, meets or leaves a wall with half steps too long for
  /// its impact. Collective.
  bool isLongAtWalls(const State& to, double h) {
    if (h <= longestAtWalls_ * (1 + 1e-9)) return false;
    auto& model = rhs_.model();
    return model.meetsOrLeavesWall(half_.q.data()) || model.meetsOrLeavesWall(to.q.data());
  }

  [[noreturn]] void giveUp(const State& from, const State& to, double error) {
    difference_ = (whole_.q - to.q).cwiseAbs() + (whole_.v - to.v).cwiseAbs();
    std::ostringstream text;
    if (!std::isfinite(error)) {
      text << "The motion is not finite however short the step from t = " << from.t
           << " s, first at " << rhs_.model().worstName(difference_)
           << ": a load, a law of time or a point law gives no number there.";
      throw ConvergenceError(text.str());
    }
    text
        << "RK4 adaptive needs a step below " << smallest_ << " s at t = " << from.t
        << " s: the error " << error << " exceeds the tolerance " << tolerance_ << ", most at "
        << rhs_.model().worstName(difference_)
        << ". Raise Transient/RK4 adaptive/Tolerance, or use the integrator \"Generalized-alpha\".";
    throw ConvergenceError(text.str());
  }

  double tolerance_ = 0, step_ = 0, growth_ = 0, shrink_ = 0, smallest_ = 0, end_ = 0;
  double judgedUntil_ = 0;  ///< [s]
  double errors_ = 0;       ///< sum of the judged steps, in the norm of the tolerance; < 0: judged
  double largest_ = 0;      ///< largest motion and velocity change since the start, in that norm
  State begin_;
  double longestAtWalls_ = 0;  ///< longest step in which a point meets or leaves a wall [s]
  double longestOfLaws_ = 0;   ///< longest step by the rate of laws [s]
  double sinceRate_ = 0;       ///< steps since the last update of the rate
  ExplicitRightHandSide rhs_;
  RungeKuttaStep stage_;
  State whole_, half_;
  Vector difference_;
};

const bool rungeKutta4AdaptiveRegistered = IntegratorRegistry::instance().add(
    "RK4 adaptive", {"Runge-Kutta of fourth order, its step controlled by comparing one step with "
                     "two half steps (Nguyen et al. 2020, appendix "
                     "B).",
                     rungeKutta4AdaptiveParameters(), [](const Teuchos::ParameterList& own) {
                       return std::make_unique<RungeKutta4Adaptive>(own);
                     }});

}  // namespace
}  // namespace tooljoint::transient
