// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `Generalized-alpha`: Chung and Hulbert (1993) in the form of Arnold and Bruels (2007). All
/// forces, contact included, are balanced at t_{n+1}:
///
///     M q''_{n+1} + C v_{n+1} + K q_{n+1} = F(t_{n+1}) + R' f(q_{n+1}, v_{n+1}, t_{n+1})
///     (1 - am) A_{n+1} + am A_n = (1 - af) q''_{n+1} + af q''_n
///     q_{n+1} = q_n + h v_n + h^2 ((1/2 - b) A_n + b A_{n+1}),   v_{n+1} = v_n + h ((1 - g) A_n +
///     g A_{n+1})
///
/// with am = (2r - 1)/(r + 1), af = r/(r + 1), g = 1/2 - am + af, b = (1 + af - am)^2 / 4 and r the
/// spectral radius at infinite frequency. For a constant M this is equivalent to averaging the
/// forces: second order in q and v, unconditionally stable for linear problems.
///
/// States of point laws, x' = g, are integrated by the formula of the velocity:
///
///     (1 - am) X_{n+1} + am X_n = (1 - af) x'_{n+1} + af x'_n
///     x_{n+1} = x_n + h ((1 - g) X_n + g X_{n+1})
///
/// (Jansen, Whiting and Hulbert 2000 in the same form).
///
/// A step in which a point meets a wall is halved until its rebound is that of the wall
/// (ImpactResolution), one across a peak of friction until it sees the peak (FrictionPeaks).
/// Contact that comes to rest on a wall too stiff for the step stays there without rebound, because
/// averaging its force over two steps would generate energy (up to eight times the incoming
/// energy). The force acts in full over the step in which it arises, and not beyond, as in Kane,
/// Repetto, Ortiz and Marsden (1999) and Chen, Acary, Virlez and Bruels (2013):
///
///     q_{n+1} = ... + h^2/2 M^-1 R'f,   v_{n+1} = ... + h M^-1 R'f   (with the v of the scheme for
///     that q),   A without f
///
/// which never generates energy, and is of first order where it is used.
///
/// The nonlinear equations are those of ImplicitStep; a step is halved if they do not converge.
///
/// With `Step Tolerance` the step is chosen by its error (StepControl), the error of the
/// displacement in one step. It consists of the third-order term of the series that the scheme does
/// not match (Zienkiewicz and Xie 1991), and of the whole motion due to impacts, whose time is
/// known only within the step:
///
///     e = (d/2 + b - 1/6) h^2 (A_{n+1} - A_n) + h^2/2 M^-1 R'f,   d = am - af
#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/report/Log.hpp"
#include "transient/Integrator.hpp"
#include "transient/Tuned.hpp"
#include "transient/accuracy/FrictionPeaks.hpp"
#include "transient/accuracy/NumericalDamping.hpp"
#include "transient/accuracy/StepControl.hpp"
#include "transient/accuracy/StepGrid.hpp"
#include "transient/contact/ImpactResolution.hpp"
#include "transient/schemes/AlphaStep.hpp"
#include "transient/schemes/DefaultStep.hpp"

namespace tooljoint::transient {
namespace {

constexpr double defaultTolerance = 1e-5, defaultRadius = 0.8;
/// Motion over the error allowed in a step. With step errors proportional to the square of the step
/// length, a motion 10 times as large has an error of 20 %, one 100 times as large 5 %. A motion
/// below the second value is rest.
constexpr double smallMotion = 100, restingMotion = 1e-2;

std::vector<std::string> strategyTitles() {
  std::vector<std::string> titles;
  for (const auto& name : strategyNames) titles.emplace_back(name.deck);
  return titles;
}

StrategySet leftOut(const Teuchos::ParameterList& own) {
  StrategySet set;
  if (!own.isParameter("Leave Out")) return set;
  const auto titles = own.get<Teuchos::Array<std::string>>("Leave Out");
  for (std::size_t i = 0; i < strategyCount; ++i)
    set[i] = contains(titles, std::string(strategyNames[i].deck));
  return set;
}

deck::ListSpec generalizedAlphaParameters() {
  return deck::ListSpec("Generalized-alpha", "Parameters of the generalized-alpha integrator.")
      .real("Spectral Radius", "", defaultRadius, deck::Range::between(0.0, 1.0),
            "Spectral radius at infinite frequency: 1 keeps all frequencies, 0 removes those above "
            "the step in one step.")
      .real("Tolerance", "", defaultTolerance, deck::Range::positive(),
            "Newton stops when the residual, scaled by the diagonal of the effective matrix, falls "
            "below this times the largest "
            "force scaled alike.")
      .integer("Max Iterations", 25, deck::Range::atLeast(1),
               "Newton iterations before a step is halved.")
      .expert()
      .integer("Max Halvings", 4, deck::Range::between(0, 16),
               "Times a step may be halved before the run stops.")
      .expert()
      .real("Step Tolerance", "m", deck::Optional{}, deck::Range::positive(),
            "Error of the displacement allowed in one step, as root of the mean square over the "
            "mass. Steps are then Transient/Step "
            "halved until their error is below it; without it all steps are equal.")
      .real("Smallest Step", "s", deck::Optional{}, deck::Range::positive(),
            "With Step Tolerance: a step that would have to be shorter than this ends the run; by "
            "default 1/1024 of Transient/Step.")
      .expert()
      .boolean("Phase Correction", true,
               "Correct the period error of the scheme: vibration is then accurate to fourth order "
               "in the step (to second order with strong gyroscopic or other damping terms), at "
               "about a third more work per step.")
      .boolean(
          "Resolve Impacts", true,
          "Halve steps in which a point meets a wall, until its rebound is that of the wall, and "
          "steps in which sliding reverses across a peak of friction, also where Step Tolerance "
          "would allow longer ones. Without, impacts on walls too stiff for the step have no "
          "rebound, and points slide on where friction should hold them.")
      .expert()
      .textArray("Leave Out", deck::Optional{}, strategyTitles(),
                 "Strategies of a step that are not used: what each wins is measured so.")
      .expert()
      .boolean("Accept Unconverged", false,
               "Go on with the last iterate of a step that failed after all halvings; such steps "
               "are counted and reported.")
      .expert();
}

/// The halves use a tighter tolerance than the run, so that the error of its iterations is measured
/// too.
constexpr double strictness = 0.1;

class GeneralizedAlpha final : public Integrator, public NumericalDamping {
 public:
  explicit GeneralizedAlpha(const Teuchos::ParameterList& given) {
    const auto own = withDefaults(given, generalizedAlphaParameters());
    tolerance_ = own.get<double>("Tolerance");
    parameters_ = {own.get<double>("Spectral Radius"),
                   own.get<bool>("Phase Correction"),
                   {tolerance_, own.get<int>("Max Iterations"), leftOut(own)}};
    maxHalvings_ = own.get<int>("Max Halvings");
    acceptUnconverged_ = own.get<bool>("Accept Unconverged");
    resolveImpacts_ = own.get<bool>("Resolve Impacts");
    controlled_ = own.isParameter("Step Tolerance");
    if (controlled_) stepTolerance_ = own.get<double>("Step Tolerance");
    if (own.isParameter("Smallest Step")) smallest_ = own.get<double>("Smallest Step");
  }

  bool carriesPointStates() const override { return true; }
  bool dividesAmongRanks() const override { return true; }
  bool followsCorners() const override { return true; }
  bool followsCornersOfMatrices() const override { return true; }
  /// The ledger books two steps of equal length together.
  int ledgerStride() const override { return controlled_ ? 1 : 2; }
  std::string advice() const override {
    return std::string("Reduce ") +
           (controlled_ ? "Transient/Generalized-alpha/Step Tolerance" : "Transient/Step") +
           ", and only if that does not help Transient/Generalized-alpha/Spectral Radius, which "
           "damps vibration";
  }
  std::string stepAdvice() const override;
  double dissipated(const State& from, const State& to) const override {
    return scheme_->dissipated(from, to, to.t - from.t);
  }
  std::string dampingAdvice() const override {
    return "Set Transient/Generalized-alpha/Spectral Radius nearer to 1, or reduce Transient/Step.";
  }
  bool hasUnresolvedContact() const override { return scheme_->restsOnImpacts(); }
  void checkParameters(double step) const override;
  void prepare(CompiledModel& model, const Window& window, State& state) override;
  void advance(const State& from, State& to) override;
  bool judgesSteps() const override { return controlled_; }
  double equalStep() const override { return controlled_ ? 0.0 : grid_.length(0); }
  /// PhaseCorrection contains only mass and stiffness.
  bool followsPhase(bool gyroscopic) const override {
    return parameters_.phaseCorrection && !gyroscopic;
  }
  void saveHistory(std::vector<double>& history) const override;
  void prepareRetaking(const Integrator& run, CompiledModel& model, const Window& window,
                       const State& start) override;
  void startAgain(const double* history, State& from) override;
  void sharpen() override {
    parameters_.equations.tolerance *= strictness;
    parameters_.radius = 1.0;
    impacts_.halve();
  }
  void carry(CarriedMemory& memory) const override;
  void takeUp(const CarriedMemory& memory) override;
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;

 private:
  static double longestStep(const Window& window);
  void bind(CompiledModel& model, const Window& window, double t);
  void watchMotion(const State& to);
  bool isAccurate(const State& from, double h);
  bool resolvesImpacts(const State& from, const State& to, double h);
  bool resolvesFriction(const State& from, const State& to, double h);
  int deepestLevel(double longest) const;
  [[noreturn]] void giveUp(const State& from, double h) const;
  [[noreturn]] void giveUpAccuracy(const State& from, double h);
  [[noreturn]] void giveUpImpacts(const State& from, double h) const;
  std::string describeFailure(double t, double h) const;

  AlphaStep::Parameters parameters_;
  std::optional<AlphaStep> scheme_;
  double tolerance_;
  int maxHalvings_;
  bool acceptUnconverged_, resolveImpacts_;
  bool controlled_ = false;  ///< steps are chosen by their error
  double stepTolerance_ = 0, smallest_ = 0;

  CompiledModel* model_ = nullptr;
  StepGrid grid_;
  StepControl control_;
  ImpactResolution impacts_;
  FrictionPeaks peaks_;
  MassNorm length_;
  double error_ = 0;              ///< in the current step [m]
  Vector start_, way_;            ///< controlled steps: initial displacement; motion since
  double end_ = 0, largest_ = 0;  ///< of the run [s]; largest motion in the norm of the error [m]
};

void GeneralizedAlpha::prepare(CompiledModel& model, const Window& window, State& state) {
  checkParameters(window.step);
  scheme_.emplace(parameters_);
  scheme_->start(model, longestStep(window), state, counters_);
  start_ = way_ = state.q;
  end_ = window.end;
  bind(model, window, state.t);
  if (!resolveImpacts_) return;
  grid_.setLevel(
      std::min(grid_.deepest(), impacts_.halvingsAtStart(state, grid_.length(grid_.level()))));
}

/// For fixed steps. The mass is that of the run.
void GeneralizedAlpha::prepareRetaking(const Integrator& run, CompiledModel& model,
                                       const Window& window, const State& start) {
  parameters_.equations.tolerance *= strictness;
  scheme_.emplace(parameters_);
  scheme_->startLike(*static_cast<const GeneralizedAlpha&>(run).scheme_);
  bind(model, window, start.t);
}

double GeneralizedAlpha::longestStep(const Window& window) {
  return fittedStep(window, window.step > 0 ? window.step : defaultAlphaStep);
}

void GeneralizedAlpha::bind(CompiledModel& model, const Window& window, double t) {
  model_ = &model;
  const double step = longestStep(window);
  scheme_->prepare(step, t);
  resolveImpacts_ = resolveImpacts_ && !model.points().empty() && scheme_->mass().regular();
  const int deepest = controlled_ ? deepestLevel(step) : maxHalvings_;
  grid_.set(window, step, resolveImpacts_ ? std::max(deepest, StepGrid::mostHalvings) : deepest);
  if (controlled_) control_.set(stepTolerance_, deepest, grid_.deepest());
  length_.bind(model);
  if (!resolveImpacts_) return;
  scheme_->invertMass();
  impacts_.bind(model, scheme_->mass(), scheme_->parameters().radius);
  peaks_.bind(model, scheme_->mass());
}

void GeneralizedAlpha::saveHistory(std::vector<double>& history) const {
  history.push_back(grid_.level());
  scheme_->saveHistory(history);
  if (resolveImpacts_) impacts_.save(history);
}

void GeneralizedAlpha::startAgain(const double* history, State& from) {
  grid_.startAt(from.t);
  grid_.setLevel(static_cast<int>(*history++));
  scheme_->startAgain(history, grid_.length(grid_.level()), from);
  if (resolveImpacts_) impacts_.restore(history);
}

void GeneralizedAlpha::checkParameters(double step) const {
  if (!(smallest_ > 0)) return;
  if (!controlled_)
    throw DeckError(
        "Transient/Generalized-alpha/Smallest Step bounds the steps that "
        "Transient/Generalized-alpha/Step Tolerance chooses, which "
        "is not given. Give it, or leave Smallest Step out.");
  const double longest = step > 0 ? step : defaultAlphaStep;
  if (smallest_ <= longest) return;
  std::ostringstream text;
  text << "Transient/Generalized-alpha/Smallest Step (" << smallest_
       << " s) is longer than the longest step, Transient/Step (" << longest << " s).";
  throw DeckError(text.str());
}

/// Halvings of the longest step down to the shortest allowed step.
int GeneralizedAlpha::deepestLevel(double longest) const {
  constexpr int defaultDeepest = 10;
  if (!(smallest_ > 0)) return defaultDeepest;
  return std::clamp(static_cast<int>(std::floor(std::log2(longest / smallest_) + Tuned::rounding)),
                    0, StepGrid::mostHalvings);
}

void GeneralizedAlpha::advance(const State& from, State& to) {
  double h = 0;
  for (int failures = 0;;) {
    to.t = grid_.next();
    h = grid_.nextLength(from.t);
    const bool last = grid_.level() >= grid_.deepest() || failures >= maxHalvings_;
    if (scheme_->take(from, to, h, last && acceptUnconverged_, counters_)) {
      if ((!controlled_ || isAccurate(from, h)) && resolvesImpacts(from, to, h) &&
          resolvesFriction(from, to, h))
        break;
      ++counters_.rejected;
      continue;
    }
    if (last) giveUp(from, h);
    grid_.setLevel(grid_.level() + 1);
    ++failures;
    ++counters_.halved;
    control_.forget();
  }
  scheme_->keep();
  counters_.accept(h);
  if (controlled_) watchMotion(to);
  grid_.advance();
  if (resolveImpacts_) impacts_.keep(to, h);
  const int accurate =
      controlled_ ? control_.next(error_, grid_.level(), grid_.done()) : grid_.lowest(0);
  const int level =
      resolveImpacts_ ? std::max(accurate, impacts_.nextLevel(to, h, grid_)) : accurate;
  if (level == grid_.level()) return;
  grid_.setLevel(level);
  if (controlled_) control_.lengthened();
  if (resolveImpacts_) impacts_.lengthened();
}

/// Warns at the end of a motion that is not much larger than the error allowed in a step.
void GeneralizedAlpha::watchMotion(const State& to) {
  if (counters_.steps % Tuned::lookStride != 0 && to.t < end_) return;
  way_ = to.q - start_;
  largest_ = std::max(largest_, length_(way_));
  if (to.t < end_ || largest_ <= restingMotion * stepTolerance_ ||
      largest_ >= smallMotion * stepTolerance_)
    return;
  std::ostringstream text;
  text.precision(2);
  text << "Transient/Generalized-alpha/Step Tolerance (" << stepTolerance_
       << " m) is coarse for this motion, which is only " << largest_ / stepTolerance_
       << " times as large (root of the mean square over the mass); the errors of steps add up. "
          "Lower it.";
  log::warn(text.str());
}

/// False, with a deeper level, if the error of the last step is too large.
bool GeneralizedAlpha::isAccurate(const State& from, double h) {
  error_ = length_(scheme_->localError(h, true));
  if (control_.accepts(error_)) return true;
  const int level = control_.shorter(error_, grid_.level());
  if (level > control_.deepest()) giveUpAccuracy(from, h);
  grid_.setLevel(level);
  return false;
}

/// False, with a deeper level, if the last step does not resolve its impacts.
bool GeneralizedAlpha::resolvesImpacts(const State& from, const State& to, double h) {
  const int missing = resolveImpacts_ ? impacts_.halvings(from, to, h) : 0;
  if (missing == 0) return true;
  if (grid_.level() + missing > grid_.deepest()) giveUpImpacts(from, std::ldexp(h, -missing));
  grid_.setLevel(grid_.level() + std::min(missing, Tuned::atATime));
  control_.forget();
  return false;
}

/// False, with a deeper level, if the last step passes over a peak of friction.
bool GeneralizedAlpha::resolvesFriction(const State& from, const State& to, double h) {
  if (!resolveImpacts_ || grid_.level() >= grid_.deepest() || peaks_.resolved(from, to, h))
    return true;
  grid_.setLevel(grid_.level() + 1);
  control_.forget();
  return false;
}

std::string GeneralizedAlpha::stepAdvice() const {
  std::ostringstream text;
  text << "Reduce Transient/Step or set Transient/Generalized-alpha/Step Tolerance.";
  if (tolerance_ > defaultTolerance)
    text << " The iteration tolerance (Transient/Generalized-alpha/Tolerance = " << tolerance_
         << ") adds to the error.";
  const auto& points = model_->points();
  const bool hits = model_->cut().any(std::any_of(
      points.begin(), points.end(), [](const auto& batch) { return batch.isScaled(); }));
  if (hits && !resolveImpacts_)
    text << " Contact is too stiff for this step and has no rebound. Leave "
            "Transient/Generalized-alpha/Resolve Impacts switched on.";
  return text.str();
}

std::string GeneralizedAlpha::describeFailure(double t, double h) const {
  std::ostringstream text;
  text << "Newton did not converge in the step from t = " << t << " s (length " << h << " s after "
       << grid_.level() << " halvings): the residual is " << scheme_->equation().relativeError()
       << " of the largest force, tolerance " << tolerance_ << ", worst at "
       << scheme_->equation().worstName() << ".";
  return text.str();
}

void GeneralizedAlpha::giveUp(const State& from, double h) const {
  throw ConvergenceError(
      describeFailure(from.t, h) +
      " Reduce Transient/Step, allow more Transient/Generalized-alpha/Max Halvings, or check that "
      "node (contact stiffness, regularisation, friction velocity).");
}

void GeneralizedAlpha::giveUpAccuracy(const State& from, double h) {
  std::ostringstream text;
  text << "Generalized-alpha needs a step below " << h << " s at t = " << from.t
       << " s: the displacement is wrong by " << error_ << " m in one step, tolerance "
       << stepTolerance_ << " m, most at " << model_->worstName(scheme_->lastError())
       << ". Raise Transient/Generalized-alpha/Step Tolerance, or allow a shorter "
          "Transient/Generalized-alpha/Smallest Step.";
  throw ConvergenceError(text.str());
}

void GeneralizedAlpha::giveUpImpacts(const State& from, double h) const {
  std::ostringstream text;
  text << "An impact at t = " << from.t << " s needs steps of " << h << " s, "
       << "shorter than Transient/Step / 2^" << StepGrid::mostHalvings
       << ". Reduce Transient/Step or the stiffness of the wall.";
  throw ConvergenceError(text.str());
}

/// The grid of steps starts at the state.
void GeneralizedAlpha::carry(CarriedMemory& memory) const {
  scheme_->carry(memory);
  memory.numbers.push_back(grid_.level());
  control_.save(memory.numbers);
  if (resolveImpacts_) impacts_.carry(memory.numbers);
}

void GeneralizedAlpha::takeUp(const CarriedMemory& memory) {
  const double* number = memory.numbers.data();
  scheme_->takeUp(memory.vectors, number);
  grid_.setLevel(static_cast<int>(*number++));
  control_.restore(number);
  if (resolveImpacts_) impacts_.takeUp(number);
}

void GeneralizedAlpha::save(std::vector<double>& memory) const {
  grid_.save(memory);
  scheme_->save(memory);
  if (resolveImpacts_) impacts_.save(memory);
  control_.save(memory);
}

void GeneralizedAlpha::restore(const double*& memory) {
  grid_.restore(memory);
  scheme_->restore(memory);
  if (resolveImpacts_) impacts_.restore(memory);
  control_.restore(memory);
}

const bool generalizedAlphaRegistered = IntegratorRegistry::instance().add(
    "Generalized-alpha", {"Implicit, second order, with numerical damping of high frequencies only "
                          "(Chung and Hulbert 1993, Arnold and Bruels 2007); "
                          "contact is balanced at the end of each step.",
                          generalizedAlphaParameters(), [](const Teuchos::ParameterList& own) {
                            return std::make_unique<GeneralizedAlpha>(own);
                          }});

}  // namespace
}  // namespace tooljoint::transient
