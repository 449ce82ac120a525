// SPDX-License-Identifier: BSD-3-Clause
#include "estimate/StateErrors.hpp"

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::estimate {

StateErrors::StateErrors(transient::PointBatch& batch)
    : batch_(&batch), law_(model::stateful(batch.law())) {
  own_ = moved_ = end_ = middle_ = Vector::Zero(batch.states()->size());
  z_ = change_ = Vector::Zero(batch.states()->points() * batch.states()->rated());
}

Vector StateErrors::ratedOf(const Vector& states) const {
  const int all = law_->states(), rated = law_->rated();
  Vector out(law_->size() * rated);
  for (int p = 0; p < law_->size(); ++p)
    out.segment(p * rated, rated) = states.segment(p * all, rated);
  return out;
}

void StateErrors::setRated(Vector& states, const Vector& rated) const {
  const int all = law_->states(), some = law_->rated();
  for (int p = 0; p < law_->size(); ++p)
    states.segment(p * all, some) = rated.segment(p * some, some);
}

/// States of a start with an error e are those of the law there.
void StateErrors::begin(double t, const double* x, const Vector& e, const Vector& eDot) {
  const auto size = e.size();
  const Eigen::Map<const Vector> d(batch_->d(), size), v(batch_->v(), size);
  own_ = end_ = Eigen::Map<const Vector>(x, own_.size());
  Vector here = Vector::Zero(own_.size()), there = here;
  const Vector dThere = d + e, vThere = v + eDot;
  law_->initialState(t, d.data(), v.data(), here.data());
  law_->initialState(t, dThere.data(), vThere.data(), there.data());
  moved_ = own_ + (there - here);
  z_ = ratedOf(moved_) - ratedOf(own_);
}

void StateErrors::bind(const double* x, double factor) {
  const Vector before = ratedOf(end_);
  end_ = Eigen::Map<const Vector>(x, end_.size());
  middle_ = own_;
  setRated(middle_, 0.5 * (before + ratedOf(end_)));
  factor_ = factor;
  batch_->states()->bindKnown(middle_.data(), factor);
}

Vector StateErrors::force(double t) {
  const auto& all = batch_->everyPoint();
  const auto rows = static_cast<Eigen::Index>(law_->size()) * law_->width();
  Vector f = Vector::Zero(rows), fMoved = f, g = Vector::Zero(z_.size()), gMoved = g;
  Vector held = moved_;
  setRated(held, ratedOf(middle_));
  law_->forces(t, all, batch_->d(), batch_->v(), middle_.data(), f.data(), g.data());
  law_->forces(t, all, batch_->d(), batch_->v(), held.data(), fMoved.data(), gMoved.data());
  change_ = z_ + factor_ * (gMoved - g);
  Vector out = Vector::Zero(rows);
  batch_->states()->forceOf(factor_, change_.data(), out.data());
  return out + fMoved - f;
}

void StateErrors::follow(const Vector& e, const Vector& eDot, double weight) {
  Vector reached = change_;
  batch_->states()->follow(factor_, e.data(), eDot.data(), reached.data());
  z_ += (reached - z_) / weight;
}

void StateErrors::accept(double t, const Vector& e, const Vector& eDot) {
  const auto size = e.size();
  const Eigen::Map<const Vector> d(batch_->d(), size), v(batch_->v(), size);
  const Vector dThere = d + e, vThere = v + eDot;
  setRated(own_, ratedOf(end_));
  setRated(moved_, ratedOf(end_) + z_);
  law_->accept(t, d.data(), v.data(), own_.data());
  law_->accept(t, dThere.data(), vThere.data(), moved_.data());
}

}  // namespace tooljoint::estimate
