// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The kinds of cases there are, each registered by its own file, and the one that reads a deck.
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
  /// Of kinds that share a deck the one with the highest precedence reads it, and refuses the lists
  /// of the others; it also reads a deck with the lists of none.
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
  /// The kind that reads a deck whose root list holds these lists. DeckError for a deck of a kind
  /// whose library is not linked, with what to link.
  const CaseKind& of(const std::vector<std::string>& lists) const;

 private:
  std::vector<CaseKind> kinds_;
};

/// Reads the deck once, finds its kind and makes the case. DeckError, ModelError, FileError.
/// Collective.
std::unique_ptr<Case> readCase(const std::string& file, const std::vector<std::string>& overrides);
/// The same of a deck in memory, the same on all ranks; `file` is what errors call it, and relative
/// names of files are relative to its folder.
std::unique_ptr<Case> parseCase(const std::string& text, const std::string& file,
                                const std::vector<std::string>& overrides);

}  // namespace tooljoint::cases
