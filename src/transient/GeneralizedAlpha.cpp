// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// `Generalized-alpha`: Chung and Hulbert (1993) in the form of Arnold and Bruels (2007). All forces, contact included, are
/// balanced at t_{n+1}:
///
///     M q''_{n+1} + C v_{n+1} + K q_{n+1} = F(t_{n+1}) + R' f(q_{n+1}, v_{n+1}, t_{n+1})
///     (1 - am) A_{n+1} + am A_n = (1 - af) q''_{n+1} + af q''_n
///     q_{n+1} = q_n + h v_n + h^2 ((1/2 - b) A_n + b A_{n+1}),   v_{n+1} = v_n + h ((1 - g) A_n + g A_{n+1})
///
/// with am = (2r - 1)/(r + 1), af = r/(r + 1), g = 1/2 - am + af, b = (1 + af - am)^2 / 4 and r the spectral radius at infinite
/// frequency. For a constant M this is the scheme that averages forces: second order in q and v, unconditionally stable for
/// linear problems.
///
/// The nonlinear equations are solved by modified Newton with exact tangents: the factor of the effective matrix is kept until
/// convergence is slow, each update is backtracked on the residual scaled by the diagonal of that matrix, and a step that still
/// fails is halved.
#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "common/Error.hpp"
#include "common/Log.hpp"
#include "linalg/BlockFactor.hpp"
#include "transient/Integrator.hpp"
#include "transient/NodalCorrection.hpp"

namespace tooljoint::transient {
namespace {

deck::ListSpec specification() {
  return deck::ListSpec("Generalized-alpha", "Parameters of the generalized-alpha integrator.")
      .real("Spectral Radius", "", 0.8, deck::Range::between(0.0, 1.0),
            "Spectral radius at infinite frequency: 1 keeps all frequencies, 0 removes those above the step in one step. Walls "
            "too stiff for the "
            "step (more than about 1 rad of contact frequency per step) need 0.2 or less.")
      .real("Tolerance", "", 1e-8, deck::Range::positive(),
            "Newton stops when the residual, scaled by the diagonal of the effective matrix, falls below this times the largest "
            "force scaled alike.")
      .integer("Max Iterations", 25, deck::Range::atLeast(1), "Newton iterations before a step is halved.")
      .integer("Max Halvings", 4, deck::Range::between(0, 16), "Times a step may be halved before the run stops.")
      .boolean("Accept Unconverged", false,
               "Go on with the last iterate of a step that failed after all halvings; such steps are counted and reported.");
}

/// Largest step of the default when the deck gives none.
constexpr double defaultStep = 1e-3;
/// A residual that shrinks by less than this factor in an iteration asks for a new factorisation ...
constexpr double slowestRate = 0.5;
/// ... and so does one that would need more iterations than this to converge: a factorisation costs about as much.
constexpr double patience = 5;
/// Iterations in a row that hardly change the residual before the step is given up, and times in a step that points are solved by
/// themselves.
constexpr int maxStalled = 3;
constexpr int maxRescues = 5;

class GeneralizedAlpha final : public Integrator {
 public:
  explicit GeneralizedAlpha(const Teuchos::ParameterList& given) {
    const auto own = withDefaults(given, specification());
    const double r = own.get<double>("Spectral Radius");
    alphaM_ = (2 * r - 1) / (r + 1);
    alphaF_ = r / (r + 1);
    gamma_ = 0.5 - alphaM_ + alphaF_;
    beta_ = 0.25 * (1 + alphaF_ - alphaM_) * (1 + alphaF_ - alphaM_);
    tolerance_ = own.get<double>("Tolerance");
    maxIterations_ = own.get<int>("Max Iterations");
    maxHalvings_ = own.get<int>("Max Halvings");
    acceptUnconverged_ = own.get<bool>("Accept Unconverged");
    units_ = 1L << maxHalvings_;
  }

  int ledgerStride() const override { return 2; }
  void prepare(CompiledModel& model, const Window& window, State& state) override;
  void advance(const State& from, State& to) override;
  void save(std::vector<double>& memory) const override;
  void restore(const double*& memory) override;

 private:
  /// One step of length to.t - from.t; false when Newton fails (unless `keep`, which accepts the last iterate).
  bool attempt(const State& from, State& to, double h, bool keep);
  void startAcceleration(State& state);
  void predict(const State& from, State& to, double h);
  double measure(const State& to);
  /// Whether a new factor is cheaper than going on at this rate of convergence.
  bool isSlow(double rate) const {
    if (rate >= slowestRate) return true;
    const double left = error_ / (tolerance_ * reference_ + floor_);
    return left > 1 && std::log(left) > -std::log(rate) * patience;
  }
  bool converged() const { return error_ <= tolerance_ * reference_ + floor_; }
  bool iterate(State& to, double h);
  void refactor(const State& to, double h);
  void buildFactor();
  bool backtrack(State& to, double h);
  bool solveTroubledPoints(State& to, double h, double before);
  bool bracket(State& to, double beyond, double h);
  void place(State& to, double fraction, double h);
  void findChange(double h);
  /// dv/dq and dq''/dq of the scheme over a step.
  double velocityFactor(double h) const { return gamma_ / (beta_ * h); }
  double accelerationFactor(double h) const { return (1 - alphaM_) / ((1 - alphaF_) * beta_ * h * h); }
  void finish(const State& from, State& to);
  double gridTime() const;
  [[noreturn]] void giveUp(const State& from, double h) const;
  std::string describeFailure(double t, double h) const;

  double alphaM_, alphaF_, beta_, gamma_;
  double tolerance_;
  int maxIterations_, maxHalvings_;
  bool acceptUnconverged_;

  CompiledModel* model_ = nullptr;
  Window window_;
  double step_ = 0;
  long units_ = 16;  ///< sub-steps a full step may be cut into
  long index_ = 0;   ///< full steps done
  long done_ = 0;    ///< units done of the step under way
  int level_ = 0;    ///< halvings in force

  linalg::BlockFactor factor_;
  bool factored_ = false;
  double factorStep_ = 0;  ///< step, time and matrix stamp the factor belongs to
  double factorTime_ = 0;
  long factorStamp_ = -1;
  std::vector<double> factorLaws_;  ///< law values at that time
  bool fresh_ = false;              ///< the tangent in the factor is that of the current iterate
  bool wanted_ = false;             ///< convergence was slow: factor anew at the next iterate

  Vector A_, nextA_;  ///< algorithmic acceleration at t_n, t_{n+1}
  Vector linear_, residual_, delta_, change_;
  NodalCorrection nodal_;
  int rescues_ = 0;  ///< its uses in this step
  Vector base_, saved_, savedChange_;
  Vector q0_, v0_, a0_, linear0_;  ///< iterate to go back to in the line search
  Vector weight_, rowSize_, scratch_;
  double error_ = 0;      ///< max |w R|
  double merit_ = 0;      ///< |w R|_2
  double reference_ = 0;  ///< largest scaled force of this step
  double linearReference_ = 0;
  double floor_ = 0;  ///< rounding of K q, scaled alike
  double worstError_ = 0;
  int worst_ = 0;
};

void GeneralizedAlpha::prepare(CompiledModel& model, const Window& window, State& state) {
  model_ = &model;
  window_ = window;
  step_ = fittedStep(window, window.step > 0 ? window.step : defaultStep);
  const int n = model.size();
  for (Vector* x : {&A_, &nextA_, &linear_, &residual_, &delta_, &change_, &q0_, &v0_, &a0_, &linear0_, &weight_, &scratch_,
                    &base_, &saved_, &savedChange_})
    x->setZero(n);

  factorLaws_.assign(model.lawValues().size(), 0.0);
  // |K| row sums bound the rounding of K q.
  model.setTime(state.t);
  rowSize_ = Vector::Zero(n);
  if (!model.stiffness().empty()) {
    const auto& pattern = model.pattern();
    const double* K = model.stiffness().current();
    for (int b = 0; b < pattern.blocks(); ++b)
      for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e)
        for (int j = 0; j < pattern.width(pattern.column(e)); ++j)
          for (int i = 0; i < pattern.width(b); ++i)
            rowSize_[pattern.start(b) + i] += std::abs(K[pattern.offset(e) + static_cast<std::size_t>(j * pattern.width(b) + i)]);
  }

  nodal_.bind(model);
  factor_ = linalg::BlockFactor(model.pattern());
  startAcceleration(state);
  A_ = state.a;
}

/// M q''_0 = F + R'f - C v - K q; dofs without mass start without acceleration.
void GeneralizedAlpha::startAcceleration(State& state) {
  CompiledModel& model = *model_;
  const int n = model.size();
  for (auto& batch : model.points()) batch.look(state.t, 0.0, state.q.data());
  state.a.setZero();
  model.addStiffness(state.q.data(), state.a.data());
  model.addDamping(state.v.data(), state.a.data());
  state.a = -state.a;
  for (int i = 0; i < n; ++i) state.a[i] += model.load()[i];
  model.addPointForces(state.t, state.q.data(), state.v.data(), state.a.data());
  model.combine(1.0, 0.0, 0.0, factor_.values());
  model.diagonal(1.0, 0.0, 0.0, scratch_.data());
  for (int i = 0; i < n; ++i)
    if (scratch_[i] == 0.0) {
      factor_.values()[model.pattern().address(i, i)] = 1.0;
      state.a[i] = 0.0;
    }
  ++counters_.factorisations;
  const int bad = factor_.factor();
  if (bad < 0) {
    factor_.solve(state.a.data());
    return;
  }
  log::warn("The mass matrix is singular at " + model.dofName(bad) +
            " although there is mass on it: the motion starts without acceleration, with an error of first order in the step.");
  state.a.setZero();
}

double GeneralizedAlpha::gridTime() const {
  const double steps = static_cast<double>(index_) + static_cast<double>(done_) / static_cast<double>(units_);
  const double t = window_.begin + steps * step_;
  return window_.end - t < 1e-9 * step_ ? window_.end : t;
}

void GeneralizedAlpha::advance(const State& from, State& to) {
  double h = 0;
  for (;;) {
    const long stride = units_ >> level_;
    done_ += stride;
    to.t = gridTime();
    const bool last = level_ >= maxHalvings_;
    // The nominal length, equal from step to step to the last digit; shorter only where the run ends.
    h = step_ * static_cast<double>(stride) / static_cast<double>(units_);
    if (to.t >= window_.end && std::abs(to.t - from.t - h) > 1e-9 * h) h = to.t - from.t;
    if (attempt(from, to, h, last && acceptUnconverged_)) break;
    done_ -= stride;
    if (last) giveUp(from, h);
    ++level_;
    ++counters_.halved;
  }
  counters_.accept(h);
  if (done_ == units_) ++index_, done_ = 0;
  // Grow back as soon as the sub-steps done fill a longer one.
  while (level_ > 0 && done_ % (units_ >> (level_ - 1)) == 0) --level_;
}

/// Start from constant algorithmic acceleration; linear_ = M q'' + C v + K q - F there.
void GeneralizedAlpha::predict(const State& from, State& to, double h) {
  CompiledModel& model = *model_;
  model.setTime(to.t);
  for (auto& batch : model.points()) batch.look(from.t, h, from.q.data());
  to.q = from.q + h * from.v + 0.5 * h * h * A_;
  to.v = from.v + h * A_;
  to.a = (A_ - alphaF_ * from.a) / (1 - alphaF_);
  const int n = model.size();
  const Eigen::Map<const Vector> load(model.load(), n);
  double size = load.cwiseProduct(weight_).cwiseAbs().maxCoeff();
  linear_.setZero();
  model.addMass(to.a.data(), linear_.data());
  size = std::max(size, linear_.cwiseProduct(weight_).cwiseAbs().maxCoeff());
  scratch_.setZero();
  model.addStiffness(to.q.data(), scratch_.data());
  size = std::max(size, scratch_.cwiseProduct(weight_).cwiseAbs().maxCoeff());
  model.addDamping(to.v.data(), linear_.data());
  linear_ += scratch_ - load;
  linearReference_ = size;
  floor_ = 4e-16 * rowSize_.cwiseProduct(weight_).cwiseProduct(to.q.cwiseAbs()).maxCoeff();
}

/// Residual and its scaled size at the iterate.
double GeneralizedAlpha::measure(const State& to) {
  scratch_.setZero();
  for (auto& batch : model_->points()) {
    batch.evaluate(to.t, to.q.data(), to.v.data());
    batch.addForce(1.0, scratch_.data());
  }
  double largest = 0;
  double square = 0;
  double force = linearReference_;
  const int n = model_->size();
  const double* f = scratch_.data();
  const double* linear = linear_.data();
  const double* w = weight_.data();
  double* r = residual_.data();
  for (int i = 0; i < n; ++i) {
    r[i] = linear[i] - f[i];
    const double scaled = w[i] * r[i];
    largest = std::max(largest, std::abs(scaled));
    square += scaled * scaled;
    force = std::max(force, std::abs(w[i] * f[i]));
  }
  error_ = std::isfinite(square) ? largest : square;
  merit_ = std::sqrt(square);
  reference_ = force;
  return merit_;
}

/// S = (1 - am)/((1 - af) b h^2) M + g/(b h) (C - df/dv) + K - df/dd at the current iterate.
void GeneralizedAlpha::refactor(const State& to, double h) {
  for (auto& batch : model_->points()) {
    batch.evaluateWithTangent(to.t, to.q.data(), to.v.data());
    batch.freezeTangent(1.0, velocityFactor(h));
  }
  factorStep_ = h;
  factorTime_ = to.t;
  factorStamp_ = model_->matrixStamp();
  factorLaws_ = model_->lawValues();
  buildFactor();
  fresh_ = true;
  wanted_ = false;
}

void GeneralizedAlpha::buildFactor() {
  model_->combine(accelerationFactor(factorStep_), velocityFactor(factorStep_), 1.0, factor_.values());
  for (auto& batch : model_->points()) batch.subtractTangent(factor_.values());
  ++counters_.factorisations;
  factored_ = factor_.factor() < 0;
}

/// change_ = (c0 M + c1 C + K) delta for the solution of S delta = -R + force: -R + force + R'P R delta, corrected by what the
/// laws have changed in C and K since S was built.
void GeneralizedAlpha::findChange(double h) {
  change_ -= residual_;
  for (const auto& batch : model_->points()) batch.addTangentTimes(delta_.data(), change_.data());
  if (factorStamp_ != model_->matrixStamp())
    model_->addChangeSince(factorLaws_, velocityFactor(h), delta_.data(), change_.data());
}

/// Take the step delta_, halving it until the scaled residual falls. False when it does not.
bool GeneralizedAlpha::backtrack(State& to, double h) {
  change_.setZero();
  findChange(h);
  q0_ = to.q, v0_ = to.v, a0_ = to.a, linear0_ = linear_;
  const double before = merit_;
  double fraction = 1;
  double beyond = 0;  // a fraction at which the residual along delta has changed sign
  for (int cut = 0; cut < (fresh_ ? 5 : 3); ++cut, fraction *= 0.5) {
    place(to, fraction, h);
    if (converged() || merit_ <= (1 - 0.1 * fraction) * before) return true;
    if (delta_.dot(residual_) > 0) beyond = fraction;
  }
  if (fresh_ && rescues_++ < maxRescues && solveTroubledPoints(to, h, before)) return true;
  if (fresh_ && beyond > 0) return bracket(to, beyond, h);
  place(to, 0, h);
  return false;
}

/// The points that spoil the Newton step are solved as what they are. False, with the iterate and its step restored, when that
/// does not help.
bool GeneralizedAlpha::solveTroubledPoints(State& to, double h, double before) {
  saved_ = delta_, savedChange_ = change_;
  place(to, 0, h);
  base_ = residual_;
  nodal_.begin();
  place(to, 1, h);
  bool good = false;
  for (int attempt = 0; attempt < 4 && !good && nodal_.addTroubled(delta_.data(), weight_.data()); ++attempt) {
    buildFactor();
    if (!factored_ || !nodal_.solve(to.t, velocityFactor(h), factor_, base_, delta_, change_)) break;
    ++counters_.newtonIterations;
    residual_ = base_;
    findChange(h);
    place(to, 1, h);
    good = converged() || merit_ <= 0.9 * before;
  }
  wanted_ = true;  // the factor lacks tangents now
  factored_ = false;
  if (!good) delta_ = saved_, change_ = savedChange_;
  return good;
}

/// Contact that switches within the step, or friction that reverses, is a jump of the residual that no decrease of its norm can
/// find: search for the sign change of delta . R between 0 and `beyond` by bisection. The law is continuous, so there is a root,
/// and at the root the tangent knows the steep branch.
bool GeneralizedAlpha::bracket(State& to, double beyond, double h) {
  double low = 0;
  double high = beyond;
  for (int i = 0; i < 60 && high - low > 1e-15 * beyond; ++i) {
    const double middle = 0.5 * (low + high);
    place(to, middle, h);
    if (converged()) return true;
    (delta_.dot(residual_) > 0 ? high : low) = middle;
  }
  return std::isfinite(merit_);
}

/// The iterate at a fraction of delta from where the line search began, measured.
void GeneralizedAlpha::place(State& to, double fraction, double h) {
  to.q = q0_ + fraction * delta_;
  to.v = v0_ + fraction * velocityFactor(h) * delta_;
  to.a = a0_ + fraction * accelerationFactor(h) * delta_;
  linear_ = linear0_ + fraction * change_;
  measure(to);
}

/// Newton iterations from the predicted state; false on failure.
bool GeneralizedAlpha::iterate(State& to, double h) {
  measure(to);
  fresh_ = false;
  rescues_ = 0;
  int stalled = 0;
  for (int iteration = 0;; ++iteration) {
    if (converged()) {
      bool missed = false;
      for (auto& batch : model_->points()) missed = batch.addMissed(to.q.data()) || missed;
      if (!missed) return true;
      measure(to);
      if (converged()) return true;
    }
    if (!std::isfinite(merit_) || iteration >= maxIterations_) return false;
    if (!factored_ || factorStep_ != h || (wanted_ && !fresh_)) {
      refactor(to, h);
      if (!factored_) return false;
    }
    delta_ = -residual_;
    factor_.solve(delta_.data());
    ++counters_.newtonIterations;
    const double before = merit_;
    const bool accepted = backtrack(to, h);
    if (!accepted) {
      if (fresh_) return false;  // the exact Newton direction does not help
      wanted_ = true;
      continue;
    }
    stalled = merit_ > 0.99 * before ? stalled + 1 : 0;
    if (stalled == maxStalled) return false;
    wanted_ = wanted_ || isSlow(merit_ / before);
    fresh_ = false;
  }
}

bool GeneralizedAlpha::attempt(const State& from, State& to, double h, bool keep) {
  if (weight_[0] == 0.0 || factorStep_ != h) {
    // Scale of each row: the diagonal of the effective matrix, so that forces and moments both read as displacements.
    model_->setTime(to.t);
    model_->diagonal(accelerationFactor(h), velocityFactor(h), 1.0, weight_.data());
    const double smallest = 1e-12 * weight_.cwiseAbs().maxCoeff();
    for (double& w : weight_) w = 1.0 / std::max(std::abs(w), smallest);
  }
  predict(from, to, h);
  bool good = iterate(to, h);
  if (!good && keep && std::isfinite(merit_)) {
    ++counters_.unconvergedSteps;
    good = true;
  }
  if (!good) {
    wanted_ = true;
    worst_ = worstPosition(residual_.cwiseProduct(weight_));
    worstError_ = error_ / std::max(reference_, 1e-300);
    return false;
  }
  finish(from, to);
  return true;
}

/// A_{n+1} = ((1 - af) q''_{n+1} + af q''_n - am A_n) / (1 - am)
void GeneralizedAlpha::finish(const State& from, State& to) {
  A_ = ((1 - alphaF_) * to.a + alphaF_ * from.a - alphaM_ * A_) / (1 - alphaM_);
}

std::string GeneralizedAlpha::describeFailure(double t, double h) const {
  std::ostringstream text;
  text << "Newton did not converge in the step from t = " << t << " s (length " << h << " s after " << level_
       << " halvings): the residual is " << worstError_ << " of the largest force, tolerance " << tolerance_ << ", worst at "
       << model_->dofName(worst_) << ".";
  return text.str();
}

void GeneralizedAlpha::giveUp(const State& from, double h) const {
  throw ConvergenceError(describeFailure(from.t, h) +
                         " Choose a smaller Transient/Step, allow more Transient/Generalized-alpha/Max Halvings, or look at what "
                         "happens at that node (contact stiffness, regularisation, friction velocity).");
}

void GeneralizedAlpha::save(std::vector<double>& memory) const {
  memory.insert(memory.end(),
                {static_cast<double>(index_), static_cast<double>(done_), static_cast<double>(level_), factored_ ? 1.0 : 0.0,
                 factorStep_, factorTime_, factorStamp_ == model_->matrixStamp() ? 1.0 : 0.0, wanted_ ? 1.0 : 0.0});
  memory.insert(memory.end(), A_.begin(), A_.end());
  memory.insert(memory.end(), weight_.begin(), weight_.end());
}

void GeneralizedAlpha::restore(const double*& memory) {
  index_ = static_cast<long>(*memory++);
  done_ = static_cast<long>(*memory++);
  level_ = static_cast<int>(*memory++);
  const bool factored = *memory++ != 0.0;
  factorStep_ = *memory++;
  factorTime_ = *memory++;
  const bool current = *memory++ != 0.0;
  wanted_ = *memory++ != 0.0;
  for (double& x : A_) x = *memory++;
  for (double& x : weight_) x = *memory++;
  if (!factored) return;
  // The frozen point tangents came back with the batches: the same factor again.
  const double now = model_->time();
  model_->setTime(factorTime_);
  factorLaws_ = model_->lawValues();
  buildFactor();
  model_->setTime(now);
  factorStamp_ = current ? model_->matrixStamp() : -1;
}

const bool registered = IntegratorRegistry::instance().add(
    "Generalized-alpha",
    {"Implicit, second order, with numerical damping of high frequencies only (Chung and Hulbert 1993, Arnold and Bruels 2007); "
     "contact is balanced at the end of each step.",
     specification(), [](const Teuchos::ParameterList& own) { return std::make_unique<GeneralizedAlpha>(own); }});

}  // namespace
}  // namespace tooljoint::transient
