// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Contact laws by name. A law is one file: a kernel F_n(G, G') and its registration (see
/// Clamped.cpp).
#pragma once

#include <memory>
#include <string>
#include <utility>

#include "deck/Registry.hpp"
#include "substructures/contact/BoreholeContact.hpp"
#include "substructures/contact/StaticContact.hpp"

namespace Teuchos {
class ParameterList;
}

namespace tooljoint::contact {

/// A law of the normal force. It makes the batches for the motion and for the static problem.
class ContactLaw {
 public:
  virtual ~ContactLaw() = default;
  /// Contact and friction in motion; `speed` is the rotary speed of the string.
  /// Coordinates are those of contactComponents().
  std::shared_ptr<const model::PointLaw> inMotion(ContactPoints points, RotarySpeed speed,
                                                  const AxialSliding& axial = {}) const {
    return makeInMotion(std::move(points), std::move(speed), axial);
  }
  /// Contact and full sliding at rest.
  virtual std::shared_ptr<const StaticContact> atRest(ContactPoints points) const = 0;
  /// False if the friction of the law acts in motion only: atRest() has none.
  virtual bool hasFrictionAtRest() const { return true; }

 private:
  virtual std::shared_ptr<const model::PointLaw> makeInMotion(ContactPoints points,
                                                              RotarySpeed speed,
                                                              const AxialSliding& axial) const = 0;
};

/// Laws by name; each gets its own sublist (empty when the law has no parameters of its own).
using LawRegistry = deck::Registry<ContactLaw, const Teuchos::ParameterList&>;

/// A law without a deck, with the default values of its parameters. Throws DeckError for an unknown
/// name.
std::shared_ptr<const ContactLaw> makeLaw(const std::string& name);

}  // namespace tooljoint::contact
