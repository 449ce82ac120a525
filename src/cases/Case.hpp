// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A case: a model of any kind that comes to rest, can be divided into parts, reduced and
/// integrated in time. Commands (run, check, study, modes, export) are written once against this
/// interface; a case supplies data.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/MotionRecord.hpp"
#include "coupling/assembly/Assembler.hpp"
#include "coupling/input/ResolvedCoupling.hpp"
#include "deck/Deck.hpp"
#include "io/OutputFolder.hpp"
#include "io/OutputParameters.hpp"
#include "io/ResultsFile.hpp"
#include "io/summary/Summary.hpp"
#include "parts/file/PartFile.hpp"

namespace tooljoint::cases {

/// factor times a component of a node.
struct NodeTerm {
  std::int64_t node = 0;
  int component = 0;
  double factor = 1.0;
};
/// Two sums of displacements, in two directions across an axis.
using NodeSums = std::array<std::vector<NodeTerm>, 2>;

/// The bending moment of a beam element.
struct BendingPlace {
  NodeSums moment;               ///< about the state at rest, in two axes across the element [N m]
  double depth = 0.0;            ///< of its middle [m]
  double stressPerMoment = 0.0;  ///< at the outer wall [1/m3]
};

/// Quantities of a motion that are recorded and compared.
struct Measures {
  std::vector<std::int64_t> nodes;    ///< in the order of all histories
  std::vector<double> depth;          ///< of the nodes [m]; empty if they have none
  std::vector<BendingPlace> bending;  ///< of the elements; empty if the case has none
  std::vector<int> components;        ///< of a node
  std::size_t vibrating =
      0;  ///< number of components, from the first on, whose motion the vibration error measures
  std::vector<double> clearance;  ///< per node [m]; infinite if a node cannot touch anything
  std::string wall;               ///< point set of the walls; "" for none
  int speedRow =
      -1;  ///< row of the recovery whose velocity is the speed of the bit; -1: there is no bit
  std::function<double(double)> turning;  ///< added to that velocity [rad/s]

  /// The components of the vibration.
  std::vector<int> vibration() const {
    return {components.begin(), components.begin() + static_cast<std::ptrdiff_t>(vibrating)};
  }
};

/// A line of `tooljoint check`: whether something is modelled or computed, and why.
struct OutlineItem {
  bool present = false;
  std::string what;
  std::string why;
};

/// The lines of `tooljoint check` for a case.
struct CaseOutline {
  std::vector<OutlineItem> modelled;
  OutlineItem rest;                ///< how the state at rest is computed
  std::string reduction;           ///< parts that are reduced, if the deck reduces
  OutlineItem coupling;            ///< how the parts are joined
  std::vector<std::string> notes;  ///< further lines on the coupling
};

/// A number that describes a state at rest.
struct RestFigure {
  std::string name, unit, longName;
  double value = 0.0;

  template <class Archive>
  void serialize(Archive& archive) {
    archive(name, unit, longName, value);
  }
};

/// A case at rest. All calls are collective.
class RestingCase {
 public:
  virtual ~RestingCase() = default;

  /// Warns of a doubtful state. ConvergenceError for a wrong one.
  virtual void judge() const {}

  /// The full model; with the maps of its parts if it was coupled from them.
  virtual coupling::Coupling full() const = 0;
  /// The parts to reduce, and their connections.
  virtual coupling::ResolvedCoupling parts() const = 0;
  /// Displacements at rest, rows of the recovery.
  virtual Vector rest() const = 0;
  virtual Measures measures() const = 0;

  /// Lines of the log; "" for none.
  virtual std::string describe() const = 0;
  virtual void summarise(io::Summary& summary) const = 0;
  /// The same names in the same order for all states of a case.
  virtual std::vector<RestFigure> figures() const { return {}; }
  /// Groups of results.h5 before the motion, and tables beside it.
  virtual void write(io::ResultsFile& file) const = 0;
  virtual void stageTables(io::OutputFolder& folder) const { (void)folder; }
  /// Data on the nodes and on the state at rest in the file of a study.
  virtual void writeProfile(io::ResultsFile& file) const = 0;

  /// The recorder for the motion of a model of this case. The case, `model` and `file` must outlive
  /// it.
  virtual std::unique_ptr<MotionRecord> record(const model::SecondOrderModel& model) const = 0;
  /// Contents of the unreduced parts for an export.
  virtual std::vector<parts::PartContent> contents(
      const std::vector<model::Substructure>& parts) const = 0;
};

using Overrides = std::vector<std::string>;

/// Cases made by with() share the states at rest that they have in common. All calls are
/// collective.
class Case {
 public:
  virtual ~Case() = default;

  virtual const deck::Deck& deck() const = 0;
  /// The same deck with other overrides; its file is not read again. DeckError, ModelError,
  /// FileError.
  virtual std::unique_ptr<Case> with(const std::vector<std::string>& overrides) const = 0;
  /// The same case turning at a constant rotary speed [rad/s]; 0: the slowest possible. Null if its
  /// state at rest does not depend on the speed. DeckError: it has no such state.
  virtual std::unique_ptr<Case> turningAt(double speed) const {
    (void)speed;
    return nullptr;
  }
  /// Lists that the full model does not use.
  virtual std::vector<std::string> reductionLists() const = 0;
  /// Choices that the deck leaves to the predicted cost of a step: for each, alternatives in trial
  /// order, as overrides of this deck. The first choice is always made, others only if the reduced
  /// model is hardly faster than the full one. Empty if the deck decides everything.
  virtual std::vector<std::vector<Overrides>> openChoices() const { return {}; }
  /// True when a run reduces the parts although the deck has no Transient list.
  virtual bool reducesWithoutMotion() const = 0;
  virtual const io::OutputSettings& output() const = 0;
  /// Content of the files that affect the results, in addition to the deck. On rank 0 only.
  virtual std::string files() const = 0;

  virtual int nodes() const = 0;
  virtual int components() const = 0;  ///< numbers that describe the motion of a node
  virtual int freeDofs() const = 0;    ///< of the full model
  /// A line of the log: kind and size of the case.
  virtual std::string describe() const = 0;
  /// Doubts about the case, one sentence each.
  virtual std::vector<std::string> remarks() const = 0;
  virtual void summarise(io::Summary& summary) const = 0;
  virtual CaseOutline outline() const = 0;

  /// Computes what `check` needs to reject every case that a run would reject. ModelError,
  /// ConvergenceError.
  virtual void verify() const = 0;
  /// Computes the state at rest. ConvergenceError, ModelError.
  virtual std::shared_ptr<const RestingCase> solveStatic() const = 0;

  const Teuchos::ParameterList& list() const { return deck().list(); }
  bool reduces() const { return list().isSublist("Reduction"); }
  bool moves() const { return list().isSublist("Transient"); }
  const Teuchos::ParameterList& transient() const { return list().sublist("Transient"); }
  const Teuchos::ParameterList& reduction() const { return list().sublist("Reduction"); }
  /// The state at rest, after judge().
  std::shared_ptr<const RestingCase> atRest() const {
    auto rest = solveStatic();
    rest->judge();
    return rest;
  }
};

}  // namespace tooljoint::cases
