// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck of a case of imported parts: where the parts come from, how they are joined, reduced
/// and moved.
#pragma once

#include <string>
#include <vector>

#include "cases/CaseLists.hpp"
#include "deck/Deck.hpp"
#include "parts/PartsScene.hpp"

namespace tooljoint::cases {

/// Description of a deck of imported parts.
deck::ListSpec importedSpec();

/// Such a deck as plain values, checked, before any part is read.
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

  /// Reads the files and puts the parts together. DeckError, ModelError, FileError. Collective.
  parts::PartsScene build() const;
  /// DeckError, ModelError: these parts lack what the list Reduction needs.
  void checkReduction(const parts::PartsScene& scene) const;
  /// Finds the state the parts start from; the rest as in parts::findStart. DeckError,
  /// ConvergenceError. Collective.
  Vector start(parts::PartsScene& scene) const;
  /// ModelError naming a dof without mass where the integrator of the deck divides by it.
  void requireMass(const parts::PartsScene& scene, const model::SecondOrderModel& full) const;
};

}  // namespace tooljoint::cases
