// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The rotary speed imposed at the surface, and the named scalar laws of time that follow from it.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "deck/ListSpec.hpp"
#include "deck/Registry.hpp"
#include "model/ScalarLaw.hpp"

namespace tooljoint::loads {

/// One form of Omega(t) for t >= 0, with derivative and integral in closed form.
class SpeedLaw {
 public:
  virtual ~SpeedLaw() = default;
  virtual double speed(double t) const = 0;  ///< Omega [rad/s]
  virtual double acceleration(
      double t) const = 0;  ///< dOmega/dt [rad/s2]; at a corner the value on its right
  virtual double angle(double t) const = 0;  ///< int_0^t Omega [rad]
  /// Increasing times [s] at which the formula changes. Between them and after the last one the law
  /// is smooth, and either zero everywhere or zero only at single instants.
  virtual std::vector<double> corners() const { return {}; }
};

/// name -> law. A law is one file that registers itself.
using SpeedLaws = deck::Registry<SpeedLaw, const Teuchos::ParameterList&>;

/// The deck list `Rotary Speed`, with one sublist per registered law.
deck::ListSpec rotarySpeedParameters();

/// The rotary speed of a scene. Without the deck list Omega = 0 at all times and no gyroscopic
/// matrix is needed.
class RotarySpeed {
 public:
  /// No rotation.
  RotarySpeed() = default;
  explicit RotarySpeed(std::shared_ptr<const SpeedLaw> law) : law_(std::move(law)) {}
  /// From the validated deck list `Rotary Speed`. DeckError when the parameters of the chosen law
  /// are inconsistent.
  explicit RotarySpeed(const Teuchos::ParameterList& list);
  /// A constant speed [rad/s].
  static RotarySpeed steady(double speed);
  /// From the whole deck: the list `Rotary Speed` if present, otherwise no rotation.
  static RotarySpeed fromDeck(const Teuchos::ParameterList& deck);

  /// True when the scene rotates: gyroscopic and speed-dependent matrices are built only then.
  bool present() const { return law_ != nullptr; }

  double speed(double t) const { return law_ ? law_->speed(t) : 0.0; }
  double acceleration(double t) const { return law_ ? law_->acceleration(t) : 0.0; }
  double angle(double t) const { return law_ ? law_->angle(t) : 0.0; }
  /// Sign of the speed at `from` [s] or, if it is zero there, of the first rotation after it; 0 if
  /// the string never turns.
  double sense(double from) const;

  /// Law of time by name: "1", "Omega", "sqrt|Omega|", "Omega^2", "Omega sqrt|Omega|", "dOmega/dt",
  /// and the two laws of a mass unbalance, "Omega^2 cos + dOmega/dt sin" and "Omega^2 sin -
  /// dOmega/dt cos" (of the angle int Omega dt). Throws Error(Internal) for another name.
  model::ScalarLaw scalar(const std::string& name) const;

 private:
  std::shared_ptr<const SpeedLaw> law_;
};

/// Names of the two laws of a mass unbalance, for RotarySpeed::scalar.
extern const char* const unbalanceCosine;
extern const char* const unbalanceSine;

}  // namespace tooljoint::loads
