// SPDX-License-Identifier: BSD-3-Clause
#include "transient/ImplicitStep.hpp"

#include <algorithm>
#include <cmath>

namespace tooljoint::transient {
namespace {

std::size_t z(int i) { return static_cast<std::size_t>(i); }

/// Relaxations before Newton takes over, and what four of them must make of the error.
constexpr int maxRelaxations = 24;
constexpr double slowestRelaxation = 0.25;
/// Once points take turns: what two sweeps must make of it.
constexpr int perSweeps = 2 * PointRelaxation::colours;
constexpr double slowestSweeps = 0.8;
/// Pairs of sweeps in a row that may make less of it: the first ones spread what stuck at a few points.
constexpr int mostIdle = 1;
/// A factorisation with its compliance costs about as much as this many relaxations.
constexpr double factorPrice = 14;

/// A product with what the laws have changed, and what a relaxation near few points costs beside the blocks it reaches, in relaxations.
constexpr double driftPrice = 0.5, nearPrice = 0.1;

/// max_i w_i sum_j |A_ij|
double rowNorm(const linalg::BlockPattern& pattern, const double* values, const Vector& weight, Vector& rows) {
  rows.setZero();
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e)
      for (int j = 0; j < pattern.width(pattern.column(e)); ++j)
        for (int i = 0; i < pattern.width(b); ++i)
          rows[pattern.start(b) + i] += std::abs(values[pattern.offset(e) + z(j * pattern.width(b) + i)]);
  return rows.cwiseProduct(weight).maxCoeff();
}

}  // namespace

void ImplicitStep::bind(CompiledModel& model, const Options& options) {
  model_ = &model;
  options_ = options;
  const int n = model.size();
  for (Vector* x : {&linear_, &residual_, &delta_, &change_, &q0_, &v0_, &a0_, &linear0_, &weight_, &scratch_, &base_, &saved_,
                    &savedChange_, &guess_, &last_, &drift_, &rowSize_, &correction_, &filtered_, &acceleration_})
    x->setZero(n);
  predicted_.resize(n);
  int longest = 0;
  for (const auto& run : model.runs()) longest = std::max(longest, model.pattern().start(run.end) - model.pattern().start(run.begin));
  stiff_.setZero(longest);
  factorLaws_.assign(model.lawValues().size(), 0.0);
  nodal_.bind(model);
  relaxation_.bind(model);
  relaxes_ = true;
  for (const auto& batch : model.points()) relaxes_ = relaxes_ && batch.width() <= PointRelaxation::widest;
  factor_ = linalg::BlockFactor(model.pattern());
  if (!model.points().empty()) factor_.reserveInverse();
}

/// Scale of each row: the diagonal of the effective matrix, so that forces and moments both read as displacements.
void ImplicitStep::scale(const StepScheme& scheme, double t) {
  model_->setTime(t);
  model_->diagonal(scheme.acceleration, scheme.velocity, 1.0, weight_.data());
  const double smallest = 1e-12 * weight_.cwiseAbs().maxCoeff();
  for (double& w : weight_) w = 1.0 / std::max(std::abs(w), smallest);
  relaxation_.setWeights(weight_);
  const auto& pattern = model_->pattern();
  if (relaxes_) relaxation_.setImpacts(scheme.h, scheme.impact);
  dampingNorms_.clear();
  stiffnessNorms_.clear();
  for (const auto& term : model_->damping().terms())
    dampingNorms_.push_back(rowNorm(pattern, term.values.data(), weight_, scratch_));
  for (const auto& term : model_->stiffness().terms())
    stiffnessNorms_.push_back(rowNorm(pattern, term.values.data(), weight_, scratch_));
  // |K| row sums bound the rounding of K q.
  rowSize_.setZero();
  if (!model_->stiffness().empty()) rowNorm(pattern, model_->stiffness().current(), weight_, rowSize_);
  rowSize_ = 4e-16 * rowSize_.cwiseProduct(weight_);
}

/// linear_ = M a + C v + K q - F at the predicted state, with the sizes of what it is made of; run by run, while it is in the cache.
void ImplicitStep::linearResidual(const State& to, Damping damping) {
  const CompiledModel& model = *model_;
  const Eigen::Map<const Vector> load(model.load(), model.size());
  double size = 0, floor = 0;
  for (const auto& run : model.runs()) {
    const int begin = model.pattern().start(run.begin), length = model.pattern().start(run.end) - begin;
    const auto part = [begin, length](const auto& x) { return x.segment(begin, length).array(); };
    auto sum = linear_.segment(begin, length).array();
    auto stiff = stiff_.head(length).array();
    sum.setZero();
    model.addStiffness(to.q.data(), linear_.data(), run);
    stiff = sum;
    sum.setZero();
    model.addMass(to.a.data(), linear_.data(), run);
    const auto forces = sum.abs().max(stiff.abs()).max(part(load).abs());
    size = std::max(size, (part(weight_) * forces).maxCoeff());
    floor = std::max(floor, (part(rowSize_) * part(to.q).abs()).maxCoeff());
    sum += stiff - part(load);
    if (damping == Damping::Now)
      model.addDamping(to.v.data(), linear_.data(), run);
    else
      model.damping().addFormed(to.v.data(), linear_.data(), run);
  }
  linearReference_ = reference_ = size;
  floor_ = floor;
}

void ImplicitStep::prepare(const StepScheme& scheme, double t) {
  if (scheme_.h == scheme.h) return;
  if (scheme.phase != 0.0 && filter_.empty()) filter_ = linalg::BlockFactor(model_->pattern());
  scale(scheme, t);
  for (Vector* x : {&last_, &guess_}) x->setZero();
  scheme_ = scheme;
}

bool ImplicitStep::solve(State& to, const StepScheme& scheme, Counters& counters) {
  counters_ = &counters;
  prepare(scheme, to.t);
  model_->setTime(to.t);
  lags_ = relaxes_ && factored_ && !wanted_ && factorScheme_.h == scheme_.h && model_->damping().isFormedAt(factorLaws_);
  linearResidual(to, lags_ ? Damping::WhenFactored : Damping::Now);
  error_ = INFINITY;
  return (relaxes_ && relax(to)) || finish(to);
}

/// y += (S(now) - S(then)) delta for what the laws have changed since S was factored.
void ImplicitStep::addDrift(const Vector& delta, Vector& y) {
  model_->addChangeSince(factorLaws_, scheme_.velocity, delta.data(), y.data());
}

/// drift_ = (S(now) - S(then)) delta, with the damping of the predicted velocity where linear_ lacks it.
void ImplicitStep::findDrift(const State& to, const Vector& delta) {
  drift_.setZero();
  if (!lags_) return addDrift(delta, drift_);
  scratch_ = to.v + scheme_.velocity * delta;
  model_->damping().addChangeSince(factorLaws_, 1.0, scratch_.data(), drift_.data());
  model_->stiffness().addChangeSince(factorLaws_, 1.0, delta.data(), drift_.data());
}

/// A bound of max |w (S(now) - S(then)) x| / max |x|.
double ImplicitStep::driftNorm() const {
  double norm = 0;
  const auto& laws = model_->lawValues();
  const auto& damping = model_->damping().terms();
  for (std::size_t i = 0; i < damping.size(); ++i)
    norm += scheme_.velocity * std::abs(laws[z(damping[i].law)] - factorLaws_[z(damping[i].law)]) * dampingNorms_[i];
  const auto& stiffness = model_->stiffness().terms();
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    norm += std::abs(laws[z(stiffness[i].law)] - factorLaws_[z(stiffness[i].law)]) * stiffnessNorms_[i];
  return norm;
}

/// Relaxation of the point forces. False, with `to` and linear_ at the predicted state and delta_ where it stopped, when it does
/// not get there.
bool ImplicitStep::relax(State& to) {
  if (!factored_ || factorScheme_.h != scheme_.h || wanted_) {
    refactor(to);
    if (!factored_) return false;
  }
  guess_.swap(last_);
  if (!compliant_) relaxation_.setCompliance(factor_);
  compliant_ = true;
  for (;;) {
    relaxation_.start(to.q, to.v, linear_);
    if (!settle(to)) {
      guess_.swap(last_);
      wanted_ = true;
      return false;
    }
    q0_ = to.q + delta_;
    bool missed = false;
    for (auto& batch : model_->points()) missed = batch.addMissed(q0_.data(), to.t) || missed;
    if (!missed) break;
    guess_ = delta_;
  }
  to.q.swap(q0_);
  const double c = scheme_.velocity, a = scheme_.acceleration;
  for (int i = 0; i < delta_.size(); ++i) to.v[i] += c * delta_[i], to.a[i] += a * delta_[i];
  last_.swap(delta_);
  return true;
}

/// Newton from where relaxation stopped, which is often wrong at a few points only, and from the predicted state.
bool ImplicitStep::finish(State& to) {
  if (lags_) model_->damping().addChangeSince(factorLaws_, 1.0, to.v.data(), linear_.data());
  lags_ = false;
  if (!(error_ <= reference_)) return iterate(to);  // nowhere, or nothing to start from
  if (corrected_) correctPhase(to);
  predicted_ = to;
  const double c = scheme_.velocity, a = scheme_.acceleration;
  for (int i = 0; i < delta_.size(); ++i) to.q[i] += delta_[i], to.v[i] += c * delta_[i], to.a[i] += a * delta_[i];
  linearResidual(to, Damping::Now);
  if (corrected_) linear_ -= correction_;
  if (iterate(to)) return true;
  to = predicted_;
  linearResidual(to, Damping::Now);
  wanted_ = true;
  return iterate(to);
}

/// The iteration itself: delta_ from guess_ (which it may change).
bool ImplicitStep::settle(State& to) {
  const double c = scheme_.velocity;
  const double norm = drifted() ? driftNorm() : 0.0;
  const double negligible = 0.1 * tolerance();
  relaxation_.guess(to.t, c, guess_);
  corrected_ = false;
  if (norm > 0) {
    const double moved = guess_.cwiseAbs().maxCoeff() + (lags_ ? to.v.cwiseAbs().maxCoeff() / c : 0.0);
    if (norm * moved > negligible) {
      findDrift(to, guess_);
    } else {
      drift_.setZero();
      guess_.setZero();  // what drift_ stands for
    }
  }
  bool phase = correctsPhase(), near = false;
  const double settled = std::sqrt(options_.tolerance);
  double last = 0, work = 1;
  int turn = -1;  // of the colours, once points take turns
  int idle = 0;   // pairs of sweeps in a row without progress
  for (int iteration = 1; turn >= 0 || iteration <= std::min(maxRelaxations, options_.maxIterations); ++iteration) {
    if (near) {
      relaxation_.solveNear(factor_, tolerance(), delta_);
      work += nearPrice + relaxation_.nearShare();
    } else {
      const Vector* force = corrected_ ? &correction_ : nullptr;
      if (norm > 0) {
        scratch_ = -drift_;
        if (corrected_) scratch_ += correction_;
        force = &scratch_;
      }
      relaxation_.solve(factor_, force, delta_);
    }
    ++counters_->newtonIterations;
    double force = near ? reference_ : linearReference_;
    error_ = relaxation_.evaluate(to.t, c, delta_, tolerance(), force);
    reference_ = force;
    bool changed = false;
    bool good = converged() && !phase;
    if (phase && (!corrected_ || error_ <= settled * reference_)) {
      phase = error_ > settled * reference_;  // to be taken again from an iterate that is near
      correctPhase(to);
      changed = true;
    }
    if (norm > 0 && norm * (delta_ - guess_).cwiseAbs().maxCoeff() > negligible) {
      findDrift(to, delta_);
      guess_ = delta_;
      debt_ += driftPrice;
      changed = true;
      good = false;
    }
    if (good) {
      account(work);
      return true;
    }
    if (!std::isfinite(error_)) return false;
    if (turn < 0 && iteration % 4 == 0) {
      if (iteration > 4 && error_ > slowestRelaxation * last) turn = 0;
      last = error_;
    } else if (turn > 0 && turn % perSweeps == 0) {
      idle = error_ > slowestSweeps * last ? idle + 1 : 0;
      if (turn >= PointRelaxation::colours * options_.maxIterations || idle > mostIdle) return false;
      last = error_;
    }
    near = turn < 0 ? relaxation_.correct(to.t, c, tolerance(), changed)
                    : relaxation_.correctColour(to.t, c, tolerance(), turn++ % PointRelaxation::colours) && !changed;
    if (!near) work += 1.0;
  }
  return false;
}

/// A step took this many relaxations: ask for a new factorisation once that would have paid.
void ImplicitStep::account(double relaxations) {
  if (usual_ == 0) usual_ = relaxations;
  debt_ += std::max(0.0, relaxations - usual_);
  if (debt_ > factorPrice) wanted_ = true;
}

/// S = ca M + cv (C - df/dv) + K - df/dd at the current iterate, but for forces that push on.
void ImplicitStep::refactor(const State& to) {
  for (auto& batch : model_->points()) {
    batch.evaluateWithTangent(to.t, to.q.data(), to.v.data());
    batch.freezeTangent(1.0, scheme_.velocity);
    batch.takeOutPush();
  }
  factorScheme_ = scheme_;
  factorTime_ = to.t;
  factorStamp_ = model_->matrixStamp();
  factorLaws_ = model_->lawValues();
  buildFactor();
  ++counters_->factorisations;
  fresh_ = true;
  wanted_ = false;
  debt_ = usual_ = 0;
}

void ImplicitStep::buildFactor() {
  model_->combine(factorScheme_.acceleration, factorScheme_.velocity, 1.0, factor_.values());
  for (auto& batch : model_->points()) batch.subtractTangent(factor_.values());
  factored_ = factor_.factor() < 0;
  compliant_ = false;
  if (factorScheme_.phase == 0.0) return;
  model_->combine(factorScheme_.filter * factorScheme_.acceleration, 0.0, 1.0, filter_.values());
  for (auto& batch : model_->points()) batch.subtractPositionTangent(filter_.values());
  factored_ = factored_ && filter_.factor() < 0;
}

/// Impacts are of first order anyway, and their acceleration is not one to be filtered.
bool ImplicitStep::correctsPhase() const {
  if (scheme_.phase == 0.0) return false;
  for (const auto& batch : model_->points())
    if (batch.isScaled()) return false;
  return true;
}

/// correction_ = k M (I - F) (a + ca delta), F = s ca (s ca M + K - R' df/dd R)^-1 M. Taken from the first delta, without it, and
/// again from one that is near where the first was not: what that misses is of the order of the square of k (I - F) F.
void ImplicitStep::correctPhase(const State& to) {
  const auto& pattern = model_->pattern();
  acceleration_ = to.a + scheme_.acceleration * delta_;
  for (const auto& run : model_->runs()) {
    std::fill(&filtered_[pattern.start(run.begin)], filtered_.data() + pattern.start(run.end), 0.0);
    model_->addMass(acceleration_.data(), filtered_.data(), run);
  }
  filter_.solve(filtered_.data());
  acceleration_ = scheme_.phase * (acceleration_ - scheme_.filter * scheme_.acceleration * filtered_);
  corrected_ = true;
  for (const auto& run : model_->runs()) {
    std::fill(&correction_[pattern.start(run.begin)], correction_.data() + pattern.start(run.end), 0.0);
    model_->addMass(acceleration_.data(), correction_.data(), run);
  }
}

double ImplicitStep::relativeError() const { return error_ / std::max(reference_, 1e-300); }

int ImplicitStep::worstPosition() const { return transient::worstPosition(residual_.cwiseProduct(weight_)); }

void ImplicitStep::save(std::vector<double>& memory) const {
  for (const StepScheme* each : {&scheme_, &factorScheme_})
    memory.insert(memory.end(), {each->h, each->velocity, each->acceleration, each->filter, each->phase, each->impact});
  memory.insert(memory.end(), {factored_ ? 1.0 : 0.0, factorTime_, drifted() ? 0.0 : 1.0, wanted_ ? 1.0 : 0.0, debt_, usual_});
  memory.insert(memory.end(), weight_.begin(), weight_.end());
  memory.insert(memory.end(), last_.begin(), last_.end());
  memory.insert(memory.end(), factorLaws_.begin(), factorLaws_.end());
  relaxation_.save(memory);
}

void ImplicitStep::restore(const double*& memory) {
  StepScheme scheme;
  for (StepScheme* each : {&scheme, &factorScheme_})
    for (double* value : {&each->h, &each->velocity, &each->acceleration, &each->filter, &each->phase, &each->impact})
      *value = *memory++;
  const bool factored = *memory++ != 0.0;
  factorTime_ = *memory++;
  const bool current = *memory++ != 0.0;
  wanted_ = *memory++ != 0.0;
  debt_ = *memory++;
  usual_ = *memory++;
  const double now = model_->time();
  if (scheme.h > 0) scale(scheme, now);
  scheme_ = scheme;
  for (double& x : weight_) x = *memory++;
  for (double& x : last_) x = *memory++;
  if (scheme.h > 0) relaxation_.setWeights(weight_);
  for (double& x : factorLaws_) x = *memory++;
  relaxation_.restore(memory);
  if (scheme.h > 0) relaxation_.setImpacts(scheme.h, scheme.impact);
  if (!factored) return;
  model_->setTime(factorTime_);
  buildFactor();
  model_->setTime(now);
  factorStamp_ = current ? model_->matrixStamp() : -1;
}

}  // namespace tooljoint::transient
