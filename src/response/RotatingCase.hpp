// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A case at rest as linear equations at any rotary speed: the basis of Campbell diagrams and
/// responses.
#pragma once

#include <complex>
#include <memory>
#include <optional>
#include <vector>

#include "cases/Case.hpp"
#include "cases/ReducedCase.hpp"
#include "estimate/DynamicError.hpp"
#include "estimate/ModeComparison.hpp"
#include "linalg/trilinos/EigenSolver.hpp"

namespace tooljoint::response {

/// M x'' + C(Omega) x' + K(Omega) x = f about the state at rest, with the tangents of closed
/// contacts and without open contacts. Laws of the rotary speed (model::SpeedLaw) have their value
/// at Omega, other laws of time that at the end of the motion. The reduced model if the deck has
/// the list Reduction, with its error estimate if the basis is a Ritz basis; otherwise the full
/// model.
class RotatingCase {
 public:
  /// Computes the state at rest and reduces the parts.
  /// \param friction  false: contacts without friction
  /// \param announce  logs state and coupling, and judges the state. Throws the errors of these
  /// stages.
  ///                  Collective. The case must outlive the object.
  RotatingCase(const cases::Case& one, bool friction, bool announce = true);

  const cases::Case& deckCase() const { return case_; }
  const cases::RestingCase& rest() const { return *rest_; }
  bool reduced() const { return reduced_.has_value(); }
  bool estimated() const { return error_ != nullptr; }
  /// The solved model, and the parts it was reduced from (none for a full model).
  const model::SecondOrderModel& model() const;
  const std::vector<model::Substructure>& parts() const;
  /// The full model, made at its first use. Collective.
  const model::SecondOrderModel& full() const;

  /// The solved model at a rotary speed [rad/s], with the point laws to be linearised.
  model::SecondOrderModel turned(double speed) const { return turning(model(), speed); }
  double time() const { return time_; }  ///< of laws that do not depend on the speed [s]

  /// Matrices of the solved model, of the full model and of the parts, at a rotary speed [rad/s].
  /// With `omega` the states of point laws take part in motions e^{i omega t}; otherwise they are
  /// constant.
  estimate::Linearised at(double speed, std::optional<double> omega = {}) const;
  estimate::Linearised fullAt(double speed, std::optional<double> omega = {}) const;
  std::vector<estimate::Linearised> partsAt(double speed, std::optional<double> omega = {}) const;

  /// The `count` damped modes of smallest |s| of the solved model, or all if it has fewer.
  linalg::QuadraticModes modes(const estimate::Linearised& m, int count) const;
  /// The modes nearest to a target (linalg::dampedModesNear).
  linalg::QuadraticModes modes(const estimate::Linearised& m,
                               const linalg::DampedTarget& target) const;
  /// Damped modes of the full and of the reduced model side by side (estimate::compareDampedModes).
  /// Needs reduced().
  std::vector<estimate::ModeComparison> compare(double speed, int count) const;
  std::vector<estimate::ModeComparison> compare(double speed,
                                                const linalg::DampedTarget& target) const;
  /// Possible rounding error of y'K y (linalg::roundingOf) of the solved model.
  double rounding(const estimate::Linearised& m, const Eigen::VectorXcd& y) const;
  /// Needs estimated().
  const estimate::DynamicError& error() const { return *error_; }

  /// Logs which laws depend on the speed; warns if no matrix does, or if one is not defined for all
  /// of these speeds [rad/s].
  void announceLaws(const std::vector<double>& speeds) const;
  /// Warns of point laws with states that are constant in the modes.
  void announceHeldStates() const;
  /// Warns of point laws whose states do not take part in a harmonic motion.
  void announceUnknownStates() const;

 private:
  /// compareDampedModes at a speed for `which`: a count or a target.
  template <class Which>
  std::vector<estimate::ModeComparison> compareAt(double speed, const Which& which) const;
  template <class Models>
  auto linearised(const Models& models, std::optional<double> omega) const;
  model::SecondOrderModel turning(const model::SecondOrderModel& model, double speed) const;
  std::vector<model::Substructure> turningParts(double speed) const;

  const cases::Case& case_;
  bool friction_;
  double time_;  ///< of laws that do not depend on the speed [s]
  std::shared_ptr<const cases::RestingCase> rest_;
  std::optional<cases::ReducedCase> reduced_;
  mutable std::optional<coupling::Coupling> full_;
  linalg::EnergyRounding rounding_;
  std::unique_ptr<estimate::DynamicError> error_;
};

}  // namespace tooljoint::response
