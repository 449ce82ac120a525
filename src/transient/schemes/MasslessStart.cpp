// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/MasslessStart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "linalg/blocks/BlockFactor.hpp"

namespace tooljoint::transient {
namespace {

/// tau^2 as a part of the smallest M_ii / K_ii: what has mass moves by this part of its deflection.
constexpr double still = 1e-13;
/// The same for accelerations, where what is out of balance by rounding is divided by tau^2.
constexpr double stillAccelerations = 1e-8;
/// Change of the state below this part of it that is rounding.
constexpr double inBalance = 1e-10;
/// Newton iterations: laws with a gap open and close on the way.
constexpr int mostIterations = 30;

/// tau [s], tau^2 this part of the smallest M_ii / K_ii; 0 where nothing has mass and stiffness.
double shortTime(const CompiledModel& model, double part) {
  Vector mass(model.size()), stiffness(model.size());
  model.diagonal(1.0, 0.0, 0.0, mass.data());
  model.diagonal(0.0, 0.0, 1.0, stiffness.data());
  double most = 0.0;
  for (int i = 0; i < model.size(); ++i)
    if (mass[i] > 0.0) most = std::max(most, std::abs(stiffness[i]) / mass[i]);
  most = model.cut().largest(most);
  return most > 0.0 ? std::sqrt(part / most) : 0.0;
}

/// Solutions with M + tau (C - R'f_v R) + tau^2 (K - R'f_d R).
class Balance {
 public:
  Balance(CompiledModel& model, const MassFactor& mass, State& state, double part)
      : model_(model),
        mass_(mass),
        state_(state),
        factor_(model.pattern()),
        tau_(shortTime(model, part)) {}

  bool possible() const { return tau_ > 0.0; }

  /// Newton's method for F - C v - K q + R'f = 0; false where it does not converge.
  bool positions(Vector& moved) {
    moved = state_.q;
    for (int i = 0; i < mostIterations; ++i) {
      Vector force = Vector::Zero(model_.size());
      model_.addStiffness(state_.q.data(), force.data());
      model_.addDamping(state_.v.data(), force.data());
      force = Eigen::Map<const Vector>(model_.load(), model_.size()) - force;
      if (!factor()) return false;
      for (auto& batch : model_.points()) batch.addForce(force.data());
      const Vector change = solve(std::move(force));
      if (!change.allFinite()) return false;
      state_.q += change;
      if (model_.largest(change) <= inBalance * model_.largest(state_.q)) {
        moved = state_.q - moved;
        return true;
      }
    }
    return false;
  }

  /// (K - R'f_d R) v = 0.
  bool velocities() {
    if (!factor()) return false;
    Vector force = Vector::Zero(model_.size());
    model_.addStiffness(state_.v.data(), force.data());
    force = -force;
    for (auto& batch : model_.points()) {
      batch.freezeTangent(1.0, 0.0);
      batch.addTangentTimes(state_.v.data(), force.data());
    }
    const Vector change = solve(std::move(force));
    if (!change.allFinite()) return false;
    if (model_.largest(change) > inBalance * model_.largest(state_.v)) state_.v += change;
    return true;
  }

  /// a := (..)^-1 a of a force that is in balance where there is no mass.
  bool acceleration(Vector& a) {
    if (!factor()) return false;
    factor_.solve(a.data());
    return a.allFinite();
  }

 private:
  /// At the state reached; laws are evaluated there.
  bool factor() {
    model_.combine(1.0, tau_, tau_ * tau_, factor_.values());
    for (auto& batch : model_.points()) {
      batch.look(state_.t, 0.0, state_.q.data());
      batch.evaluateWithTangent(state_.t, state_.q.data(), state_.v.data());
      batch.freezeTangent(tau_ * tau_, tau_);
      batch.takeOutPush();
      batch.subtractTangent(factor_.values());
    }
    return factor_.factor() < 0;
  }

  /// Change of the state [m, rad]; 0 at dofs with mass, unless the mass matrix is singular in
  /// motions of several of them.
  Vector solve(Vector force) const {
    force *= tau_ * tau_;
    factor_.solve(force.data());
    if (mass_.regular())
      for (int i = 0; i < model_.size(); ++i)
        if (!mass_.isMissing(i)) force[i] = 0.0;
    return force;
  }

  CompiledModel& model_;
  const MassFactor& mass_;
  State& state_;
  linalg::BlockFactor factor_;
  double tau_;
};

}  // namespace

void balanceMassless(CompiledModel& model, const MassFactor& mass, State& state) {
  bool missing = !mass.regular();
  for (int i = 0; i < model.size(); ++i) missing = missing || mass.isMissing(i);
  if (!model.cut().any(missing)) return;
  const State given = state;
  Balance balance(model, mass, state, still);
  Vector moved;
  if (!balance.possible() || !balance.positions(moved) || !balance.velocities()) {
    state = given;
    log::warn(
        "Degrees of freedom without mass could not be brought into balance at the start: they "
        "start as they are given, and the first step sets them free with an energy that the motion "
        "does not have.");
    return;
  }
  if (model.largest(moved) > inBalance * model.largest(state.q))
    log::info(
        "Degrees of freedom without mass start in balance with the others, with a change of "
        "up to " +
        formatNumber(model.largest(moved)) + " at " + model.worstName(moved) + ".");
}

bool solveSingularMass(CompiledModel& model, const MassFactor& mass, State& state) {
  Balance balance(model, mass, state, stillAccelerations);
  return balance.possible() && balance.acceleration(state.a);
}

}  // namespace tooljoint::transient
