// SPDX-License-Identifier: BSD-3-Clause
#include "transient/contact/ContactForceUpdate.hpp"

#include <cmath>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"

namespace tooljoint::transient {

void ContactForceUpdate::bind(CompiledModel& model, Strategies& strategies) {
  model_ = &model;
  strategies_ = &strategies;
  impacts_.bind(model, strategies);
  forces_.clear();
  blocks_.assign(at(model.pattern().blocks()), 0);
  for (const auto& batch : model.points()) {
    forces_.emplace_back(batch, strategies);
    batch.markBlocks(blocks_);
  }
  near_.setZero(model.size());
  live_.clear();
  live_.reserve(4 * blocks_.size());
}

void ContactForceUpdate::setWeights(const Vector& weight) {
  weight_ = weight;
  for (std::size_t b = 0; b < forces_.size(); ++b)
    forces_[b].setWeights(model_->points()[b], weight);
}

void ContactForceUpdate::setCompliance(linalg::BlockFactor& factor) {
  factor.invert(blocks_);
  inverse_ = factor.inverse();
  for (auto& forces : forces_) forces.forgetCompliance();
}

void ContactForceUpdate::start(const Vector& q, const Vector& residual) {
  q_ = &q;
  residual_ = &residual;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    PointBatch& batch = model_->points()[b];
    forces_[b].forgetStart();
    forces_[b].takeAll(batch);
    forces_[b].start(batch, q.data(), inverse_);
  }
}

void ContactForceUpdate::guess(double t, double c, const Vector& v) {
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    const PointBatch& batch = model_->points()[b];
    forces_[b].takeAll(batch);
    forces_[b].gather(batch, v, c);
    prepare(b, t, c);
  }
}

/// Laws, impacts and local responses at y.
void ContactForceUpdate::prepare(std::size_t number, double t, double c) {
  PointForces& forces = forces_[number];
  PointBatch& batch = model_->points()[number];
  if (forces.taken().empty()) return;
  forces.evaluate(batch, t, c, true);
  impacts_.find(number, batch, t, forces.taken(), forces.compliance());
  forces.agree(batch, c);
}

double ContactForceUpdate::join(double t, double c, const Vector& delta, double small,
                                double& force) {
  double worst = 0;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    PointForces& forces = forces_[b];
    PointBatch& batch = model_->points()[b];
    forces.takeNew(batch);
    forces.start(batch, q_->data(), inverse_);
    forces.gather(batch, delta, 1.0);
    prepare(b, t, c);
    forces.removeForces(batch);
    forces.measure(batch, small, force);
    worst = forces.worst(forces.taken(), worst);
  }
  return largestOfAll(worst, force);
}

double ContactForceUpdate::largestOfAll(double worst, double& force) const {
  double both[2] = {worst, force};
  model_->cut().reduce(both, 2, nullptr, 0);
  force = both[1];
  return both[0];
}

double ContactForceUpdate::evaluate(double t, double c, const Vector& delta, double small,
                                    double& force) {
  double worst = 0;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    PointForces& forces = forces_[b];
    PointBatch& batch = model_->points()[b];
    if (isNear_)
      forces.takeReached(batch, live_);
    else
      forces.takeAll(batch);
    forces.gather(batch, delta, 1.0);
    forces.evaluate(batch, t, c, false);
    forces.measure(batch, small, force);
    worst = forces.worst(isNear_ && allMoved_ ? forces.taken() : batch.active(), worst);
  }
  return largestOfAll(worst, force);
}

double ContactForceUpdate::wrongShare() const {
  double sums[2] = {0, 0};
  for (std::size_t b = 0; b < forces_.size(); ++b)
    forces_[b].addSquares(model_->points()[b], sums[0], sums[1]);
  model_->cut().reduce(nullptr, 0, sums, 2);
  return sums[0] == 0 ? 0.0 : std::sqrt(sums[0] / sums[1]);  // infinite if no force is left
}

void ContactForceUpdate::solve(const linalg::BlockFactor& factor, const Vector* force,
                               Vector& delta) {
  if (force != nullptr)
    delta = *force - *residual_;
  else
    delta = -*residual_;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    const PointBatch& batch = model_->points()[b];
    batch.scatter(batch.active(), forces_[b].forces().data(), delta.data());
  }
  factor.solve(delta.data());
  isNear_ = false;
}

/// delta += S^-1 R' (change of p)
void ContactForceUpdate::solveNear(const linalg::BlockFactor& factor, double small, Vector& delta) {
  live_.clear();
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    const PointBatch& batch = model_->points()[b];
    batch.scatter(forces_[b].taken(), forces_[b].change().data(), near_.data());
    for (int p : forces_[b].taken()) batch.appendBlocks(p, live_);
  }
  factor.solveNear(near_.data(), live_, weight_.data(), Tuned::dropped * small);
  const auto& pattern = model_->pattern();
  for (int b : live_)
    for (int i = pattern.start(b); i < pattern.start(b + 1); ++i)
      delta[i] += near_[i], near_[i] = 0;
  isNear_ = true;
}

bool ContactForceUpdate::isFew(long here) {
  const double points = model_->cut().sum(static_cast<double>(here));
  nearShare_ = Tuned::positionsPerPoint * points / model_->wholeSize();
  return nearShare_ < 1.0;
}

bool ContactForceUpdate::correct(double t, double c, double small, bool all) {
  long wrong = 0;
  for (const auto& forces : forces_)  // points that were not evaluated are not wrong
    for (int p : forces.taken()) wrong += forces.isWrong(p, small) ? 1 : 0;
  const bool few = !all && strategies_->has(Strategy::NearSolves) && isFew(wrong);
  allMoved_ = true;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    PointBatch& batch = model_->points()[b];
    if (few)
      forces_[b].keepWrong(small);
    else
      forces_[b].takeAll(batch);
    forces_[b].correct(batch, t, c);
  }
  return few;
}

void ContactForceUpdate::finish(double t, double c) {
  for (std::size_t b = 0; b < forces_.size(); ++b) forces_[b].stand(model_->points()[b], t, c);
}

bool ContactForceUpdate::sweepEveryFourth(double t, double c, double small, int colour) {
  long moved = 0, looked = 0;
  for (const auto& batch : model_->points()) looked += static_cast<long>(batch.active().size());
  long place = std::lround(model_->cut().before(static_cast<double>(looked)));
  allMoved_ = false;
  for (std::size_t b = 0; b < forces_.size(); ++b) {
    PointBatch& batch = model_->points()[b];
    forces_[b].takeTurn(batch, small, colour, place);
    forces_[b].correct(batch, t, c);
    moved += static_cast<long>(forces_[b].taken().size());
  }
  return strategies_->has(Strategy::NearSolves) && isFew(moved);
}

}  // namespace tooljoint::transient
