// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/ImplicitStep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void ImplicitStep::bind(CompiledModel& model, const Options& options) {
  model_ = &model;
  options_ = options;
  const int n = model.size();
  for (Vector* x :
       {&linear_, &residual_, &delta_, &change_, &q0_, &v0_, &a0_, &linear0_, &weight_, &scratch_,
        &base_, &saved_, &savedChange_, &guess_, &drift_, &rowSize_, &inertia_})
    x->setZero(n);
  predicted_.resize(n, model.stateSize());
  atCut_.setZero(n - model.cut().interior(n));
  matrix_.bind(model);
  phase_.bind(model);
  strategies_.leaveOut(options.without);
  nodal_.bind(model, strategies_);
  relaxation_.bind(model, strategies_);
  relaxes_ = strategies_.has(Strategy::Relaxation);
  for (const auto& batch : model.points())
    relaxes_ = relaxes_ && batch.width() <= ContactForceIteration::widest;
}

/// Scale of each row: the diagonal of the effective matrix, so that forces and
/// moments both read as displacements.
void ImplicitStep::scale(const StepScheme& scheme, double t) {
  model_->setTime(t);
  scaleTime_ = t;
  model_->diagonal(scheme.acceleration, scheme.velocity, 1.0, weight_.data());
  const double smallest = Tuned::rounding * model_->largest(weight_);
  for (double& w : weight_) w = 1.0 / std::max(std::abs(w), smallest);
  model_->diagonal(1.0, 0.0, 0.0, inertia_.data());
  inertia_ = inertia_.cwiseProduct(weight_);
  relaxation_.setWeights(weight_);
  const auto& pattern = model_->pattern();
  if (relaxes_) relaxation_.setImpacts(scheme.h, scheme.impact);
  matrix_.setWeights(weight_);
  // |K| row sums bound the rounding of K q.
  rowSize_.setZero();
  if (!model_->stiffness().empty()) rowSums(pattern, model_->stiffness().current(), rowSize_);
  rowSize_ = 2 * std::numeric_limits<double>::epsilon() * rowSize_.cwiseProduct(weight_);
}

/// linear_ = M a + K q - F where v = 0, or M a + C v + K q - F, with the sizes
/// of what it is made of (a the predicted one); run by run, while it is in the
/// cache.
void ImplicitStep::linearResidual(const State& to, From from) {
  const CompiledModel& model = *model_;
  const Eigen::Map<const Vector> load(model.load(), model.size());
  const double ahead = from == From::Rest ? scheme_.acceleration / scheme_.velocity : 0.0;
  const int interior = model.cut().interior(model.size());
  double sizes[2] = {0, 0};  // of forces, and of the rounding in them
  const auto measureSizes = [&](int begin, int length, const auto& internal) {
    const auto part = [begin, length](const auto& x) { return x.segment(begin, length).array(); };
    const auto forces = part(weight_) * internal.abs();
    const auto inertia = part(inertia_) * (part(to.a) + ahead * part(to.v)).abs();
    sizes[0] = std::max(sizes[0], forces.max(inertia).maxCoeff());
    sizes[1] = std::max(sizes[1], (part(rowSize_) * part(to.q).abs()).maxCoeff());
  };
  for (const auto& run : model.runs()) {
    const int begin = model.pattern().start(run.begin),
              length = model.pattern().start(run.end) - begin;
    auto sum = linear_.segment(begin, length).array();
    const auto acting = load.segment(begin, length).array();
    sum.setZero();
    model.addStiffness(to.q.data(), linear_.data(), run);
    if (begin < interior)
      measureSizes(begin, length, sum.abs().max(acting.abs()));
    else
      atCut_.segment(begin - interior, length) = sum;
    model.addMass(to.a.data(), linear_.data(), run);
    sum -= acting;
    if (from == From::Motion) model.addDamping(to.v.data(), linear_.data(), run);
  }
  if (model.cut().isDivided()) {
    model.cut().completeCut(atCut_.data());
    const auto length = static_cast<int>(atCut_.size());
    if (length > 0)
      measureSizes(interior, length,
                   atCut_.array().abs().max(load.segment(interior, length).array().abs()));
    model.cut().reduce(sizes, 2, nullptr, 0);
  }
  linearReference_ = reference_ = sizes[0];
  floor_ = sizes[1];
}

/// From q, a where v = 0 to those of the predicted v.
void ImplicitStep::predict(State& to) const {
  to.q += to.v / scheme_.velocity;
  to.a += scheme_.acceleration / scheme_.velocity * to.v;
}

void ImplicitStep::prepare(const StepScheme& scheme, double t) {
  if (scheme_.h == scheme.h) return;
  phase_.reserve(scheme);
  scale(scheme, t);
  scheme_ = scheme;
}

bool ImplicitStep::solve(State& to, const StepScheme& scheme, Counters& counters) {
  counters_ = &counters;
  strategies_.countIn(counters.strategies);
  prepare(scheme, to.t);
  model_->setTime(to.t);
  linearResidual(to, From::Rest);
  const double stop =
      scheme_.acceleration / scheme_.velocity *
      model_->cut().largest((inertia_.array().abs() * to.v.array().abs()).maxCoeff());
  mostForce_ = Tuned::mostGrowth * std::max(reference_, stop);
  error_ = INFINITY;
  return (relaxes_ && relax(to)) || (strategies_.use(Strategy::Newton) && finish(to));
}

/// Relaxation of the point forces. False, with `to` and linear_ as they were
/// and delta_ where it stopped, when it does not get there.
bool ImplicitStep::relax(State& to) {
  strategies_.count(Strategy::Relaxation);
  if (!matrix_.isOf(scheme_) || wanted_) {
    predicted_ = to;
    predict(predicted_);
    refactor(predicted_);
    if (!matrix_.isFactored()) return false;
  }
  if (!compliant_) relaxation_.setCompliance(matrix_.factor());
  compliant_ = true;
  relaxation_.start(to.q, linear_);
  for (bool again = false;; again = true) {
    if (!settle(to, again)) {
      wanted_ = true;
      return false;
    }
    q0_ = to.q + delta_;
    bool missed = false;
    for (auto& batch : model_->points()) missed = batch.addMissed(q0_.data(), to.t) || missed;
    if (!model_->cut().any(missed)) break;
  }
  to.q.swap(q0_);
  to.v = scheme_.velocity * delta_;
  to.a += scheme_.acceleration * delta_;
  return true;
}

/// Newton from where relaxation stopped, which is often wrong at a few points
/// only, and from the predicted state.
bool ImplicitStep::finish(State& to) {
  predicted_ = to;
  predict(predicted_);
  if (error_ <= reference_) {  // relaxation got somewhere
    to.q += delta_;
    to.v = scheme_.velocity * delta_;
    to.a += scheme_.acceleration * delta_;
    linearResidual(to, From::Motion);
    if (phase_.isTaken()) linear_ -= phase_.force();
    if (iterate(to)) return true;
    wanted_ = true;
  }
  to = predicted_;
  linearResidual(to, From::Motion);
  return iterate(to);
}

/// Where iterations begin: at the predicted v. Points whose tangent in S is far
/// stiffer than they are stay there in the first iterate, which the phase
/// correction is taken from, and what is extrapolated further makes vibration
/// of a few steps per period grow. With what laws have changed, drift_ is that
/// of guess_.
void ImplicitStep::guess(const State& to, double norm) {
  const double c = scheme_.velocity;
  relaxation_.guess(to.t, c, to.v);
  if (!(norm > 0)) return;
  guess_ = to.v / c;
  if (norm * model_->largest(guess_) > Tuned::rightEnough * tolerance())
    findDrift();
  else
    guess_.setZero(), drift_.setZero();
}

/// drift_ = (S(now) - S(then)) guess_
void ImplicitStep::findDrift() {
  drift_.setZero();
  matrix_.addDrift(scheme_, guess_, drift_);
}

/// What acts beside the linear residual and the points, if anything.
const Vector* ImplicitStep::otherForces(double norm) {
  if (!(norm > 0)) return phase_.isTaken() ? &phase_.force() : nullptr;
  scratch_ = -drift_;
  if (phase_.isTaken()) scratch_ += phase_.force();
  return &scratch_;
}

/// The iteration itself: delta_. When it has been found before points were
/// found to be missed, it goes on from there, at these points first.
bool ImplicitStep::settle(State& to, bool again) {
  const double c = scheme_.velocity;
  const double norm = matrix_.hasDrifted() ? matrix_.driftNorm(scheme_) : 0.0;
  const double negligible = Tuned::rightEnough * tolerance();
  bool changed = false, near = false, phase = false;
  if (again)
    changed = join(to);
  else
    phase = begin(to, norm);
  double last = 0, work = again ? 0 : 1;
  int turn = -1;  // of the colours, once points take turns
  int idle = 0;   // pairs of sweeps in a row without progress
  for (int iteration = 1; turn >= 0 || iteration <= options_.maxIterations; ++iteration) {
    const bool joins = again && iteration == 1;
    if (!joins) {
      work += relaxOnce(to, near, norm);
      changed = false;
    }
    bool good = converged() && !joins && !phase;
    if (phase && (converged() || relaxation_.wrongShare() <= Tuned::counted)) {
      phase_.take(scheme_, to.a, delta_);
      phase = false;
      changed = true;
    }
    if (norm > 0 &&
        norm * model_->cut().largest((delta_ - guess_).cwiseAbs().maxCoeff()) > negligible) {
      guess_ = delta_;
      findDrift();
      debt_ += Tuned::driftPrice;
      changed = true;
      good = false;
    }
    if (good) {
      account(work);
      return true;
    }
    if (!std::isfinite(error_)) return false;
    if (turn < 0 && iteration % Tuned::colours == 0) {
      if (iteration > Tuned::colours && error_ > Tuned::slowestRelaxation * last) {
        if (!strategies_.use(Strategy::Turns)) return false;
        turn = 0;
      }
      last = error_;
    } else if (turn > 0 && turn % (2 * Tuned::colours) == 0) {
      idle = error_ > Tuned::progress * last ? idle + 1 : 0;
      if (turn >= Tuned::colours * options_.maxIterations || idle > Tuned::mostIdle) return false;
      last = error_;
    }
    near = turn < 0 ? relaxation_.correct(to.t, c, tolerance(), changed)
                    : relaxation_.sweepEveryFourth(to.t, c, tolerance(), turn++ % Tuned::colours) &&
                          !changed;
    if (!near) work += 1.0;
  }
  return false;
}

/// One relaxation, of all points or near few. Returns what one near few costs
/// beside one of all.
double ImplicitStep::relaxOnce(const State& to, bool near, double norm) {
  double work = 0;
  if (near) {
    strategies_.count(Strategy::NearSolves);
    relaxation_.solveNear(matrix_.factor(), tolerance(), delta_);
    work = relaxation_.nearShare();
  } else {
    relaxation_.solve(matrix_.factor(), otherForces(norm), delta_);
  }
  ++counters_->newtonIterations;
  double force = near ? reference_ : linearReference_;
  error_ = relaxation_.evaluate(to.t, scheme_.velocity, delta_, tolerance(), force);
  reference_ = force;
  return work;
}

/// Start at the guess. Returns whether the phase is to be corrected.
bool ImplicitStep::begin(const State& to, double norm) {
  guess(to, norm);
  phase_.leaveOut();
  return phase_.applies(scheme_);
}

/// Take in the points that were missed; the phase correction stays as it is,
/// since they have only just touched. True when one of them is an impact and
/// there is none to be after all.
bool ImplicitStep::join(const State& to) {
  error_ = relaxation_.join(to.t, scheme_.velocity, delta_, tolerance(), reference_);
  if (!phase_.isTaken() || phase_.applies(scheme_)) return false;
  phase_.leaveOut();
  return true;
}

/// A step took this many relaxations: ask for a new factorisation once that
/// would have paid.
void ImplicitStep::account(double relaxations) {
  if (usual_ == 0) usual_ = relaxations;
  debt_ += std::max(0.0, relaxations - usual_);
  if (debt_ > Tuned::factorPrice) wanted_ = true;
}

/// S = ca M + cv (C - df/dv) + K - df/dd at the current iterate, but for forces
/// that push on.
void ImplicitStep::refactor(const State& to) {
  for (auto& batch : model_->points()) {
    batch.evaluateWithTangent(to.t, to.q.data(), to.v.data());
    batch.freezeTangent(1.0, scheme_.velocity);
    batch.takeOutPush();
  }
  matrix_.refactor(scheme_);
  finishFactor();
  ++counters_->factorisations;
  fresh_ = true;
  wanted_ = false;
  debt_ = usual_ = 0;
}

/// What belongs to a factor beside itself.
void ImplicitStep::finishFactor() {
  compliant_ = false;
  if (matrix_.isFactored() && !phase_.factor(matrix_.scheme())) matrix_.spoil();
}

double ImplicitStep::relativeError() const {
  return error_ / std::max(std::min(reference_, mostForce_), std::numeric_limits<double>::min());
}

std::string ImplicitStep::worstName() const {
  Vector residual = residual_;
  model_->cut().complete(residual.data());
  return model_->worstName(residual.cwiseProduct(weight_));
}

void ImplicitStep::save(std::vector<double>& memory) const {
  scheme_.save(memory);
  memory.insert(memory.end(), {scaleTime_, wanted_ ? 1.0 : 0.0, debt_, usual_});
  memory.insert(memory.end(), weight_.begin(), weight_.end());
  relaxation_.save(memory);
  matrix_.save(memory);
}

void ImplicitStep::restore(const double*& memory) {
  StepScheme scheme;
  scheme.restore(memory);
  scaleTime_ = *memory++;
  wanted_ = *memory++ != 0.0;
  debt_ = *memory++;
  usual_ = *memory++;
  const double now = model_->time();
  if (scheme.h > 0) scale(scheme, scaleTime_);
  model_->setTime(now);
  scheme_ = scheme;
  for (double& x : weight_) x = *memory++;
  if (scheme.h > 0) relaxation_.setWeights(weight_);
  relaxation_.restore(memory);
  if (scheme.h > 0) relaxation_.setImpacts(scheme.h, scheme.impact);
  matrix_.restore(memory, [this] {
    matrix_.rebuild();
    finishFactor();
  });
}

}  // namespace tooljoint::transient
