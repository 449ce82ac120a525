// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A deck after strict reading: the values in SI with all defaults, and the origin of each.
#pragma once

#include <Teuchos_ParameterList.hpp>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "deck/Given.hpp"
#include "deck/ListSpec.hpp"

namespace tooljoint::deck {

/// One XML file read against one description: a scene, or a library of named things.
///
/// Reading stops with a DeckError after the first phase with faults. The error contains all of
/// them, sorted by line: (1) lexical: malformed XML, unknown tags and attributes, duplicates,
/// values that do not fully match their type; (2) names, types, units, ranges, choices, required
/// parameters. Phase 3, the consistency of the whole, is class Problems.
///
/// Lists know their path: list().sublist("Contact").name() is "/helical_170m/Contact".
class Deck {
 public:
  /// Reads `file` on rank 0 and sends its text to all ranks, so that all get the same result or
  /// error. Collective. `overrides` are "PATH=VALUE", or "!PATH" to remove a list. Throws FileError
  /// (file missing, a folder, unreadable), DeckError, UsageError (override without "=").
  static Deck read(const std::string& file, const ListSpec& scene,
                   const std::vector<std::string>& overrides = {});

  /// Chooses the description of a deck by the names of the lists in its root list, without those
  /// removed by overrides.
  using ChooseSpec = std::function<ListSpec(const std::vector<std::string>& lists)>;

  /// The same for a deck whose description depends on its content; the file is read and parsed
  /// once. Collective.
  static Deck read(const std::string& file, const ChooseSpec& choose,
                   const std::vector<std::string>& overrides = {});

  /// Reads a file named by the parameter at `path` of this deck, relative to the folder of the
  /// deck. Collective. A file that cannot be opened is a DeckError that points at the parameter.
  Deck readNamed(const std::string& path, const std::string& name, const ListSpec& library) const;

  /// The same for a text in memory; `file` is its name in errors. Not collective.
  static Deck parse(const std::string& text, const std::string& file, const ListSpec& scene,
                    const std::vector<std::string>& overrides = {});
  static Deck parse(const std::string& text, const std::string& file, const ChooseSpec& choose,
                    const std::vector<std::string>& overrides = {});

  /// This deck with other overrides in place of its own, from the parsed text.
  Deck with(const std::vector<std::string>& overrides) const;

  const Teuchos::ParameterList& list() const { return *list_; }
  const std::string& name() const { return name_; }  ///< of the root list
  std::string text() const;                          ///< of the file, overrides not applied
  std::string sha256() const;                        ///< of text()
  std::string file() const { return file_; }
  std::string folder() const;  ///< folder of the file; "." if the name has none
  const std::vector<std::string>& overrides() const { return overrides_; }

  /// A file name of the deck, relative to the deck's folder unless absolute.
  std::string resolve(const std::string& name) const;

  /// True if the deck or an override gave this list or parameter (so it is not a default). For
  /// paths see where().
  bool gives(const std::string& path) const;

  /// "deck.xml:42: /Scene/Contact/Stiffness"; for a default the line of the list that contains it,
  /// for an override "--set Contact/Stiffness=1: /Scene/Contact/Stiffness". `path` is
  /// "Contact/Stiffness" or a full path, "/Scene/Contact/Stiffness". A radius given by its diameter
  /// has the name of the diameter.
  std::string where(const std::string& path) const;

  /// Name and unit with which the deck gives the quantity at `path`, whose SI unit is `si`.
  Given given(const std::string& path, const std::string& si) const;

  /// where(path) + ": " + sentence, or + " " + sentence if the sentence continues the path with a
  /// verb in lower case ("is ...").
  std::string error(const std::string& path, const std::string& sentence) const;

  /// A message that begins with a full path of this deck ("/Scene/Contact/Stiffness is ...") gets
  /// file and line in front; other messages are unchanged. A room can thus throw a DeckError that
  /// uses only list.name().
  std::string located(const std::string& message) const;

 private:
  struct Source;  ///< the text and its description
  struct Map;     ///< path -> place
  static Deck make(std::shared_ptr<const Source> source, const std::string& file,
                   const std::vector<std::string>& overrides);
  std::string relative(const std::string& path) const;

  std::string file_;
  std::string name_;
  std::vector<std::string> overrides_;
  std::shared_ptr<const Source> source_;
  std::shared_ptr<const Teuchos::ParameterList> list_;
  std::shared_ptr<const Map> places_;

  friend class Problems;
};

/// Collects the faults of phase 3 (consistency of the deck) and throws them together.
class Problems {
 public:
  explicit Problems(const Deck& deck) : deck_(deck) {}

  /// Adds a fault at `path`: see Deck::where and Deck::error for both arguments.
  void add(const std::string& path, const std::string& sentence);
  /// The same for another file of this run, a component library.
  void add(const Deck& library, const std::string& path, const std::string& sentence);

  bool empty() const { return items_.empty(); }

  /// Throws one DeckError with a line for each fault, sorted by file and line; returns if there are
  /// none.
  void raise() const;

 private:
  struct Item {
    std::string file;
    int overrideNumber;
    int line;
    std::string text;
  };
  const Deck& deck_;
  std::vector<Item> items_;
};

/// A list with only the defaults of its description, for a list that a deck may omit. Required
/// sublists are filled too; a required parameter is a DeckError, since it has no default.
Teuchos::ParameterList defaults(const ListSpec& spec);

/// The sublist with the parameters of a variant (it has the name of the variant), or its defaults
/// if the deck gives none.
Teuchos::ParameterList variantList(const Teuchos::ParameterList& list, const std::string& variant,
                                   const ListSpec& parameters);

}  // namespace tooljoint::deck
