// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/ImplicitStep.hpp"

#include <algorithm>
#include <cmath>

#include "common/Index.hpp"

namespace tooljoint::transient {
namespace {

/// Relaxations before Newton takes over, and what four of them must make of the error.
constexpr int maxRelaxations = 24;
constexpr double slowestRelaxation = 0.25;
/// Once points take turns: what two sweeps must make of it.
constexpr int perSweeps = 2 * ContactForceIteration::colours;
constexpr double slowestSweeps = 0.8;
/// Pairs of sweeps in a row that may make less of it: the first ones spread what stuck at a few
/// points.
constexpr int mostIdle = 1;
/// A factorisation with its compliance costs about as much as this many relaxations.
constexpr double factorPrice = 45;

/// Forces of a step beside those of loads, inertia and stiffness where it begins, and those that
/// stop all motion within it. An iterate flung far away has larger ones, and must not be measured
/// against itself.
constexpr double mostGrowth = 10;

/// ContactForceIteration::wrongShare() of an iterate that the phase correction may be taken from.
constexpr double mostWrong = 0.1;

/// A product with what the laws have changed, in relaxations; what a relaxation near few points
/// costs beside the blocks it reaches, in blocks.
constexpr double driftPrice = 0.5, nearPrice = 16;

/// sum_j |A_ij|
void rowSums(const linalg::BlockPattern& pattern, const double* values, Vector& rows) {
  rows.setZero();
  for (int b = 0; b < pattern.blocks(); ++b)
    for (int e = pattern.rowBegin(b); e < pattern.rowBegin(b + 1); ++e)
      for (int j = 0; j < pattern.width(pattern.column(e)); ++j)
        for (int i = 0; i < pattern.width(b); ++i)
          rows[pattern.start(b) + i] +=
              std::abs(values[pattern.offset(e) + at(j * pattern.width(b) + i)]);
  pattern.cut().complete(rows.data());
}

/// max_i w_i sum_j |A_ij|
double rowNorm(const linalg::BlockPattern& pattern, const double* values, const Vector& weight,
               Vector& rows) {
  rowSums(pattern, values, rows);
  return pattern.cut().largest(rows.cwiseProduct(weight).maxCoeff());
}

/// 1 on the diagonal of rows without an entry: what has damping alone has no acceleration to
/// filter.
void determineEmptyRows(const linalg::BlockPattern& pattern, double* values, Vector& rows) {
  rowSums(pattern, values, rows);
  for (int i = 0; i < rows.size(); ++i)
    if (rows[i] == 0.0 && pattern.cut().owns(i)) values[pattern.address(i, i)] = 1.0;
}

}  // namespace

void ImplicitStep::bind(CompiledModel& model, const Options& options) {
  model_ = &model;
  options_ = options;
  const int n = model.size();
  for (Vector* x :
       {&linear_,  &residual_, &delta_,   &change_,     &q0_,       &v0_,          &a0_,
        &linear0_, &weight_,   &scratch_, &base_,       &saved_,    &savedChange_, &guess_,
        &drift_,   &rowSize_,  &inertia_, &correction_, &filtered_, &acceleration_})
    x->setZero(n);
  predicted_.resize(n, model.stateSize());
  atCut_.setZero(n - model.cut().interior(n));
  factorLaws_.assign(model.lawValues().size(), 0.0);
  strategies_.leaveOut(options.without);
  nodal_.bind(model, strategies_);
  relaxation_.bind(model, strategies_);
  relaxes_ = strategies_.has(Strategy::Relaxation);
  for (const auto& batch : model.points())
    relaxes_ = relaxes_ && batch.width() <= ContactForceIteration::widest;
  factor_ = linalg::BlockFactor(model.pattern());
  if (!model.points().empty()) factor_.reserveInverse();
}

/// Scale of each row: the diagonal of the effective matrix, so that forces and moments both read as
/// displacements.
void ImplicitStep::scale(const StepScheme& scheme, double t) {
  model_->setTime(t);
  scaleTime_ = t;
  model_->diagonal(scheme.acceleration, scheme.velocity, 1.0, weight_.data());
  const double smallest = 1e-12 * model_->largest(weight_);
  for (double& w : weight_) w = 1.0 / std::max(std::abs(w), smallest);
  model_->diagonal(1.0, 0.0, 0.0, inertia_.data());
  inertia_ = inertia_.cwiseProduct(weight_);
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
  if (!model_->stiffness().empty()) rowSums(pattern, model_->stiffness().current(), rowSize_);
  rowSize_ = 4e-16 * rowSize_.cwiseProduct(weight_);
}

/// linear_ = M a + K q - F where v = 0, or M a + C v + K q - F, with the sizes of what it is made
/// of (a the predicted one); run by run, while it is in the cache.
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
  if (scheme.phase != 0.0 && filter_.empty()) filter_ = linalg::BlockFactor(model_->pattern());
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
  mostForce_ = mostGrowth * std::max(reference_, stop);
  error_ = INFINITY;
  return (relaxes_ && relax(to)) || (strategies_.use(Strategy::Newton) && finish(to));
}

/// y += (S(now) - S(then)) delta for what the laws have changed since S was factored.
void ImplicitStep::addDrift(const Vector& delta, Vector& y) {
  model_->addChangeSince(factorLaws_, scheme_.velocity, delta.data(), y.data());
}

/// A bound of max |w (S(now) - S(then)) x| / max |x|.
double ImplicitStep::driftNorm() const {
  double norm = 0;
  const auto& laws = model_->lawValues();
  const auto& damping = model_->damping().terms();
  for (std::size_t i = 0; i < damping.size(); ++i)
    norm += scheme_.velocity *
            std::abs(laws[at(damping[i].law)] - factorLaws_[at(damping[i].law)]) * dampingNorms_[i];
  const auto& stiffness = model_->stiffness().terms();
  for (std::size_t i = 0; i < stiffness.size(); ++i)
    norm += std::abs(laws[at(stiffness[i].law)] - factorLaws_[at(stiffness[i].law)]) *
            stiffnessNorms_[i];
  return norm;
}

/// Relaxation of the point forces. False, with `to` and linear_ as they were and delta_ where it
/// stopped, when it does not get there.
bool ImplicitStep::relax(State& to) {
  strategies_.count(Strategy::Relaxation);
  if (!factored_ || factorScheme_.h != scheme_.h || wanted_) {
    predicted_ = to;
    predict(predicted_);
    refactor(predicted_);
    if (!factored_) return false;
  }
  if (!compliant_) relaxation_.setCompliance(factor_);
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
  const double c = scheme_.velocity, a = scheme_.acceleration;
  for (int i = 0; i < delta_.size(); ++i) to.v[i] = c * delta_[i], to.a[i] += a * delta_[i];
  return true;
}

/// Newton from where relaxation stopped, which is often wrong at a few points only, and from the
/// predicted state.
bool ImplicitStep::finish(State& to) {
  predicted_ = to;
  predict(predicted_);
  if (error_ <= reference_) {  // relaxation got somewhere
    to.q += delta_;
    to.v = scheme_.velocity * delta_;
    to.a += scheme_.acceleration * delta_;
    linearResidual(to, From::Motion);
    if (corrected_) linear_ -= correction_;
    if (iterate(to)) return true;
    wanted_ = true;
  }
  to = predicted_;
  linearResidual(to, From::Motion);
  return iterate(to);
}

/// Where iterations begin: at the predicted v. Points whose tangent in S is far stiffer than they
/// are stay there in the first iterate, which the phase correction is taken from, and what is
/// extrapolated further makes vibration of a few steps per period grow. With what laws have
/// changed, drift_ is that of guess_.
void ImplicitStep::guess(const State& to, double norm) {
  const double c = scheme_.velocity;
  relaxation_.guess(to.t, c, to.v);
  if (!(norm > 0)) return;
  guess_ = to.v / c;
  if (norm * model_->largest(guess_) > 0.1 * tolerance())
    findDrift();
  else
    guess_.setZero(), drift_.setZero();
}

/// drift_ = (S(now) - S(then)) guess_
void ImplicitStep::findDrift() {
  drift_.setZero();
  addDrift(guess_, drift_);
}

/// What acts beside the linear residual and the points, if anything.
const Vector* ImplicitStep::otherForces(double norm) {
  if (!(norm > 0)) return corrected_ ? &correction_ : nullptr;
  scratch_ = -drift_;
  if (corrected_) scratch_ += correction_;
  return &scratch_;
}

/// The iteration itself: delta_. When it has been found before points were found to be missed, it
/// goes on from there, at these points first.
bool ImplicitStep::settle(State& to, bool again) {
  const double c = scheme_.velocity;
  const double norm = drifted() ? driftNorm() : 0.0;
  const double negligible = 0.1 * tolerance();
  bool changed = false, near = false, phase = false;
  if (again)
    changed = join(to);
  else
    phase = begin(to, norm);
  double last = 0, work = again ? 0 : 1;
  int turn = -1;  // of the colours, once points take turns
  int idle = 0;   // pairs of sweeps in a row without progress
  for (int iteration = 1;
       turn >= 0 || iteration <= std::min(maxRelaxations, options_.maxIterations); ++iteration) {
    const bool joins = again && iteration == 1;
    if (!joins) {
      work += relaxOnce(to, near, norm);
      changed = false;
    }
    bool good = converged() && !joins && !phase;
    if (phase && (converged() || relaxation_.wrongShare() <= mostWrong)) {
      correctPhase(to);
      phase = false;
      changed = true;
    }
    if (norm > 0 &&
        norm * model_->cut().largest((delta_ - guess_).cwiseAbs().maxCoeff()) > negligible) {
      guess_ = delta_;
      findDrift();
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
      if (iteration > 4 && error_ > slowestRelaxation * last) {
        if (!strategies_.use(Strategy::Turns)) return false;
        turn = 0;
      }
      last = error_;
    } else if (turn > 0 && turn % perSweeps == 0) {
      idle = error_ > slowestSweeps * last ? idle + 1 : 0;
      if (turn >= ContactForceIteration::colours * options_.maxIterations || idle > mostIdle)
        return false;
      last = error_;
    }
    near = turn < 0 ? relaxation_.correct(to.t, c, tolerance(), changed)
                    : relaxation_.sweepEveryFourth(to.t, c, tolerance(),
                                                   turn++ % ContactForceIteration::colours) &&
                          !changed;
    if (!near) work += 1.0;
  }
  return false;
}

/// One relaxation, of all points or near few. Returns what one near few costs beside one of all.
double ImplicitStep::relaxOnce(const State& to, bool near, double norm) {
  double work = 0;
  if (near) {
    strategies_.count(Strategy::NearSolves);
    relaxation_.solveNear(factor_, tolerance(), delta_);
    work = relaxation_.nearShare() + nearPrice / model_->wholeBlocks();
  } else {
    relaxation_.solve(factor_, otherForces(norm), delta_);
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
  corrected_ = false;
  return correctsPhase();
}

/// Take in the points that were missed; the phase correction stays as it is, since they have only
/// just touched. True when one of them is an impact and there is none to be after all.
bool ImplicitStep::join(const State& to) {
  error_ = relaxation_.join(to.t, scheme_.velocity, delta_, tolerance(), reference_);
  if (!corrected_ || correctsPhase()) return false;
  corrected_ = false;
  return true;
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
  determineEmptyRows(model_->pattern(), filter_.values(), scratch_);
  factored_ = factored_ && filter_.factor() < 0;
}

/// Impacts are of first order anyway, and their acceleration is not one to be filtered.
bool ImplicitStep::correctsPhase() const {
  if (scheme_.phase == 0.0) return false;
  const auto& points = model_->points();
  return !model_->cut().any(std::any_of(points.begin(), points.end(),
                                        [](const auto& batch) { return batch.isScaled(); }));
}

/// correction_ = k M (I - F) (a + ca delta), F = s ca (s ca M + K - R' df/dd R)^-1 M. Taken once,
/// from the first delta that is near, which is without it: what that misses is of the order of the
/// square of k (I - F) F.
void ImplicitStep::correctPhase(const State& to) {
  const auto& pattern = model_->pattern();
  const double k = scheme_.phase, kF = k * scheme_.filter * scheme_.acceleration;
  acceleration_ = to.a + scheme_.acceleration * delta_;
  for (const auto& run : model_->runs()) {
    const int begin = pattern.start(run.begin), length = pattern.start(run.end) - begin;
    auto inertia = filtered_.segment(begin, length);
    inertia.setZero();
    model_->addMass(acceleration_.data(), filtered_.data(), run);
    correction_.segment(begin, length) = k * inertia;
  }
  filter_.solve(filtered_.data());
  for (const auto& run : model_->runs())
    model_->addMass(filtered_.data(), correction_.data(), run, -kF);
  corrected_ = true;
}

double ImplicitStep::relativeError() const {
  return error_ / std::max(std::min(reference_, mostForce_), 1e-300);
}

std::string ImplicitStep::worstName() const {
  Vector residual = residual_;
  model_->cut().complete(residual.data());
  return model_->worstName(residual.cwiseProduct(weight_));
}

void ImplicitStep::save(std::vector<double>& memory) const {
  for (const StepScheme* each : {&scheme_, &factorScheme_})
    memory.insert(memory.end(), {each->h, each->velocity, each->acceleration, each->filter,
                                 each->phase, each->impact});
  memory.insert(memory.end(), {scaleTime_, factored_ ? 1.0 : 0.0, factorTime_,
                               drifted() ? 0.0 : 1.0, wanted_ ? 1.0 : 0.0, debt_, usual_});
  memory.insert(memory.end(), weight_.begin(), weight_.end());
  memory.insert(memory.end(), factorLaws_.begin(), factorLaws_.end());
  relaxation_.save(memory);
}

void ImplicitStep::restore(const double*& memory) {
  StepScheme scheme;
  for (StepScheme* each : {&scheme, &factorScheme_})
    for (double* value : {&each->h, &each->velocity, &each->acceleration, &each->filter,
                          &each->phase, &each->impact})
      *value = *memory++;
  scaleTime_ = *memory++;
  const bool factored = *memory++ != 0.0;
  factorTime_ = *memory++;
  const bool current = *memory++ != 0.0;
  wanted_ = *memory++ != 0.0;
  debt_ = *memory++;
  usual_ = *memory++;
  const double now = model_->time();
  if (scheme.h > 0) scale(scheme, scaleTime_);
  model_->setTime(now);
  scheme_ = scheme;
  for (double& x : weight_) x = *memory++;
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
