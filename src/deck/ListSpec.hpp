// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Description of one deck list: its parameters with type, unit, range, default and a sentence, and
/// its sublists. The strict reader, the manual (`tooljoint doc`) and the templates all use these
/// objects, so they always agree.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace tooljoint::deck {

enum class Kind { Real, Integer, Boolean, Text, Choice, RealArray, IntegerArray, TextArray };

/// Interval of allowed numbers; an open end excludes the bound itself.
struct Range {
  double min = -std::numeric_limits<double>::infinity();
  double max = std::numeric_limits<double>::infinity();
  bool openMin = false;
  bool openMax = false;
  static Range any() { return {}; }
  static Range positive() { return {0.0, std::numeric_limits<double>::infinity(), true, false}; }
  static Range nonNegative() {
    return {0.0, std::numeric_limits<double>::infinity(), false, false};
  }
  static Range between(double lo, double hi) { return {lo, hi, false, false}; }
  static Range atLeast(double lo) {
    return {lo, std::numeric_limits<double>::infinity(), false, false};
  }
};

/// Entry of the tree for a parameter that the deck omits.
struct Required {};  ///< an error when absent
struct Optional {};  ///< it remains absent: test with isParameter()
using Default = std::variant<Required, Optional, bool, int, double, std::string, std::vector<int>,
                             std::vector<double>, std::vector<std::string>>;

/// Audience of a parameter: manual, `tooljoint doc` and templates show the basic ones first.
enum class Level { Basic, Expert };

struct ParameterSpec {
  std::string name;
  Kind kind = Kind::Real;
  /// SI unit of a Real or RealArray, "" if it has none; it also decides which unit strings are
  /// accepted.
  std::string unit = {};
  Default value = Required{};
  Range range = {};                       ///< numbers, and every entry of number arrays
  std::vector<std::string> choices = {};  ///< Choice, every entry of a TextArray when not empty
  std::string doc = {};                   ///< one sentence
  /// For a diameter: the parameter that is half of it; only that parameter is in the tree.
  std::string radius = {};
  /// Parameter of the same list that decides the unit; `unit` then names all of them.
  std::string unitFrom = {};
  /// SI unit for the value of `unitFrom`, "" if that is absent.
  std::function<std::string(const std::string&)> unitOf = {};
  Level level = Level::Basic;
  std::vector<std::string> formerNames = {};  ///< rejected with a sentence that gives the new name
};

/// Builder and description of a list. The manual has the order of declaration.
class ListSpec {
 public:
  ListSpec() = default;
  ListSpec(std::string name, std::string doc) : name_(std::move(name)), doc_(std::move(doc)) {}

  ListSpec& real(std::string name, std::string unit, Default value, Range range, std::string doc);
  /// A length `name` = "... Radius", and in addition "... Diameter", twice as long. A deck gives
  /// one of them; the tree always contains the radius. A required radius may be given by its
  /// diameter.
  ListSpec& radius(const std::string& name, Default value, Range range, const std::string& doc);
  /// The unit of the parameter declared last depends on the value of another one: N for a force, N
  /// m for a torque.
  ListSpec& unitBy(std::string parameter, std::function<std::string(const std::string&)> unitOf);
  /// The parameter declared last is for experts.
  ListSpec& expert();
  /// The parameter declared last was named `name` in earlier versions; "../X": X, one list up.
  ListSpec& formerly(std::string name);
  /// The list had parameters of these names in earlier versions; `instead`: a sentence that follows
  /// "was removed: ".
  ListSpec& removed(const std::vector<std::string>& names, const std::string& instead);
  ListSpec& integer(std::string name, Default value, Range range, std::string doc);
  ListSpec& boolean(std::string name, Default value, std::string doc);
  ListSpec& text(std::string name, Default value, std::string doc);
  ListSpec& choice(std::string name, Default value, std::vector<std::string> choices,
                   std::string doc);
  ListSpec& realArray(std::string name, std::string unit, Default value, Range range,
                      std::string doc);
  ListSpec& integerArray(std::string name, Default value, Range range, std::string doc);
  ListSpec& textArray(std::string name, Default value, std::vector<std::string> choices,
                      std::string doc);

  /// A sublist that may be absent; an absent list is not built, stored or evaluated.
  ListSpec& list(ListSpec sublist);
  /// A required sublist.
  ListSpec& requiredList(ListSpec sublist);
  /// Sublists with names chosen by the user, all described by `pattern` (component definitions,
  /// depth intervals, ...).
  ListSpec& namedLists(ListSpec pattern);
  /// A sublist passed unchanged to a Trilinos package (which checks names and types).
  ListSpec& passThrough(std::string name, std::string doc);
  /// Adds all declarations of `other` (a registered variant extends the common parameters).
  ListSpec& merge(const ListSpec& other);
  /// The same list under another name (a variant's parameters, under the variant's name).
  ListSpec named(std::string name) const;

  const std::string& name() const { return name_; }
  const std::string& doc() const { return doc_; }
  const std::vector<ParameterSpec>& parameters() const { return parameters_; }
  const std::vector<ListSpec>& lists() const { return lists_; }
  const ListSpec* pattern() const { return pattern_.empty() ? nullptr : &pattern_.front(); }
  bool required() const { return required_; }
  bool passesThrough() const { return passThrough_; }
  const ParameterSpec* findParameter(const std::string& name) const;
  /// The parameter that was named `name` in earlier versions; null if there is none.
  const ParameterSpec* findFormer(const std::string& name) const;
  /// The sentence on a removed parameter; null for a name that never existed.
  const std::string* findRemoved(const std::string& name) const;
  /// The diameter that may replace this radius; null if there is none.
  const ParameterSpec* diameterOf(const std::string& radius) const;
  const ListSpec* findList(
      const std::string& name) const;  ///< declared sublist, or the pattern if there is one

  /// Faults of the description itself, for developers: names declared twice, defaults of another
  /// type, outside the range or not among the choices, parameters without a sentence. Empty if
  /// there are none; Deck::read rejects a description with faults.
  std::vector<std::string> inconsistencies() const;

 private:
  ListSpec& add(ParameterSpec parameter);

  std::string name_;
  std::string doc_;
  std::vector<ParameterSpec> parameters_;
  std::map<std::string, std::string> removed_;
  std::vector<ListSpec> lists_;
  std::vector<ListSpec> pattern_;  ///< none or one
  bool required_ = false;
  bool passThrough_ = false;
};

}  // namespace tooljoint::deck
