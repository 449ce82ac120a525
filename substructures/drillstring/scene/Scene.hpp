// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A deck of a string in its well, read, checked and converted to typed values: the input of the
/// stages of a run.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cases/CaseLists.hpp"
#include "substructures/contact/ContactParameters.hpp"
#include "substructures/drilling/BitLaw.hpp"
#include "substructures/drilling/TopDrive.hpp"
#include "substructures/drillstring/DrillString.hpp"
#include "substructures/drillstring/Partition.hpp"
#include "substructures/drillstring/Supports.hpp"
#include "substructures/equilibrium/Equilibrium.hpp"
#include "substructures/loads/Damping.hpp"
#include "substructures/loads/Load.hpp"
#include "substructures/loads/RotarySpeed.hpp"
#include "substructures/mud/MudModel.hpp"
#include "substructures/path/Path.hpp"
#include "substructures/well/Well.hpp"

namespace tooljoint::drillstring {

/// Description of a whole deck: all lists of all rooms.
deck::ListSpec sceneSpec();

/// A deck's lists as typed values. Lists that the deck does not have are absent here too.
struct Scene {
  deck::Deck deck;
  well::Well well;
  DrillString string;
  SupportSettings supports;
  std::vector<char> held;  ///< 6 per node: by a support, or because no element there has the dof
  std::shared_ptr<const mud::MudModel> mud;  ///< null: no mud
  std::optional<contact::ContactSettings> contact;
  contact::ContactPoints contactPoints;  ///< empty without contact
  loads::RotarySpeed rotary;
  loads::Loads loads;
  loads::RayleighDamping damping;
  path::PathOptions path;
  equilibrium::StaticOptions statics;
  PartitionRules partition;
  io::OutputSettings output;
  std::optional<coupling::CouplingInput> coupling =
      std::nullopt;  ///< null: parts are joined by equal node numbers only
  std::optional<drilling::BitSettings> bit = std::nullopt;  ///< null: only loads act on the bit
  drilling::TopDrive topDrive = {};                         ///< with its gains

  const Teuchos::ParameterList& list() const { return deck.list(); }
  bool reduces() const { return list().isSublist("Reduction"); }
  bool moves() const { return list().isSublist("Transient"); }
  /// Time of the static state, the start of the motion [s]; 0 without motion.
  double startTime() const;
  int freeDofs() const;
  /// WOB of the list Loads [N].
  double weightOnBit() const;
  /// `held` in the static state, in which drive and hook hold the top.
  std::vector<char> heldAtRest() const;
};

/// Checks a deck read by sceneSpec(). DeckError (one line per fault of the phase that failed),
/// FileError. Collective.
Scene readScene(const deck::Deck& deck);
/// The scene at a constant rotary speed [rad/s]; 0: the slowest possible. An autodriller that sets
/// the block speed does so at this speed. DeckError: its weight is not reached.
Scene turningAt(Scene scene, double speed);
/// Reads the file with overrides, then checks it.
Scene readScene(const std::string& file, const std::vector<std::string>& overrides);

}  // namespace tooljoint::drillstring
