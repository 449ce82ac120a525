// SPDX-License-Identifier: BSD-3-Clause
#include "transient/compiled/TimedTerms.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <string>

#include "common/Index.hpp"
#include "transient/Tuned.hpp"
#include "transient/accuracy/LawResolution.hpp"

namespace tooljoint::transient {

TimedTerms::TimedTerms(const model::SecondOrderModel& model, const linalg::BlockPattern& pattern,
                       const linalg::BlockProduct& like)
    : model_(&model),
      damping_(model.damping, model.laws, pattern, like),
      stiffness_(model.stiffness, model.laws, pattern, like) {
  std::map<std::string, std::size_t> byLaw;
  for (const auto& term : model.loads) {
    Vector vector(pattern.size());
    for (int p = 0; p < pattern.size(); ++p)
      vector[p] = term.vector[pattern.partition().dof[at(p)]];
    const auto [it, fresh] = byLaw.emplace(model.laws[at(term.law)].name, loads_.size());
    if (fresh)
      loads_.push_back({term.law, vector});
    else
      loads_[it->second].vector += vector;
  }
  loadLaws_.resize(loads_.size());
  lastLoadLaws_.assign(loads_.size(), std::numeric_limits<double>::quiet_NaN());
  load_ = Vector::Zero(pattern.size());
  lawValues_.assign(model.laws.size(), 0.0);
}

double TimedTerms::nextCorner(double t, double end) const {
  const double after = t + Tuned::rounding * std::max(std::abs(t), std::abs(end));
  for (const auto& law : model_->laws) {
    const auto next = std::upper_bound(law.corners.begin(), law.corners.end(), after);
    if (next != law.corners.end()) end = std::min(end, *next);
  }
  return end;
}

void TimedTerms::setTime(double t) {
  if (timeSet_ && t == time_ && plainLoads_) return;
  time_ = t;
  plainLoads_ = true;
  timeSet_ = true;
  for (std::size_t i = 0; i < lawValues_.size(); ++i) lawValues_[i] = model_->laws[i].value(t);
  const bool c = damping_.update(lawValues_);
  const bool k = stiffness_.update(lawValues_);
  if (c || k) ++stamp_;
  for (std::size_t i = 0; i < loads_.size(); ++i) loadLaws_[i] = lawValues_[at(loads_[i].law)];
  sumLoads();
}

/// load_ = sum_i f_i F_i if an f_i has changed
void TimedTerms::sumLoads() {
  bool changed = false;
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    if (!(loadLaws_[i] == lastLoadLaws_[i])) changed = true;
    lastLoadLaws_[i] = loadLaws_[i];
  }
  if (!changed) return;
  load_.setZero();
  for (std::size_t i = 0; i < loads_.size(); ++i)
    if (lastLoadLaws_[i] != 0.0) load_ += lastLoadLaws_[i] * loads_[i].vector;
}

/// Replaces laws of loads that have a corner by value(law).
template <class Value>
void TimedTerms::crossCorners(double begin, double end, const Value& value) {
  for (std::size_t i = 0; i < loads_.size(); ++i) {
    const auto& law = model_->laws[at(loads_[i].law)];
    if (!hasCorner(law, begin, end)) continue;
    loadLaws_[i] = value(law);
    plainLoads_ = false;
  }
  if (!plainLoads_) sumLoads();
}

/// The same for matrices.
template <class Value>
void TimedTerms::crossCornersOfMatrices(double begin, double end, const Value& value) {
  bool crossed = false;
  for (std::size_t i = 0; i < lawValues_.size(); ++i) {
    if (!hasCorner(model_->laws[i], begin, end)) continue;
    lawValues_[i] = value(model_->laws[i]);
    crossed = true;
  }
  if (!crossed) return;
  plainLoads_ = false;
  const bool c = damping_.update(lawValues_), k = stiffness_.update(lawValues_);
  if (c || k) ++stamp_;
}

void TimedTerms::setStepEnd(double begin, double end) {
  setTime(end);
  const double next = end + (end - begin);
  const auto around = [=](const model::ScalarLaw& law) {
    const auto ahead = momentsOf(law, end, next);
    return momentsOf(law, begin, end).first + ahead.mean - ahead.first;
  };
  crossCorners(begin, next, around);
  crossCornersOfMatrices(begin, next, around);
}

void TimedTerms::setStart(double t, double h) {
  setTime(t);
  crossCorners(t, t + h, [=](const model::ScalarLaw& law) {
    const auto ahead = momentsOf(law, t, t + h);
    return 2 * (ahead.mean - ahead.first);
  });
}

void TimedTerms::setStage(double t, double begin, double h) {
  setTime(t);
  const auto stage = [=](const model::ScalarLaw& law) {
    const auto [mean, moment] = momentsOf(law, begin, begin + h);
    const double first = law.value(begin), second = 3 * (mean - moment) - 0.5 * first;
    const double left = begin + h - t;
    return 2 * left > 0.5 * h ? second : 6 * mean - first - 4 * second;
  };
  crossCorners(begin, begin + h, stage);
  crossCornersOfMatrices(begin, begin + h, stage);
}

bool TimedTerms::setMean(double begin, double end) {
  setTime(end);
  crossCorners(begin, end, [=](const model::ScalarLaw& law) {
    return 2 * momentsOf(law, begin, end).mean - law.value(begin);
  });
  return !plainLoads_;
}

void TimedTerms::setMoment(double begin, double end) {
  std::fill(loadLaws_.begin(), loadLaws_.end(), 0.0);
  plainLoads_ = false;
  crossCorners(begin, end, [=](const model::ScalarLaw& law) {
    const auto [mean, moment] = momentsOf(law, begin, end);
    return moment - 0.5 * mean;
  });
}

void TimedTerms::remember(Snapshot& snapshot) const {
  snapshot.time = time_, snapshot.timeSet = timeSet_, snapshot.stamp = stamp_;
  snapshot.lawValues = lawValues_, snapshot.loadLaws = lastLoadLaws_, snapshot.load = load_;
  snapshot.plain = plainLoads_;
  damping_.remember(snapshot.damping);
  stiffness_.remember(snapshot.stiffness);
}

void TimedTerms::comeBack(const Snapshot& snapshot) {
  time_ = snapshot.time, timeSet_ = snapshot.timeSet, stamp_ = snapshot.stamp;
  lawValues_ = snapshot.lawValues, lastLoadLaws_ = snapshot.loadLaws, load_ = snapshot.load;
  plainLoads_ = snapshot.plain;
  damping_.comeBack(snapshot.damping);
  stiffness_.comeBack(snapshot.stiffness);
}

void TimedTerms::save(std::vector<double>& memory) const {
  memory.insert(memory.end(),
                {time_, damping_.isFormed() ? 1.0 : 0.0, stiffness_.isFormed() ? 1.0 : 0.0});
}

void TimedTerms::restore(const double*& memory) {
  setTime(*memory++);
  for (MatrixSum* sum : {&damping_, &stiffness_}) sum->setFormed(*memory++ != 0.0);
}

void TimedTerms::addChangeSince(const std::vector<double>& then, double c, const double* x,
                                double* y) {
  damping_.addChangeSince(then, c, x, y);
  stiffness_.addChangeSince(then, 1.0, x, y);
}

}  // namespace tooljoint::transient
