// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// A deck that has been read, strictly: the values in SI with all defaults, and the place each came
/// from.
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
/// Reading stops with a DeckError after the first phase that found faults, and that error holds all
/// of them, sorted by line: (1) lexical: malformed XML, unknown tags and attributes, duplicates,
/// values that are not wholly what their type says; (2) names, types, units, ranges, choices,
/// required parameters. Phase 3, the sense of it all, is class Problems.
///
/// Lists know their path: list().sublist("Contact").name() is "/helical_170m/Contact".
class Deck {
 public:
  /// Read `file` on rank 0 and hand its text to all ranks, so that all see the same and fail alike.
  /// Collective. `overrides` are "PATH=VALUE", or "!PATH" to take a list out. Throws FileError
  /// (file missing, a folder, unreadable), DeckError, UsageError (override without "=").
  static Deck read(const std::string& file, const ListSpec& scene,
                   const std::vector<std::string>& overrides = {});

  /// Chooses the description of a deck by the names of the lists in its root list, those taken out
  /// by overrides left out.
  using ChooseSpec = std::function<ListSpec(const std::vector<std::string>& lists)>;

  /// The same for a deck whose description depends on what it holds; the file is read and parsed
  /// once. Collective.
  static Deck read(const std::string& file, const ChooseSpec& choose,
                   const std::vector<std::string>& overrides = {});

  /// Read a file that the parameter at `path` of this deck names, relative to this deck's folder.
  /// Collective. A file that cannot be opened is then a DeckError that points at the parameter.
  Deck readNamed(const std::string& path, const std::string& name, const ListSpec& library) const;

  /// The same from a text in memory; `file` is what errors call it. Not collective.
  static Deck parse(const std::string& text, const std::string& file, const ListSpec& scene,
                    const std::vector<std::string>& overrides = {});
  static Deck parse(const std::string& text, const std::string& file, const ChooseSpec& choose,
                    const std::vector<std::string>& overrides = {});

  /// This deck with these overrides instead of its own, from the text that has been parsed.
  Deck with(const std::vector<std::string>& overrides) const;

  const Teuchos::ParameterList& list() const { return *list_; }
  const std::string& name() const { return name_; }  ///< of the root list
  std::string text() const;    ///< of the file as it was read, overrides not applied
  std::string sha256() const;  ///< of text()
  std::string file() const { return file_; }
  std::string folder() const;  ///< that holds the file; "." when its name has none
  const std::vector<std::string>& overrides() const { return overrides_; }

  /// A file name of the deck, relative to the deck's folder unless absolute.
  std::string resolve(const std::string& name) const;

  /// True when the deck or an override gave this list or parameter (not a default). For paths see
  /// where().
  bool gives(const std::string& path) const;

  /// "deck.xml:42: /Scene/Contact/Stiffness"; for a default the line of the list it would stand in,
  /// for an override
  /// "--set Contact/Stiffness=1: /Scene/Contact/Stiffness". `path` is "Contact/Stiffness" or a full
  /// one,
  /// "/Scene/Contact/Stiffness"; a radius given by its diameter is named so.
  std::string where(const std::string& path) const;

  /// How the deck gives the quantity at `path`, whose SI unit is `si`.
  Given given(const std::string& path, const std::string& si) const;

  /// where(path) + ": " + sentence, or + " " + sentence when the sentence continues the path with a
  /// verb in lower case ("is
  /// ...").
  std::string error(const std::string& path, const std::string& sentence) const;

  /// A message that begins with a full path of this deck ("/Scene/Contact/Stiffness is ..."), with
  /// file and line in front; any other message as it is. Lets rooms throw a DeckError from nothing
  /// but list.name().
  std::string located(const std::string& message) const;

 private:
  struct Source;  ///< what was read, and its description
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

/// Collects the faults of phase 3 (does the deck make sense?) and throws them together.
class Problems {
 public:
  explicit Problems(const Deck& deck) : deck_(deck) {}

  /// The thing at `path` is wrong: see Deck::where and Deck::error for both arguments.
  void add(const std::string& path, const std::string& sentence);
  /// The same for another file of this run, a component library.
  void add(const Deck& library, const std::string& path, const std::string& sentence);

  bool empty() const { return items_.empty(); }

  /// Throws one DeckError with a line for each fault, sorted by file and line; returns when there
  /// are none.
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

/// A list with the defaults of its description alone, for a list a deck may leave out. Required
/// sublists are filled too; a required parameter is a DeckError, since it has no default.
Teuchos::ParameterList defaults(const ListSpec& spec);

/// The sublist that holds a variant's own parameters (named after the variant), or its defaults
/// when the deck gives none.
Teuchos::ParameterList variantList(const Teuchos::ParameterList& list, const std::string& variant,
                                   const ListSpec& parameters);

}  // namespace tooljoint::deck
