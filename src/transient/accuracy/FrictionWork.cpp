// SPDX-License-Identifier: BSD-3-Clause
#include "transient/accuracy/FrictionWork.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "common/Index.hpp"
#include "model/laws/Friction.hpp"
#include "transient/Integrator.hpp"

namespace tooljoint::transient {

void FrictionWork::allocate(const CompiledModel& model) {
  sets_.clear();
  std::size_t most = 0, widest = 0;
  for (const auto& batch : model.points()) {
    Set set;
    set.law = dynamic_cast<const model::Frictional*>(&batch.law());
    if (set.law != nullptr) set.smooth = set.law->withoutFriction();
    const auto rows = at(batch.points()) * at(batch.width());
    if (set.smooth != nullptr) {
      set.force.assign(rows, 0.0);
      set.points.reserve(at(batch.points()));
      most = std::max(most, at(batch.points()));
      widest = std::max(widest, rows);
    }
    sets_.push_back(std::move(set));
  }
  for (auto* points : {&looked_, &steady_, &impacts_, &left_}) {
    points->clear();
    points->reserve(most);
  }
  for (auto* rows : {&with_, &without_, &step_}) rows->assign(widest, 0.0);
  q_.setZero(model.size());
  dq_ = q_;
  friction_ = drive_ = time_ = h_ = 0;
}

void FrictionWork::start(CompiledModel& model, const State& state) {
  allocate(model);
  q_ = state.q;
  time_ = state.t;
  step(model, state);  // f_0 and P_0
  forget();
}

void FrictionWork::step(CompiledModel& model, const State& to) {
  h_ = to.t - time_;
  time_ = to.t;
  bool any = false;
  for (const auto& set : sets_) any = any || set.smooth != nullptr;
  if (!any) return;
  dq_ = to.q - q_;
  q_ = to.q;
  for (std::size_t b = 0; b < sets_.size(); ++b)
    if (sets_[b].smooth != nullptr) {
      const double before = drive_;
      const double done = work(model.points()[b], sets_[b], to);
      friction_ += drive_ - before - done;
    }
}

/// Work of friction in the step that ends at `to`; the work of the drive is added to drive_. Forces
/// are those of the last evaluation of the law, except for impacts, whose forces are scaled.
double FrictionWork::work(PointBatch& batch, Set& set, const State& to) {
  const int w = batch.width();
  steady_.clear();
  impacts_.clear();
  for (const int p : batch.active()) {
    const double* f = batch.force() + p * w;
    if (std::all_of(f, f + w, [](double each) { return each == 0.0; })) continue;
    (batch.scale(p) == 1.0 ? steady_ : impacts_).push_back(p);
  }
  looked_.clear();
  std::set_union(steady_.begin(), steady_.end(), impacts_.begin(), impacts_.end(),
                 std::back_inserter(looked_));
  batch.gatherPositions(looked_, to.q.data());
  batch.gather(looked_, to.v.data(), batch.velocity());
  batch.law().evaluate(to.t, impacts_, batch.d(), batch.v(), with_.data());
  set.smooth->evaluate(to.t, looked_, batch.d(), batch.v(), without_.data());
  batch.gather(looked_, dq_.data(), step_.data());
  left_.clear();
  std::set_difference(set.points.begin(), set.points.end(), looked_.begin(), looked_.end(),
                      std::back_inserter(left_));
  batch.gather(left_, dq_.data(), step_.data());
  double done = 0;
  for (const int p : set.points)
    for (int i = p * w; i < (p + 1) * w; ++i) {
      done += 0.5 * set.force[at(i)] * step_[at(i)];
      set.force[at(i)] = 0.0;
    }
  for (const int p : steady_)
    for (int i = p * w; i < (p + 1) * w; ++i) {
      set.force[at(i)] = batch.force()[i] - without_[at(i)];
      done += 0.5 * set.force[at(i)] * step_[at(i)];
    }
  for (const int p : impacts_)
    for (int i = p * w; i < (p + 1) * w; ++i) {
      with_[at(i)] -= without_[at(i)];
      done += with_[at(i)] * step_[at(i)];
    }
  const double power = set.law->drive(to.t, steady_, set.force.data());
  drive_ += 0.5 * h_ * (set.power + power) + h_ * set.law->drive(to.t, impacts_, with_.data());
  set.power = power;
  set.points.assign(steady_.begin(), steady_.end());
  return done;
}

void FrictionWork::save(std::vector<double>& memory) const {
  memory.insert(memory.end(), {time_, friction_, drive_});
  memory.insert(memory.end(), q_.begin(), q_.end());
  for (const auto& set : sets_) {
    memory.push_back(set.power);
    memory.push_back(static_cast<double>(set.points.size()));
    memory.insert(memory.end(), set.points.begin(), set.points.end());
    memory.insert(memory.end(), set.force.begin(), set.force.end());
  }
}

void FrictionWork::restore(const CompiledModel& model, const double*& memory) {
  allocate(model);
  time_ = *memory++;
  friction_ = *memory++;
  drive_ = *memory++;
  for (double& x : q_) x = *memory++;
  for (auto& set : sets_) {
    set.power = *memory++;
    set.points.resize(static_cast<std::size_t>(*memory++));
    for (int& p : set.points) p = static_cast<int>(*memory++);
    for (double& x : set.force) x = *memory++;
  }
}

}  // namespace tooljoint::transient
