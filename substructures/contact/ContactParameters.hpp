// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Deck list `Contact`: law, parameters, and their changes with depth.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "deck/ListSpec.hpp"
#include "substructures/contact/ContactLaw.hpp"
#include "substructures/contact/ContactPoints.hpp"

namespace tooljoint::contact {

/// Stretch of the hole with its own parameters (node, clearance and contact radius of `values` are
/// not used).
struct ContactInterval {
  std::string name;
  double from = 0.0;  ///< measured depth [m], included
  double to = 0.0;    ///< measured depth [m], not included
  ContactPoint values;
};

/// The values of the list `Contact`.
struct ContactSettings {
  std::string lawName = "Clamped";
  std::shared_ptr<const ContactLaw> law;
  ContactPoint values;                     ///< outside the intervals
  std::vector<ContactInterval> intervals;  ///< by depth, not overlapping
  bool friction = false;                   ///< any friction anywhere
  bool axialFriction = false;              ///< friction acts against sliding along the hole too

  /// Parameters at the depth s [m] for a node (1-based) with this clearance and contact radius [m].
  ContactPoint pointAt(double s, int node, double clearance, double contactRadius) const;
};

/// Description of the list `Contact`.
deck::ListSpec parameters();

/// Settings of a validated list `Contact`. Throws DeckError for conflicts between parameters:
/// dynamic friction above static friction, overlapping intervals.
ContactSettings readContact(const Teuchos::ParameterList& list);

}  // namespace tooljoint::contact
