// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck of a case of imported parts: source of the parts, connections, reduction and motion.
#pragma once

#include <string>
#include <vector>

#include "cases/CaseLists.hpp"
#include "deck/Deck.hpp"
#include "parts/PartsScene.hpp"

namespace tooljoint::cases {

/// Description of a deck of imported parts.
deck::ListSpec importedSpec();

/// Typed values of such a deck, checked before any part is read.
struct ImportedDeck {
  deck::Deck deck;
  parts::PartsSettings settings;
  CommonLists common;

  /// DeckError with a line for each fault.
  explicit ImportedDeck(deck::Deck read);

  const Teuchos::ParameterList& list() const { return deck.list(); }
  bool reduces() const { return list().isSublist("Reduction"); }
  bool moves() const { return list().isSublist("Transient"); }
  double startTime() const;  ///< [s]; 0 without a motion

  /// Reads the files and joins the parts. DeckError, ModelError, FileError. Collective.
  parts::PartsScene build() const;
  /// DeckError, ModelError: the parts lack data that the list Reduction needs.
  void checkReduction(const parts::PartsScene& scene) const;
  /// Computes the initial state of the parts; otherwise as parts::findStart. DeckError,
  /// ConvergenceError. Collective.
  Vector start(parts::PartsScene& scene) const;
  /// ModelError with the name of a dof without mass if the integrator of the deck divides by the
  /// mass.
  void requireMass(const parts::PartsScene& scene, const model::SecondOrderModel& full) const;
};

}  // namespace tooljoint::cases
