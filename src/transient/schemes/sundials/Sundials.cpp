// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `SUNDIALS ARKODE` (diagonally implicit Runge-Kutta) and `SUNDIALS CVODE` (backward
/// differentiation) for y = (q, v, rated states of point laws), with the error of each step limited
/// by
///
///     sqrt( 1/N sum_i (e_i / (rtol s_i + atol_i))^2 ) <= 1,
///     s_i = |v_i| and the tolerance of velocities for v, min(|y_i|, 1) and that of positions else
///
/// Both choose their steps; samples are interpolated. Held states of point laws change at the end
/// of a step; if that changes a force, the method restarts.
#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include "common/Error.hpp"
#include "common/report/Log.hpp"
#include "transient/Integrator.hpp"
#include "transient/schemes/sundials/SundialsStepper.hpp"

namespace tooljoint::transient {
namespace {

constexpr const char* arkode = "SUNDIALS ARKODE";
constexpr const char* cvode = "SUNDIALS CVODE";

/// Motion smaller than this is not resolved with the relative tolerance [m], [m/s].
constexpr double usualLength = 0.01;
constexpr double usualVelocity = 1.0;

/// Limits above which the tolerances of a method are fine enough for a motion. They were measured
/// on undamped oscillators of 5 and 50 Hz over 3 s (SundialsTest.cpp), where errors accumulate
/// without decay: the error of a motion within both limits is at most 20 %. BDF has other limits,
/// because its errors are closer to the tolerance.
struct Fineness {
  double motion;  ///< least motion, in tolerances, in the norm of the error
  double steps;   ///< most steps per such tolerance in the first `judged` seconds
};
constexpr Fineness fineRungeKutta{1e3, 0.8}, fineBdf{3e3, 2.0};
constexpr double judged = 3.0;  ///< [s], the same as for equal steps
/// Motion below this is rest.
constexpr double restingMotion = 1e-2;

void addCommon(deck::ListSpec& spec, double tolerance) {
  spec.real("Relative Tolerance", "", tolerance, deck::Range::positive(),
            "Error of a step allowed in each coordinate and velocity, relative to its size. A "
            "coordinate counts up to 1 m or 1 rad: turns made before do not loosen it.")
      .real("Absolute Tolerance", "m", deck::Optional{}, deck::Range::positive(),
            "Error of a step allowed in displacements in addition to that, and by the same number "
            "in rotations (rad), coordinates of modes and states of point laws; by default 0.01 m "
            "times Relative Tolerance.")
      .expert()
      .real("Absolute Velocity Tolerance", "m/s", deck::Optional{}, deck::Range::positive(),
            "The same for velocities; by default 1 m/s times Relative Tolerance.")
      .expert()
      .real("Initial Step", "s", deck::Optional{}, deck::Range::positive(),
            "Length of the first step; by default Transient/Step, and without that what SUNDIALS "
            "estimates.")
      .expert()
      .real(
          "Maximum Step", "s", deck::Optional{}, deck::Range::positive(),
          "Longest step allowed; by default Sampling Interval. Steps also end where a law of time "
          "has a corner.")
      .expert()
      .integer("Maximum Newton Iterations", 3, deck::Range::atLeast(2),
               "Newton iterations before a step is tried shorter.")
      .expert()
      .integer("Maximum Steps", 100000000, deck::Range::atLeast(1),
               "Steps after which the run stops as one that cannot be afforded.")
      .expert();
}

deck::ListSpec arkodeSpecification() {
  deck::ListSpec spec(arkode, "Parameters of ARKODE.");
  spec.choice(
          "Method", std::string("ESDIRK436L2SA_6_3_4"),
          {"SDIRK_2_1_2", "TRBDF2_3_3_2", "ESDIRK324L2SA_4_2_3", "ESDIRK325L2SA_5_2_3",
           "SDIRK_5_3_4", "KVAERNO_5_3_4", "ESDIRK436L2SA_6_3_4", "QESDIRK436L2SA_6_3_4",
           "ESDIRK437L2SA_7_3_4", "KVAERNO_7_4_5", "ESDIRK547L2SA_7_4_5", "ESDIRK547L2SA2_7_4_5"},
          "Butcher table by its name in SUNDIALS, which ends in stages, order of the error "
          "estimate "
          "and order.")
      .expert();
  addCommon(spec, 1e-4);
  return spec;
}

deck::ListSpec cvodeSpecification() {
  deck::ListSpec spec(cvode, "Parameters of CVODE.");
  spec.integer("Maximum Order", 2, deck::Range::between(1, 5),
               "Highest order of the formulas. Above 2 they are unstable for lightly damped "
               "vibration, and the fastest vibration of "
               "the mesh then bounds the step.");
  addCommon(spec, 1e-5);
  return spec;
}

class Sundials final : public Integrator {
 public:
  Sundials(const std::string& name, const Teuchos::ParameterList& given) : name_(name) {
    const auto own =
        withDefaults(given, name == arkode ? arkodeSpecification() : cvodeSpecification());
    options_.relative = own.get<double>("Relative Tolerance");
    const auto asked = [&own](const char* parameter, double usual) {
      return own.isParameter(parameter) ? own.get<double>(parameter) : usual;
    };
    options_.positions = asked("Absolute Tolerance", usualLength * options_.relative);
    options_.velocities = asked("Absolute Velocity Tolerance", usualVelocity * options_.relative);
    options_.maxIterations = own.get<int>("Maximum Newton Iterations");
    options_.firstStep = asked("Initial Step", 0.0);
    options_.maxStep = asked("Maximum Step", 0.0);
    if (name == arkode) options_.table = own.get<std::string>("Method");
    if (name == cvode) options_.maxOrder = own.get<int>("Maximum Order");
    maxSteps_ = own.get<int>("Maximum Steps");
  }

  bool carriesPointStates() const override { return true; }
  bool judgesSteps() const override { return true; }
  std::string advice() const override {
    return "Reduce Transient/" + name_ +
           "/Relative Tolerance and the absolute tolerances there if given, or use the "
           "integrator \"Generalized-alpha\"";
  }
  void checkParameters(double step) const override {
    const double first = options_.firstStep > 0 ? options_.firstStep : step;
    if (!(options_.maxStep > 0) || first <= options_.maxStep) {
      requireLibrary();
      return;
    }
    std::ostringstream text;
    text << "The first step (" << first << " s, "
         << (options_.firstStep > 0 ? "Transient/" + name_ + "/Initial Step" : "Transient/Step")
         << ") is longer than Transient/" << name_ << "/Maximum Step (" << options_.maxStep
         << " s).";
    throw DeckError(text.str());
  }

  void prepare(CompiledModel& model, const Window& window, State& state) override {
    checkParameters(window.step);
    form_.bind(model, name_);
    window_ = window;
    if (!(options_.firstStep > 0)) options_.firstStep = window.step;
    if (!(options_.maxStep > 0)) options_.maxStep = window.sampling;
    form_.setStates(state.x);
    y_.setZero(form_.size());
    form_.pack(state, y_.data());
    start_ = y_;
    judgedUntil_ = window.begin + judged;
    stepper_ = makeStepper();
    firstStep_ = options_.firstStep;
    restart(state);
    form_.complete(state);
    count();
  }

  /// To the next sample, or to the end of the current step if that is earlier.
  void advance(const State& from, State& to) override {
    if (beginsAnew_) beginAnew(from);
    if (!(stepper_->time() > from.t)) step(from);
    const double reached = stepper_->time();
    const double sample = nextSample(from.t);
    to.t = sample < reached - 1e-6 * window_.sampling ? sample : reached;
    stepper_->at(to.t, y_.data());
    form_.unpack(y_.data(), to);
    form_.complete(to);
    ended_ = to.t == reached;
    if (ended_ && form_.accept(to, options_.relative) && to.t < window_.end)
      beginsAnew_ = true, firstStep_ = 0.0;
    count();
    if (ended_) measure(to.t);
    if (!(to.t < window_.end)) warnOfTolerances();
  }

  void save(std::vector<double>& memory) const override {
    memory.insert(memory.end(), {firstStep_, ended_ ? 1.0 : 0.0, largest_, early_, judgedUntil_});
  }
  void restore(const double*& memory) override {
    firstStep_ = *memory++;
    ended_ = *memory++ != 0.0;
    largest_ = *memory++;
    early_ = *memory++;
    judgedUntil_ = *memory++;
    beginsAnew_ = true;
  }

  /// SUNDIALS neither returns nor accepts its history (Nordsieck array, earlier errors and steps,
  /// age of the Newton matrix).
  bool goesOnFromAnywhere() const override { return false; }
  void forgetHistory() override {
    // BDF restarts at first order, with a step of its own choice
    firstStep_ = name_ == arkode ? stepper_->nextStep() : 0.0;
    beginsAnew_ = true;
  }

 private:
  std::unique_ptr<SundialsStepper> makeStepper();

  /// Throws if makeStepper() cannot create a stepper.
  void requireLibrary() const {
#ifndef TOOLJOINT_HAS_SUNDIALS
    throw DeckError("Transient/Integrator: this program was built without SUNDIALS, which \"" +
                    name_ +
                    "\" needs. Install libsundials-dev and configure with -D "
                    "TOOLJOINT_SUNDIALS=ON, or choose \"Generalized-alpha\".");
#endif
  }

  void restart(const State& from) {
    form_.pack(from, y_.data());
    stepper_->restart(from.t, y_.data(), window_.end, firstStep_);
  }

  /// Restarts from a checkpoint, or where a held state has changed a force, with the current step
  /// but without the history of the method. The rest of a longer step is dropped: the step then
  /// ends here, also for the held states.
  void beginAnew(const State& from) {
    beginsAnew_ = false;
    form_.setStates(from.x);
    if (!ended_) {
      State end = from;
      form_.accept(end, options_.relative);
    }
    restart(from);
    seen_ = {};
    evaluations_ = form_.evaluations();
    factorisations_ = form_.factorisations();
  }

  void step(const State& from) {
    if (counters_.steps >= maxSteps_) {
      std::ostringstream text;
      text << name_ << " has taken " << counters_.steps << " steps by t = " << from.t
           << " s, as many as Transient/" << name_ << "/Maximum Steps allows; the step is now "
           << stepper_->nextStep()
           << " s. Raise Relative Tolerance, Absolute Tolerance and Absolute Velocity Tolerance "
              "there, or allow more steps.";
      throw ConvergenceError(text.str());
    }
    const double before = stepper_->time();
    stepper_->stopAt(form_.model().timed().nextCorner(before, window_.end));
    const SundialsTrouble trouble = stepper_->step();
    count();
    if (trouble != SundialsTrouble::None) giveUp(from, trouble);
    if (!(stepper_->time() > before)) giveUp(from, SundialsTrouble::Accuracy);
    counters_.accept(stepper_->lastStep());
  }

  /// sqrt(1/2n sum ((y_i - y_i(0)) / (rtol |y_i| + atol_i))^2) over q and v: the motion in the norm
  /// of the error.
  double motion() const {
    const auto n = static_cast<Eigen::Index>(form_.dofs());
    double sum = 0;
    for (Eigen::Index i = 0; i < 2 * n; ++i) {
      const double allowed =
          i < n ? options_.allowedPosition(y_[i]) : options_.allowedVelocity(y_[i]);
      sum += std::pow((y_[i] - start_[i]) / allowed, 2);
    }
    return std::sqrt(sum / static_cast<double>(2 * n));
  }

  void measure(double t) {
    largest_ = std::max(largest_, motion());
    if (t <= judgedUntil_ && largest_ > 0) early_ = static_cast<double>(counters_.steps) / largest_;
  }

  void warnOfTolerances() const {
    const Fineness& fine = name_ == arkode ? fineRungeKutta : fineBdf;
    if (largest_ <= restingMotion || (largest_ >= fine.motion && early_ <= fine.steps)) return;
    std::ostringstream text;
    text.precision(2);
    text << "The tolerances of " << name_ << " are coarse for this motion, which is only "
         << largest_
         << " times as large as the error they allow in a step; the errors of steps add up. Lower "
         << "Transient/" << name_
         << "/Relative Tolerance, or Absolute Tolerance and Absolute Velocity Tolerance there.";
    log::warn(text.str());
  }

  double nextSample(double t) const {
    if (!(window_.sampling > 0)) return std::numeric_limits<double>::infinity();
    return window_.begin +
           (std::floor((t - window_.begin) / window_.sampling + 1e-6) + 1) * window_.sampling;
  }

  /// Adds the counts of SUNDIALS and of the form since the last call.
  void count() {
    const SundialsCounts now = stepper_->counts();
    counters_.rejected += now.rejected - seen_.rejected;
    counters_.halved += now.newtonFailures - seen_.newtonFailures;
    counters_.newtonIterations += now.newtonIterations - seen_.newtonIterations;
    counters_.factorisations += form_.factorisations() - factorisations_;
    counters_.rightHandSides += form_.evaluations() - evaluations_;
    seen_ = now;
    factorisations_ = form_.factorisations();
    evaluations_ = form_.evaluations();
  }

  [[noreturn]] void giveUp(const State& from, SundialsTrouble trouble) {
    const double t = stepper_->time();
    const std::string own = "Transient/" + name_ + "/";
    std::ostringstream text;
    // SUNDIALS reports a force that is not finite as a step that cannot be short enough.
    State state = from;
    for (const double later : {0.0, 1e-9 * (window_.end - window_.begin)}) {
      if (!state.a.allFinite()) continue;
      state.t = t + later;
      form_.complete(state);
    }
    if (!state.a.allFinite()) trouble = SundialsTrouble::NotFinite;
    switch (trouble) {
      case SundialsTrouble::Accuracy:
        text << name_ << " needs more digits than numbers have at t = " << t << " s. Raise " << own
             << "Relative Tolerance, Absolute Tolerance or Absolute Velocity Tolerance.";
        break;
      case SundialsTrouble::ErrorTest:
        text << name_ << " cannot hold its tolerances at t = " << t
             << " s however short the step, least at " << form_.nameOf(stepper_->worstPosition())
             << ": a force jumps there. Raise " << own
             << "Absolute Velocity Tolerance and Relative Tolerance, or use the integrator "
                "\"Generalized-alpha\".";
        break;
      case SundialsTrouble::Newton:
        text << "Newton of " << name_ << " does not converge at t = " << t
             << " s however short the step. Allow more " << own
             << "Maximum Newton Iterations, lower the tolerances there, or use the integrator "
                "\"Generalized-alpha\".";
        break;
      case SundialsTrouble::NotFinite: {
        const int worst =
            state.a.allFinite() ? stepper_->worstPosition() : transient::worstPosition(state.a);
        text << "The motion is not finite however short the step of " << name_ << " from t = " << t
             << " s, first at " << form_.nameOf(worst)
             << ": a load, a law of time or a point law gives no number there.";
        break;
      }
      default:
        text << name_ << " stopped at t = " << t << " s: " << stepper_->message() << ".";
    }
    throw ConvergenceError(text.str());
  }

  std::string name_;
  SundialsOptions options_;
  long maxSteps_ = 0;
  FirstOrderForm form_;
  Window window_;
  std::unique_ptr<SundialsStepper> stepper_;
  Vector y_, start_;    ///< first-order form: current, at the start
  double largest_ = 0;  ///< motion() so far
  double early_ = 0;    ///< steps per such tolerance, until judgedUntil_
  double judgedUntil_ = 0;
  SundialsCounts seen_;
  long evaluations_ = 0, factorisations_ = 0;
  double firstStep_ = 0;     ///< of the next restart; 0: chosen by SUNDIALS
  bool ended_ = true;        ///< the last state is the end of a step
  bool beginsAnew_ = false;  ///< restart before the next step
};

#ifdef TOOLJOINT_HAS_SUNDIALS
std::unique_ptr<SundialsStepper> Sundials::makeStepper() {
  return name_ == arkode ? makeArkode(form_, options_) : makeCvode(form_, options_);
}
#else
std::unique_ptr<SundialsStepper> Sundials::makeStepper() {
  return nullptr;
}  // never reached: prepare() refuses before
#endif

const bool registeredArkode = IntegratorRegistry::instance().add(
    arkode, {"Implicit Runge-Kutta methods of SUNDIALS with error control (Reynolds et al. 2023); "
             "needs a mass on every degree of "
             "freedom, and a build with SUNDIALS.",
             arkodeSpecification(), [](const Teuchos::ParameterList& own) {
               return std::make_unique<Sundials>(arkode, own);
             }});

const bool registeredCvode = IntegratorRegistry::instance().add(
    cvode, {"Backward differentiation formulas of SUNDIALS with control of error and order "
            "(Hindmarsh et al. 2005); needs a mass on "
            "every degree of freedom, and a build with SUNDIALS.",
            cvodeSpecification(), [](const Teuchos::ParameterList& own) {
              return std::make_unique<Sundials>(cvode, own);
            }});

}  // namespace
}  // namespace tooljoint::transient
