// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The deck lists that every kind of case takes (Coupling, Reduction, Transient, Output and those
/// of analyses): their description, reading and checks, with all faults of a deck collected.
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

/// The list of an analysis that every kind of case takes, such as Study; registered by the
/// analysis.
struct AnalysisList {
  std::string name;                                         ///< of the list
  std::function<deck::ListSpec()> parameters;               ///< its description
  std::function<void(const Teuchos::ParameterList&)> read;  ///< DeckError: it makes no sense
  std::function<std::string(const Case&)> describe;         ///< for `check`; DeckError
  /// What a deck without the list lacks for it, for `check`; empty: nothing is said.
  std::string without = {};
};

class AnalysisLists {
 public:
  static AnalysisLists& instance();
  /// Call from a namespace-scope constant in the file of the analysis.
  bool add(AnalysisList list);
  /// By name: in whatever order they were linked.
  const std::vector<AnalysisList>& lists() const { return lists_; }

 private:
  std::vector<AnalysisList> lists_;
};

/// Runs readers one after the other and keeps the faults of all of them, with file and line.
class Faults {
 public:
  /// \param spec description of the root list
  Faults(const deck::Deck& deck, const deck::ListSpec& spec);

  /// Keeps the message of a DeckError; messages may begin with the name of a list of the deck.
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
  /// DeckError with a line for each fault; returns when there is none.
  void raise() const;
  /// The lines of a message with file and line in front.
  std::string located(const std::string& message) const;

 private:
  void keep(const std::string& message);

  const deck::Deck& deck_;
  std::vector<std::string> roots_;  ///< names of the lists of the deck
  std::vector<std::string> lines_;
};

/// Adds Reduction, Transient, Output and the lists of analyses to the description of a root list.
void addCommonLists(deck::ListSpec& scene);

/// The sublist, or the defaults of its description when the deck leaves it out.
Teuchos::ParameterList listOrDefaults(const Teuchos::ParameterList& deck,
                                      const deck::ListSpec& spec);

/// Output and Coupling as plain values; the other common lists are read for their faults alone.
struct CommonLists {
  io::OutputSettings output;
  std::optional<coupling::CouplingInput> coupling;  ///< null without the list
};
CommonLists readCommonLists(const Teuchos::ParameterList& deck, Faults& faults);

/// What the lists Reduction, Coupling, Transient and Output require of each other.
/// \param parts names of the substructures, as far as they are known
void checkCommonLists(const Teuchos::ParameterList& deck, const CommonLists& common,
                      const std::vector<std::string>& parts, Faults& faults);

}  // namespace tooljoint::cases
