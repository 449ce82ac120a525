// SPDX-License-Identifier: BSD-3-Clause
#include "transient/schemes/MasslessStart.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "linalg/blocks/BlockFactor.hpp"
#include "model/NodalFrequency.hpp"

namespace tooljoint::transient {
namespace {

/// tau^2 as a part of 1/omega^2 of the fastest node: dofs with mass move by this part of their
/// deflection.
constexpr double still = 1e-13;
/// The same if motions of several dofs are massless: there tau^2 K must exceed the rounding of M.
constexpr double stillOfSeveral = 1e-10;
/// The same for accelerations, where imbalance by rounding is divided by tau^2.
constexpr double stillAccelerations = 1e-8;
/// Relative change of the state that counts as rounding.
constexpr double inBalance = 1e-10;
/// The same for forces between parts, which only accelerations determine: their rounding is divided
/// by tau^2.
constexpr double roundingOfForces = 0.01;
/// The same for rates, where rounding of balanced forces is divided by tau.
constexpr double ratesInBalance = 1e-6;
/// If successive changes of Newton's method differ by less than this part, they are creep of dofs
/// with damping: each is tau over their time constant of the way to balance and must be undone.
constexpr double creeping = 0.1;
/// Newton iterations after which such forces are left as they are; iteration limit: laws with a gap
/// open and close during the iteration.
constexpr int fewIterations = 3, mostIterations = 60;

/// tau [s] with tau^2 = this part of 1/omega^2 of the fastest node; 0 if no dof has mass and
/// stiffness.
double shortTime(const CompiledModel& model, double t, double part) {
  const double most = model.cut().largest(model::fastestNode(model.source(), t));
  return most > 0.0 ? std::sqrt(part / most) : 0.0;
}

/// Largest displacement at zero coordinates: that of a state about which parts were reduced.
double referenceSize(const CompiledModel& model) {
  const Vector& offset = model.source().recoveryOffset;
  return model.cut().largest(offset.size() > 0 ? offset.cwiseAbs().maxCoeff() : 0.0);
}

/// Solves with M + tau (C - R'f_v R) + tau^2 (K - R'f_d R).
class Balance {
 public:
  Balance(CompiledModel& model, const MassFactor& mass, State& state, double part)
      : model_(model),
        mass_(mass),
        state_(state),
        factor_(model.pattern()),
        reference_(referenceSize(model)),
        tau_(shortTime(model, state.t, part)) {}

  bool possible() const { return tau_ > 0.0; }

  /// Whether a change of the displacements is rounding.
  bool isRounding(const Vector& change) const {
    return model_.largest(change) <= inBalance * scale();
  }

  /// Whether a change is rounding except for forces between parts. Their rounding is divided by
  /// tau^2: they follow from accelerations if nothing else determines them.
  bool isRoundingOfForces(const Vector& change) const {
    double displacement = 0.0;
    const auto& dofs = model_.pattern().partition().dof;
    for (int i = 0; i < model_.size(); ++i)
      if (model_.source().dofs[at(dofs[at(i)])].force == 0)
        displacement = std::max(displacement, std::abs(change[i]));
    return model_.cut().largest(displacement) <= inBalance * scale() &&
           model_.largest(change) <= roundingOfForces * scale();
  }

  /// Newton's method for F - C v - K q + R'f = 0 at dofs with neither mass nor damping; false if it
  /// does not converge.
  bool positions(Vector& moved) {
    const Vector given = state_.q;
    Vector before = Vector::Zero(model_.size());
    double first = 0.0;
    int alike = 0;  // consecutive changes
    for (int i = 0; i < mostIterations; ++i) {
      if (!factor()) return false;
      const Vector unbalanced = force();
      if (i == 0) reference_ = std::max(reference_, deflection(unbalanced));
      const Vector change = solve(tau_ * tau_ * unbalanced);
      if (!change.allFinite()) return false;
      state_.q += change;
      const double size = model_.largest(change);
      if (i == 0) first = size;
      alike = model_.largest(change - before) <= creeping * size ? alike + 1 : 0;
      before = change;
      const bool onlyCreeps = alike == 2;
      const bool onlyForces = i >= fewIterations && isRoundingOfForces(change);
      if (onlyCreeps) state_.q -= (i + 1.0) * change;
      if (onlyForces && first <= 10.0 * size) state_.q = given;
      if (onlyCreeps || onlyForces || isRounding(change)) {
        moved = state_.q - given;
        return true;
      }
    }
    return false;
  }

  /// Rates at dofs with damping but no mass: Newton's method for F - C v - K (q + h v) + R'f = 0 at
  /// q + h v, so that relaxation faster than a step h only reaches balance. The rates are unchanged
  /// if it does not converge.
  void rates(double h) {
    const Vector given = state_.v;
    for (int i = 0; i < mostIterations && factor(h); ++i) {
      Vector change = solve(tau_ * force(h));
      // subtracts tau times the acceleration of dofs with mass, to second order
      Vector inertia = Vector::Zero(model_.size());
      model_.addMass(change.data(), inertia.data());
      change -= solve(std::move(inertia));
      if (!change.allFinite()) break;
      state_.v += change;
      if (model_.largest(change) <=
          std::max(ratesInBalance * model_.largest(state_.v), inBalance * reference_ / h))
        return;
    }
    state_.v = given;
  }

  /// (K - R'f_d R) v = 0. The second change repeats the creep of dofs with mass or damping, and is
  /// subtracted.
  bool velocities() {
    if (!factor()) return false;
    const Vector change = velocityChange(state_.v);
    const Vector creeps = velocityChange(state_.v + change);
    if (!change.allFinite() || !creeps.allFinite()) return false;
    if (model_.largest(change) > inBalance * model_.largest(state_.v)) state_.v += change - creeps;
    return true;
  }

  /// a := (..)^-1 a of a force in balance at massless dofs.
  bool acceleration(Vector& a) {
    if (!factor()) return false;
    factor_.solve(a.data());
    return a.allFinite();
  }

 private:
  /// M + tau (C - R'f_v R) + tau max(tau, h) (K - R'f_d R) at q + h v; laws are evaluated there.
  bool factor(double h = 0.0) {
    const double k = tau_ * std::max(tau_, h);
    const Vector q = state_.q + h * state_.v;
    model_.combine(1.0, tau_, k, factor_.values());
    for (auto& batch : model_.points()) {
      batch.look(state_.t, 0.0, q.data());
      batch.evaluateWithTangent(state_.t, q.data(), state_.v.data());
      batch.freezeTangent(k, tau_);
      batch.takeOutPush();
      batch.subtractTangent(factor_.values());
    }
    return factor_.factor() < 0;
  }

  double scale() const { return std::max(model_.largest(state_.q), reference_); }

  /// Largest ratio of a force to the stiffness of its dof.
  double deflection(const Vector& force) const {
    Vector stiffness(model_.size());
    model_.diagonal(0.0, 0.0, 1.0, stiffness.data());
    double largest = 0.0;
    for (int i = 0; i < model_.size(); ++i)
      if (stiffness[i] != 0.0) largest = std::max(largest, std::abs(force[i] / stiffness[i]));
    return model_.cut().largest(largest);
  }

  /// Newton change for (K - R'f_d R) v = 0, after factor().
  Vector velocityChange(const Vector& v) {
    Vector out = Vector::Zero(model_.size());
    model_.addStiffness(v.data(), out.data());
    out = -out;
    for (auto& batch : model_.points()) {
      batch.freezeTangent(1.0, 0.0);
      batch.addTangentTimes(v.data(), out.data());
    }
    return solve(tau_ * tau_ * out);
  }

  /// F - C v - K (q + h v) + R'f(q + h v, v), after factor(h) [N, N m].
  Vector force(double h = 0.0) {
    Vector out = Vector::Zero(model_.size());
    const Vector q = state_.q + h * state_.v;
    model_.addStiffness(q.data(), out.data());
    model_.addDamping(state_.v.data(), out.data());
    out = Eigen::Map<const Vector>(model_.timed().load(), model_.size()) - out;
    for (auto& batch : model_.points()) batch.addForce(out.data());
    return out;
  }

  /// Solution for a force; 0 at dofs with mass, unless the mass matrix is singular in a motion of
  /// several dofs.
  Vector solve(Vector force) const {
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
  double reference_;  ///< displacement to compare rounding with
  double tau_;
};

}  // namespace

void balanceMassless(CompiledModel& model, const MassFactor& mass, double h, State& state) {
  bool missing = !mass.regular();
  for (int i = 0; i < model.size(); ++i) missing = missing || mass.isMissing(i);
  if (!model.cut().any(missing)) return;
  const State given = state;
  Balance balance(model, mass, state, mass.regular() ? still : stillOfSeveral);
  Vector moved;
  bool balanced = balance.possible() && balance.positions(moved);
  if (balanced) {
    balance.rates(h);
    balanced = balance.velocities();
  }
  if (!balanced) {
    state = given;
    log::warn(
        "Degrees of freedom without mass could not be brought into balance at the start: they "
        "start as they are given, and the first step sets them free with an energy that the motion "
        "does not have.");
    return;
  }
  if (!balance.isRounding(moved))
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
