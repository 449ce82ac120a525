// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Laws of time of a deck for the terms and loads of imported parts.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <string>

#include "deck/ListSpec.hpp"
#include "deck/Registry.hpp"
#include "model/ScalarLaw.hpp"

namespace tooljoint::parts {

/// A scalar function of time.
class TimeLaw {
 public:
  virtual ~TimeLaw() = default;
  virtual double value(double t) const = 0;
};

/// name -> form; a new form is one file that registers itself.
using TimeLaws = deck::Registry<TimeLaw, const Teuchos::ParameterList&>;

/// Description of one law: its form, and a sublist of the numbers of each form.
deck::ListSpec timeLawParameters();

/// The law of a validated list, under the name of the law. DeckError when its numbers are missing
/// or make no sense together.
model::ScalarLaw readTimeLaw(const std::string& name, const Teuchos::ParameterList& list);

}  // namespace tooljoint::parts
