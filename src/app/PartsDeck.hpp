// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Decks without a string: parts from files, how they are joined, reduced and moved.
#pragma once

#include <string>
#include <vector>

#include "app/Commands.hpp"
#include "coupling/input/CouplingParameters.hpp"
#include "deck/Deck.hpp"
#include "estimate/MotionEstimate.hpp"
#include "io/OutputParameters.hpp"
#include "io/Summary.hpp"
#include "parts/PartsScene.hpp"

namespace tooljoint::app {

/// Description of a deck of parts.
deck::ListSpec partsSceneSpec();

/// True for a deck with the list Parts and neither Drillstring nor Well, before anything else of it
/// is looked at. Collective.
bool isPartsDeck(const RunOptions& options);

/// Such a deck, read and checked, with its parts.
struct PartsDeck {
  deck::Deck deck;
  parts::PartsSettings settings;
  coupling::CouplingInput input;
  io::OutputSettings output;
  parts::PartsScene scene;

  const Teuchos::ParameterList& list() const { return deck.list(); }
  bool reduces() const { return list().isSublist("Reduction"); }
  bool moves() const { return list().isSublist("Transient"); }
  double startTime() const;
  /// Reads the files and puts the parts together. DeckError, ModelError, FileError. Collective.
  void build();
  /// Finds the state the parts start from. DeckError, ConvergenceError. Collective.
  void start();
  /// The unreduced parts in one model (always primal).
  coupling::Coupling whole() const;
};

/// Reads deck and files, puts the parts together and finds the state they start from. DeckError,
/// ModelError, ConvergenceError, FileError. Collective.
PartsDeck readPartsDeck(const RunOptions& options);

/// The lists alone, checked, before any part is read. DeckError, FileError. Collective.
PartsDeck readPartsLists(const RunOptions& options);

/// Throws ModelError naming a dof without mass where the deck's integrator divides by it.
void requireMass(const deck::Deck& deck, const parts::PartsScene& scene,
                 const model::SecondOrderModel& full);

/// A basis with interface forces leaves interface dofs to its modes, which may not start where the
/// neighbours do: only the reduction can tell. Reduces the parts of such a deck when they do not
/// start at rest, and throws what a run would. Collective.
void checkStart(const PartsDeck& deck);

/// "parts       5 parts from 2 files, 40 nodes, 117 dofs, 105 when joined".
std::string describeParts(const PartsDeck& deck, const coupling::Coupling& whole);

/// Displacements of all nodes at the start.
Vector restOf(const coupling::Coupling& whole);
/// What errors of a motion are measured in: translations, or everything where there are none.
std::vector<int> measuredComponents(const model::ComponentNames& names);
estimate::MotionOptions motionOptions(const model::SecondOrderModel& model);

/// Deck and size of a scene of parts.
void summarise(const PartsDeck& deck, const coupling::Coupling& whole, io::Summary& summary);

void runParts(const RunOptions& options);
void checkParts(const RunOptions& options);
void partsModes(const RunOptions& options);

}  // namespace tooljoint::app
