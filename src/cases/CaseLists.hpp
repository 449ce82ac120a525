// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck lists common to every kind of case (Coupling, Reduction, Transient, Output and those of
/// analyses): description, reading and checks. All faults of a deck are collected.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "common/Error.hpp"
#include "coupling/input/CouplingParameters.hpp"
#include "deck/Deck.hpp"
#include "io/OutputParameters.hpp"

namespace tooljoint::cases {

class Case;

/// The list of an analysis that is available for every kind of case, such as Study; registered by
/// the analysis.
struct AnalysisList {
  std::string name;                                         ///< of the list
  std::function<deck::ListSpec()> parameters;               ///< its description
  std::function<void(const Teuchos::ParameterList&)> read;  ///< DeckError: inconsistent values
  std::function<std::string(const Case&)> describe;         ///< for `check`; DeckError
  /// Line of `check` for a deck without the list; empty: no line.
  std::string without = {};
};

class AnalysisLists {
 public:
  static AnalysisLists& instance();
  /// Call from a namespace-scope constant in the file of the analysis.
  bool add(AnalysisList list);
  /// Sorted by name, independent of the link order.
  const std::vector<AnalysisList>& lists() const { return lists_; }

 private:
  std::vector<AnalysisList> lists_;
};

/// Runs readers one after the other and collects the faults of all of them, with file and line.
class Faults {
 public:
  /// \param spec description of the root list
  Faults(const deck::Deck& deck, const deck::ListSpec& spec);

  /// Collects the message of a DeckError; messages may begin with the name of a list of the deck.
  template <class Read>
  void attempt(const Read& read) {
    try {
      read();
    } catch (const DeckError& error) {
      keep(error.what());
    }
  }
  void add(const std::string& path, const std::string& sentence);
  bool none() const { return lines_.empty(); }
  /// DeckError with a line for each fault; returns if there is none.
  void raise() const;
  /// The lines of a message, each preceded by file and line.
  std::string located(const std::string& message) const;

 private:
  void keep(const std::string& message);

  const deck::Deck& deck_;
  std::vector<std::string> roots_;  ///< names of the lists of the deck
  std::vector<std::string> lines_;
};

/// Adds Reduction, Transient, Output and the lists of analyses to the description of a root list.
void addCommonLists(deck::ListSpec& scene);

/// The sublist, or the defaults of its description if the deck omits it.
Teuchos::ParameterList listOrDefaults(const Teuchos::ParameterList& deck,
                                      const deck::ListSpec& spec);

/// Typed values of Output and Coupling; the other common lists are read only for their faults.
struct CommonLists {
  io::OutputSettings output;
  std::optional<coupling::CouplingInput> coupling;  ///< null without the list
};
CommonLists readCommonLists(const Teuchos::ParameterList& deck, Faults& faults);

/// Consistency of the lists Reduction, Coupling, Transient and Output.
/// \param parts  names of the substructures, as far as they are known
void checkCommonLists(const Teuchos::ParameterList& deck, const CommonLists& common,
                      const std::vector<std::string>& parts, Faults& faults);

}  // namespace tooljoint::cases
