// SPDX-License-Identifier: BSD-3-Clause
#include "deck/ListSpec.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "common/Text.hpp"
#include "deck/Describe.hpp"

namespace tooljoint::deck {
namespace {

/// Allows whole numbers as defaults of real parameters: real("Length", "m", 1, ...).
Default asReal(Default value) {
  if (const int* whole = std::get_if<int>(&value)) return static_cast<double>(*whole);
  if (const auto* wholes = std::get_if<std::vector<int>>(&value))
    return std::vector<double>(wholes->begin(), wholes->end());
  return value;
}

bool holdsNothing(const Default& value) {
  return std::holds_alternative<Required>(value) || std::holds_alternative<Optional>(value);
}

bool fits(Kind kind, const Default& value) {
  if (holdsNothing(value)) return true;
  switch (kind) {
    case Kind::Real:
      return std::holds_alternative<double>(value);
    case Kind::Integer:
      return std::holds_alternative<int>(value);
    case Kind::Boolean:
      return std::holds_alternative<bool>(value);
    case Kind::Text:
    case Kind::Choice:
      return std::holds_alternative<std::string>(value);
    case Kind::RealArray:
      return std::holds_alternative<std::vector<double>>(value);
    case Kind::IntegerArray:
      return std::holds_alternative<std::vector<int>>(value);
    case Kind::TextArray:
      return std::holds_alternative<std::vector<std::string>>(value);
  }
  return false;
}

/// The default as numbers, empty if it has none.
std::vector<double> numbersOf(const Default& value) {
  if (const double* real = std::get_if<double>(&value)) return {*real};
  if (const int* whole = std::get_if<int>(&value)) return {static_cast<double>(*whole)};
  if (const auto* reals = std::get_if<std::vector<double>>(&value)) return *reals;
  if (const auto* wholes = std::get_if<std::vector<int>>(&value))
    return {wholes->begin(), wholes->end()};
  return {};
}

std::vector<std::string> textsOf(const Default& value) {
  if (const auto* text = std::get_if<std::string>(&value)) return {*text};
  if (const auto* texts = std::get_if<std::vector<std::string>>(&value)) return *texts;
  return {};
}

void inspect(const ParameterSpec& parameter, const std::string& path,
             std::vector<std::string>& faults) {
  const std::string where = path + "/" + parameter.name;
  if (parameter.name.empty() || trim(parameter.name) != parameter.name)
    faults.push_back(where + " has an empty name, or blanks around it");
  if (parameter.doc.empty()) faults.push_back(where + " has no sentence that documents it");
  if (!fits(parameter.kind, parameter.value))
    faults.push_back(where + " has a default of another type than its own");
  for (const double number : numbersOf(parameter.value)) {
    if (!contains(parameter.range, number))
      faults.push_back(where + " has a default outside its range");
  }
  if (parameter.kind == Kind::Choice && parameter.choices.empty())
    faults.push_back(where + " has no choices");
  if (parameter.choices.empty()) return;
  for (const std::string& text : textsOf(parameter.value)) {
    if (std::find(parameter.choices.begin(), parameter.choices.end(), text) ==
        parameter.choices.end()) {
      faults.push_back(where + " has a default that is not one of its choices");
    }
  }
}

void inspect(const ListSpec& list, const std::string& path, std::vector<std::string>& faults) {
  std::set<std::string> names;
  const auto claim = [&](const std::string& name) {
    if (!names.insert(name).second) faults.push_back(path + "/" + name + " is declared twice");
  };
  for (const ParameterSpec& parameter : list.parameters()) {
    claim(parameter.name);
    for (const std::string& former : parameter.formerNames) claim(former);
    inspect(parameter, path, faults);
    if (parameter.level == Level::Expert && std::holds_alternative<Required>(parameter.value))
      faults.push_back(path + "/" + parameter.name + " is required, so it cannot be for experts");
  }
  for (const ListSpec& sublist : list.lists()) {
    claim(sublist.name());
    inspect(sublist, path + "/" + sublist.name(), faults);
  }
  if (list.pattern() != nullptr)
    inspect(*list.pattern(), path + "/<" + list.pattern()->name() + ">", faults);
}

}  // namespace

ListSpec& ListSpec::add(ParameterSpec parameter) {
  parameters_.push_back(std::move(parameter));
  return *this;
}

ListSpec& ListSpec::real(std::string name, std::string unit, Default value, Range range,
                         std::string doc) {
  return add({std::move(name),
              Kind::Real,
              std::move(unit),
              asReal(std::move(value)),
              range,
              {},
              std::move(doc)});
}

ListSpec& ListSpec::radius(const std::string& name, Default value, Range range,
                           const std::string& doc) {
  const std::string ending = "Radius";
  const std::string diameter = name.substr(0, name.size() - ending.size()) + "Diameter";
  real(name, "m", std::move(value), range, doc);
  real(diameter, "m", Optional{}, range, "Twice the " + name + "; give one of the two.");
  parameters_.back().radius = name;
  return *this;
}

ListSpec& ListSpec::unitBy(std::string parameter,
                           std::function<std::string(const std::string&)> unitOf) {
  parameters_.back().unitFrom = std::move(parameter);
  parameters_.back().unitOf = std::move(unitOf);
  return *this;
}

ListSpec& ListSpec::expert() {
  parameters_.back().level = Level::Expert;
  return *this;
}

ListSpec& ListSpec::formerly(std::string name) {
  parameters_.back().formerNames.push_back(std::move(name));
  return *this;
}

ListSpec& ListSpec::removed(const std::vector<std::string>& names, const std::string& instead) {
  for (const auto& name : names) removed_[name] = instead;
  return *this;
}

ListSpec& ListSpec::integer(std::string name, Default value, Range range, std::string doc) {
  return add({std::move(name), Kind::Integer, "", std::move(value), range, {}, std::move(doc)});
}

ListSpec& ListSpec::boolean(std::string name, Default value, std::string doc) {
  return add({std::move(name), Kind::Boolean, "", std::move(value), {}, {}, std::move(doc)});
}

ListSpec& ListSpec::text(std::string name, Default value, std::string doc) {
  return add({std::move(name), Kind::Text, "", std::move(value), {}, {}, std::move(doc)});
}

ListSpec& ListSpec::choice(std::string name, Default value, std::vector<std::string> choices,
                           std::string doc) {
  return add({std::move(name),
              Kind::Choice,
              "",
              std::move(value),
              {},
              std::move(choices),
              std::move(doc)});
}

ListSpec& ListSpec::realArray(std::string name, std::string unit, Default value, Range range,
                              std::string doc) {
  return add({std::move(name),
              Kind::RealArray,
              std::move(unit),
              asReal(std::move(value)),
              range,
              {},
              std::move(doc)});
}

ListSpec& ListSpec::integerArray(std::string name, Default value, Range range, std::string doc) {
  return add(
      {std::move(name), Kind::IntegerArray, "", std::move(value), range, {}, std::move(doc)});
}

ListSpec& ListSpec::textArray(std::string name, Default value, std::vector<std::string> choices,
                              std::string doc) {
  return add({std::move(name),
              Kind::TextArray,
              "",
              std::move(value),
              {},
              std::move(choices),
              std::move(doc)});
}

ListSpec& ListSpec::list(ListSpec sublist) {
  lists_.push_back(std::move(sublist));
  return *this;
}

ListSpec& ListSpec::requiredList(ListSpec sublist) {
  sublist.required_ = true;
  return list(std::move(sublist));
}

ListSpec& ListSpec::namedLists(ListSpec pattern) {
  pattern_ = {std::move(pattern)};
  return *this;
}

ListSpec& ListSpec::passThrough(std::string name, std::string doc) {
  ListSpec sublist(std::move(name), std::move(doc));
  sublist.passThrough_ = true;
  return list(std::move(sublist));
}

ListSpec& ListSpec::merge(const ListSpec& other) {
  for (const ParameterSpec& parameter : other.parameters_) {
    const ParameterSpec* mine = findParameter(parameter.name);
    if (mine == nullptr) {
      parameters_.push_back(parameter);
    } else if (mine->kind != parameter.kind || mine->unit != parameter.unit) {
      throw std::logic_error("ListSpec::merge: \"" + parameter.name + "\" of \"" + other.name_ +
                             "\" is declared otherwise in \"" + name_ + "\"");
    }
  }
  removed_.insert(other.removed_.begin(), other.removed_.end());
  for (const ListSpec& sublist : other.lists_) {
    const auto mine = std::find_if(lists_.begin(), lists_.end(),
                                   [&](const ListSpec& l) { return l.name_ == sublist.name_; });
    if (mine == lists_.end()) {
      lists_.push_back(sublist);
    } else {
      mine->merge(sublist);
      mine->required_ = mine->required_ || sublist.required_;
    }
  }
  if (pattern_.empty()) pattern_ = other.pattern_;
  return *this;
}

ListSpec ListSpec::named(std::string name) const {
  ListSpec copy = *this;
  copy.name_ = std::move(name);
  return copy;
}

const ParameterSpec* ListSpec::findParameter(const std::string& name) const {
  const auto it = std::find_if(parameters_.begin(), parameters_.end(),
                               [&](const ParameterSpec& p) { return p.name == name; });
  return it == parameters_.end() ? nullptr : &*it;
}

const ParameterSpec* ListSpec::findFormer(const std::string& name) const {
  const auto it = std::find_if(parameters_.begin(), parameters_.end(), [&](const auto& p) {
    return std::find(p.formerNames.begin(), p.formerNames.end(), name) != p.formerNames.end();
  });
  return it == parameters_.end() ? nullptr : &*it;
}

const std::string* ListSpec::findRemoved(const std::string& name) const {
  const auto it = removed_.find(name);
  return it == removed_.end() ? nullptr : &it->second;
}

const ParameterSpec* ListSpec::diameterOf(const std::string& radius) const {
  const auto it = std::find_if(parameters_.begin(), parameters_.end(),
                               [&](const ParameterSpec& p) { return p.radius == radius; });
  return it == parameters_.end() ? nullptr : &*it;
}

const ListSpec* ListSpec::findList(const std::string& name) const {
  const auto it = std::find_if(lists_.begin(), lists_.end(),
                               [&](const ListSpec& l) { return l.name_ == name; });
  return it == lists_.end() ? pattern() : &*it;
}

std::vector<std::string> ListSpec::inconsistencies() const {
  std::vector<std::string> faults;
  inspect(*this, "/" + name_, faults);
  return faults;
}

}  // namespace tooljoint::deck
