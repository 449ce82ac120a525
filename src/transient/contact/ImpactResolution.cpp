// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/ImpactResolution.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/Constants.hpp"
#include "common/Index.hpp"
#include "transient/Integrator.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {
namespace {

/// Coefficient of reboundLoss(), fitted to single masses.
constexpr double lossFit = 0.55;
constexpr double unbounded = std::numeric_limits<double>::infinity();

/// Largest part of the energy that depends on when within a step the wall is met, fitted likewise.
/// The force of a wall with damping c starts with a jump c v. Up to half a step early or late, it
/// takes W c h of the energy more or less, with c at the depth passed in h.
struct Scatter {
  double spring, damper;
  Scatter(double wh, double damping)
      : spring(std::min(1.0, 0.25 * wh * wh)), damper(std::min(1.0 - spring, damping)) {}
};

}  // namespace

double reboundLoss(double wh, double r) {
  if (wh > 2.0) return 1.0;
  const double slow = lossFit * std::pow(1.0 - r, 4) * wh * wh;
  return slow / (1.0 + slow);
}

void ImpactResolution::bind(CompiledModel& model, const MassFactor& mass, double radius) {
  model_ = &model;
  radius_ = radius;
  norm_.bind(model);
  share_ = norm_.mass() / static_cast<double>(model.wholeSize());
  sets_.clear();
  met_.bind(model);
  for (const auto& batch : model.points()) {
    const std::size_t rows = at(batch.points()) * at(batch.width());
    const int w = batch.width();
    sets_.push_back({std::vector<double>(rows, 0.0), std::vector<double>(rows * at(w), 0.0)});
    for (int p : batch.active())
      std::copy_n(batch.force() + p * w, w, &sets_.back().force[at(p * w)]);
    for (int p : batch.everyPoint())
      batch.project(p, mass.inverse(), &sets_.back().mobility[at(p * w * w)]);
  }
  squares_ = time_ = unseen_ = calm_ = 0;
  kept_ = 0;
  recovering_ = false;
}

const double* ImpactResolution::mobility(int b, int point) const {
  const int w = model_->points()[at(b)].width();
  return &sets_[at(b)].mobility[at(point * w * w)];
}

/// A point that meets its wall at the end of a step has a small force and a high speed, so both
/// enter. The tangents of a force may belong to an iterate that did not reach the wall.
ImpactResolution::Bound ImpactResolution::bound(int b, int point, double t, double h,
                                                const double* before) {
  PointBatch& batch = model_->points()[at(b)];
  const int w = batch.width();
  const auto stiff = [&](int k) { return batch.dfdd()[point * w * w + k * w + k] != 0; };
  bool pushes = false, known = false;
  for (int k = 0; k < w; ++k) {
    pushes = pushes || batch.force()[point * w + k] != 0;
    known = known || stiff(k);
  }
  if (pushes && !known) batch.evaluateHere(t, point, true);
  const double* W = mobility(b, point);
  Bound found;
  for (int k = 0; k < w; ++k) {
    if (!stiff(k)) continue;
    const double push = batch.force()[point * w + k] / batch.scale(point);
    found.change += h * W[k * w + k] * std::abs(push - before[k]);
    found.speed += std::abs(batch.v()[point * w + k]);
  }
  return found;
}

/// v'M v: the mean over the run so far, or that of the current step if it is larger.
double ImpactResolution::square() const {
  return std::max(current_, time_ > 0 ? squares_ / time_ : 0.0);
}

/// Speed at first contact: that of the point, and the part already stopped by the wall.
double ImpactResolution::impactSpeed(double speed) const {
  return std::hypot(speed, met_.push() * met_.mobility() / met_.frequency());
}

/// Sets <v^2> for a point that meets its wall at this speed.
void ImpactResolution::measureBy(int b, double speed) {
  reference_ = square() / norm_.mass();
  alone_ = model_->points()[at(b)].width() == 1;
  if (alone_)
    reference_ =
        std::clamp(speed * speed, Tuned::counted * Tuned::counted * reference_, reference_);
  reference_ = std::max(Tuned::quiet * Tuned::quiet, reference_);
}

/// Whether the squared velocity change (dv)^2 requires a shorter step.
bool ImpactResolution::matters(double change) const {
  return change > 4 * Tuned::mostLost * reference_;
}

/// Whether the wall reverses the point within few steps, so that these do not resolve the impact.
bool ImpactResolution::isFast(const MetWall& wall, double change, double h) const {
  h *= counted_;
  return (wall.frequency() * h > Tuned::resolved ||
          wall.damping(0.5 * change * h) * h > Tuned::mostLost) &&
         matters(change * change);
}

bool ImpactResolution::losesMuch(const MetWall& wall, double change, double h) const {
  if (!isFast(wall, change, h)) return false;
  h *= counted_;
  const double square = change * change, wh = wall.frequency() * h;
  if (matters(reboundLoss(wh, radius_) * square)) return true;
  if (!alone_) return false;
  const Scatter part(wh, wall.damping(0.5 * change * h) * h);
  return (part.spring + part.damper) * square > 4 * Tuned::mostMisplaced * reference_;
}

/// (spring max(1/W, m/n) + damper/W) dv^2. A point lighter than the mean mass of a coordinate
/// counts with the mean, because otherwise a heavy part that moves at the same time would hide its
/// error. Steps of w h = 0.15 always satisfy the bound.
double ImpactResolution::misplaced(const MetWall& wall, double change, double h) const {
  if (!isFast(wall, change, h)) return 0;
  h *= counted_;
  const double mass = 1.0 / wall.mobility();
  const Scatter part(wall.frequency() * h, wall.damping(0.5 * change * h) * h);
  return (part.spring * std::max(mass, share_) + part.damper * mass) * change * change;
}

double ImpactResolution::mostMisplaced() const { return 4 * Tuned::mostMisplaced * square(); }

/// Calls visit(dv, speed) for each point of this rank whose wall, met_, may reverse it in the step.
template <class Visit>
void ImpactResolution::visitTurned(const State& from, const State& to, double h,
                                   const Visit& visit) {
  for (int b = 0; b < static_cast<int>(sets_.size()); ++b) {
    PointBatch& batch = model_->points()[at(b)];
    if (!batch.law().hasWalls()) continue;
    const int w = batch.width();
    for (int p : batch.active()) {
      const double* last = &sets_[at(b)].force[at(p * w)];
      const auto [change, speed] = bound(b, p, to.t, h, last);
      measureBy(b, 0);
      if (!matters(change * (change + 2 * speed))) continue;
      met_.face(batch, p, mobility(b, p), to.t);
      met_.measure(change + speed, h);
      if (met_.frequency() == 0) continue;
      // A force passed on to the neighbours does not change the velocity. A reversal that has begun
      // counts in full.
      const double begin = met_.along(from.v), end = met_.along(to.v);
      measureBy(b, impactSpeed(std::max(std::abs(begin), std::abs(end))));
      const double reversal =
          std::max({std::min(h * met_.mobility() * std::abs(met_.push() - met_.along(last)),
                             2 * std::abs(end - begin)),
                    2 * std::abs(begin), 2 * std::abs(end)});
      visit(reversal, change + speed);
    }
  }
}

bool ImpactResolution::isCoarse(const State& from, const State& to, double h) {
  double lossy = 0, sum = 0;
  visitTurned(from, to, h, [&](double reversal, double) {
    if (losesMuch(met_, reversal, h)) lossy = 1;
    sum += misplaced(met_, reversal, h);
  });
  model_->cut().reduce(&lossy, 1, &sum, 1);
  return lossy > 0 || sum > mostMisplaced();
}

/// Calls visit(dv, speed) for each point of this rank that opens from its wall, met_, in the first
/// step.
template <class Visit>
void ImpactResolution::visitReleased(const State& state, double h, const Visit& visit) {
  for (int b = 0; b < static_cast<int>(sets_.size()); ++b) {
    PointBatch& batch = model_->points()[at(b)];
    if (!batch.law().hasWalls()) continue;
    for (int p : batch.active()) {
      met_.face(batch, p, mobility(b, p), state.t);
      const double a = met_.along(state.a) * (met_.push() < 0 ? -1.0 : 1.0),
                   v = met_.along(state.v);
      met_.measure(std::abs(v) + h * std::abs(a), h);
      const double w = met_.frequency();
      if (w == 0 || std::hypot(a, w * v) <= met_.mobility() * std::abs(met_.push()) - a) continue;
      const double speed = std::hypot(a / w, v);
      measureBy(b, speed);
      visit(2 * speed, speed);
    }
  }
}

/// The mean motion of the run is tested first: a step that resolves its impacts relative to the
/// mean also does so relative to a larger motion, and v'M v of the step costs a product.
int ImpactResolution::halvings(const State& from, const State& to, double h) {
  current_ = 0;
  if (!isCoarse(from, to, h)) return 0;
  current_ = model_->massForm(to.v.data());
  return halvingsOf(h, [&](const auto& visit) { visitTurned(from, to, h, visit); });
}

int ImpactResolution::halvingsAtStart(const State& state, double h) {
  current_ = model_->massForm(state.v.data());
  return halvingsOf(h, [&](const auto& visit) { visitReleased(state, h, visit); });
}

/// \param visitPoints calls its argument with (dv, speed) for each point
template <class Points>
int ImpactResolution::halvingsOf(double h, const Points& visitPoints) {
  double lossy = 0;
  sums_.fill(0);
  visitPoints([&](double reversal, double speed) {
    if (!isFast(met_, reversal, h)) return;
    met_.findOnset(h * speed);
    for (int n = 0; n <= StepGrid::mostHalvings; ++n) {
      const double shorter = std::ldexp(h, -n);
      if (!isFast(met_, reversal, shorter)) break;
      if (losesMuch(met_, reversal, shorter)) lossy = std::max(lossy, n + 1.0);
      sums_[at(n)] += misplaced(met_, reversal, shorter);
    }
  });
  model_->cut().reduce(&lossy, 1, sums_.data(), static_cast<int>(sums_.size()));
  int most = static_cast<int>(lossy);
  while (most <= StepGrid::mostHalvings && sums_[at(most)] > mostMisplaced()) ++most;
  if (most > 0) {
    recovering_ = true;
    calm_ = 0;
  }
  return most;
}

/// Time for which the contact closed at `to` must have been without motion before a step of length
/// h: half a period of its vibration, because it is also at rest at its largest depth. Infinite if
/// it moves, 0 if h resolves all closed contact.
double ImpactResolution::calmNeeded(const State& to, double h) {
  double needed = 0, sum = 0;
  current_ = model_->massForm(to.v.data());
  for (int b = 0; b < static_cast<int>(sets_.size()); ++b) {
    PointBatch& batch = model_->points()[at(b)];
    if (!batch.law().hasWalls()) continue;
    for (int p : batch.active()) {
      const double* force = batch.force() + p * batch.width();
      if (std::all_of(force, force + batch.width(), [](double f) { return f == 0; })) continue;
      double fastest = 0;
      for (int k = p * batch.width(); k < (p + 1) * batch.width(); ++k)
        fastest = std::max(fastest, std::abs(batch.rowTimesVector(k, to.v.data())));
      met_.face(batch, p, mobility(b, p), to.t);
      met_.measure(fastest, h);
      if (met_.frequency() * counted_ * h <= Tuned::resolved) continue;
      const double reversal = 2 * std::abs(met_.along(to.v));
      measureBy(b, impactSpeed(0.5 * reversal));
      needed = std::max(needed, constants::pi / met_.frequency());
      if (losesMuch(met_, reversal, h)) needed = unbounded;
      sum += misplaced(met_, reversal, h);
    }
  }
  model_->cut().reduce(&needed, 1, &sum, 1);
  if (sum > mostMisplaced()) return unbounded;
  return needed;
}

int ImpactResolution::nextLevel(const State& to, double h, const StepGrid& grid) {
  if (!recovering_ || grid.level() == 0) {
    recovering_ = false;
    return grid.lowest(0);
  }
  const int least = std::max(0, grid.level() - Tuned::atATime);
  const double needed = calmNeeded(to, grid.length(least));
  calm_ = std::isfinite(needed) ? calm_ + h : 0.0;
  if (calm_ < std::max(needed, Tuned::calmSteps * h)) return grid.level();
  const int level = grid.lowest(least);
  recovering_ = level > 0;
  return level;
}

void ImpactResolution::keep(const State& to, double h) {
  for (std::size_t b = 0; b < sets_.size(); ++b) {
    const PointBatch& batch = model_->points()[b];
    const int w = batch.width();
    for (int p : batch.active())
      for (int k = p * w; k < (p + 1) * w; ++k)
        sets_[b].force[at(k)] = batch.force()[k] / batch.scale(p);
  }
  unseen_ += h;
  if (++kept_ % Tuned::lookStride != 0) return;
  squares_ += model_->massForm(to.v.data()) * unseen_;
  time_ += unseen_;
  unseen_ = 0;
}

void ImpactResolution::carry(std::vector<double>& numbers) const {
  numbers.insert(numbers.end(), {squares_, time_, unseen_, calm_, static_cast<double>(kept_),
                                 recovering_ ? 1.0 : 0.0});
}

void ImpactResolution::takeUp(const double*& numbers) {
  for (double* sum : {&squares_, &time_, &unseen_, &calm_}) *sum = *numbers++;
  kept_ = static_cast<long>(*numbers++);
  recovering_ = *numbers++ != 0.0;
}

void ImpactResolution::save(std::vector<double>& memory) const {
  carry(memory);
  for (const auto& set : sets_) memory.insert(memory.end(), set.force.begin(), set.force.end());
}

void ImpactResolution::restore(const double*& memory) {
  takeUp(memory);
  for (auto& set : sets_)
    for (double& force : set.force) force = *memory++;
}

}  // namespace tooljoint::transient
