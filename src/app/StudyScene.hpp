// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A scene as a study sees it, whatever it is made of: a deck that can be read again with changes,
/// and something at rest that can be reduced and set in motion.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "app/Commands.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "coupling/input/ResolvedCoupling.hpp"
#include "deck/Deck.hpp"
#include "io/ResultsFile.hpp"
#include "io/Summary.hpp"

namespace tooljoint::app {

/// What of a motion is recorded and compared.
struct Measures {
  std::vector<std::int64_t> nodes;  ///< in the order of all histories
  std::vector<int> components;      ///< of a node
  std::size_t vibrating =
      0;  ///< how many of them, from the first on, are the vibration that dyn measures
  std::vector<double> clearance;  ///< per node [m]; infinite where nothing can be touched
  int speedRow =
      -1;  ///< row of the recovery whose velocity is the speed of the bit; -1: there is no bit
  std::function<double(double)> turning;  ///< what is added to that velocity [rad/s]
};

/// Scenes made by with() from one another share the states at rest that they have in common. All
/// calls are collective.
class StudyScene {
 public:
  virtual ~StudyScene() = default;

  virtual const deck::Deck& deck() const = 0;
  /// The same deck with other overrides. DeckError, ModelError, FileError.
  virtual std::unique_ptr<StudyScene> with(const std::vector<std::string>& overrides) const = 0;
  /// Lists that the full model does without.
  virtual std::vector<std::string> reductionLists() const = 0;
  virtual int nodes() const = 0;
  /// What `Output/Folder` says; "" when it says nothing.
  virtual std::string folder() const = 0;
  /// Content of the files that decide the numbers beside the deck. On rank 0 only.
  virtual std::string files() const = 0;
  virtual void summarise(io::Summary& summary) const = 0;

  /// Finds the state at rest; what follows needs it. ConvergenceError, ModelError.
  virtual void settle() = 0;
  /// The full model; maps of its parts where it was coupled from them.
  virtual coupling::Coupling full() const = 0;
  /// The parts that are reduced, and what joins them.
  virtual coupling::ResolvedCoupling parts() const = 0;
  /// Displacements at rest, rows of the recovery.
  virtual Vector rest() const = 0;
  virtual Measures measures() const = 0;
  /// What a results file says of the nodes and of the state at rest.
  virtual void write(io::ResultsFile& file) const = 0;

  const Teuchos::ParameterList& list() const { return deck().list(); }
  bool reduces() const { return list().isSublist("Reduction"); }
  bool moves() const { return list().isSublist("Transient"); }
};

/// The scene of a deck, of a string or of parts. DeckError, ModelError, FileError.
std::unique_ptr<StudyScene> readStudyScene(const RunOptions& options);

/// One kind each. DeckError, FileError; for parts also ModelError.
std::unique_ptr<StudyScene> readStringStudy(const RunOptions& options);
std::unique_ptr<StudyScene> readPartsStudy(const RunOptions& options);

}  // namespace tooljoint::app
