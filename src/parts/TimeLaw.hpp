// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Laws of time of a deck for the terms and loads of imported parts.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "deck/Registry.hpp"
#include "model/ScalarLaw.hpp"

namespace tooljoint::parts {

/// Name of the law whose value is the rotary speed [rad/s].
constexpr const char* rotarySpeedName = "Omega";

/// A scalar function of time.
class TimeLaw {
 public:
  virtual ~TimeLaw() = default;
  virtual double value(double t) const = 0;
  /// As ScalarLaw::corners.
  virtual std::vector<double> corners() const { return {}; }
  /// True: value() takes the rotary speed [rad/s] instead of the time.
  virtual bool ofSpeed() const { return false; }
  /// Increasing arguments outside which value() is that of the first or the last one; empty for a
  /// formula.
  virtual std::vector<double> places() const { return {}; }
};

/// name -> form; a form is one file that registers itself.
using TimeLaws = deck::Registry<TimeLaw, const Teuchos::ParameterList&>;

/// Description of one law: its form, and a sublist with the numbers of each form.
deck::ListSpec timeLawParameters();

/// The law of a validated list; it has the name of the list. The law rotarySpeedName, its
/// derivative "dOmega/dt" and forms that depend on the speed contain a model::SpeedLaw. \param
/// speed  rotary speed over time; none: the deck has no such law. DeckError if numbers are
///               missing or inconsistent, or if the law needs the speed and there is none.
model::ScalarLaw readTimeLaw(const std::string& name, const Teuchos::ParameterList& list,
                             const model::ScalarLaw& speed);

}  // namespace tooljoint::parts
