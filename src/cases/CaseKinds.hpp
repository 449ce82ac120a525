// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The kinds of cases, each registered by its own file, and the selection of the kind of a deck.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "cases/Case.hpp"
#include "deck/ListSpec.hpp"

namespace tooljoint::cases {

struct CaseKind {
  /// A deck with one of these lists is of this kind.
  std::vector<std::string> lists;
  /// Among kinds that share a deck the one with the highest precedence reads it and rejects the
  /// lists of the others. It also reads a deck that has lists of no kind.
  int precedence = 0;
  std::function<deck::ListSpec()> parameters;
  /// DeckError, ModelError, FileError. Collective.
  std::function<std::unique_ptr<Case>(deck::Deck)> make;
};

class CaseKinds {
 public:
  static CaseKinds& instance();
  /// Call from a namespace-scope constant in the file of the kind.
  bool add(CaseKind kind);
  /// The kind that reads a deck whose root list holds these lists. DeckError for a deck whose kind
  /// is in a library that is not linked; the message names the library.
  const CaseKind& of(const std::vector<std::string>& lists) const;

 private:
  std::vector<CaseKind> kinds_;
};

/// Reads the deck once, selects its kind and makes the case. DeckError, ModelError, FileError.
/// Collective.
std::unique_ptr<Case> readCase(const std::string& file, const std::vector<std::string>& overrides);
/// The same for a deck in memory, equal on all ranks. `file` is its name in errors, and relative
/// file names are relative to the folder of `file`.
std::unique_ptr<Case> parseCase(const std::string& text, const std::string& file,
                                const std::vector<std::string>& overrides);

}  // namespace tooljoint::cases
