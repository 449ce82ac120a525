// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/Validator.hpp"

#include <Teuchos_Array.hpp>
#include <algorithm>
#include <cmath>
#include <utility>

#include "common/Text.hpp"
#include "deck/Describe.hpp"
#include "deck/reading/Units.hpp"

namespace tooljoint::deck {
namespace {

template <class T>
void setArray(Teuchos::ParameterList& list, const std::string& name, const std::vector<T>& values) {
  list.set(name, Teuchos::Array<T>(values.begin(), values.end()));
}

struct Setter {
  Teuchos::ParameterList& list;
  const std::string& name;
  void operator()(Required) const {}
  void operator()(Optional) const {}
  void operator()(bool value) const { list.set(name, value); }
  void operator()(int value) const { list.set(name, value); }
  void operator()(double value) const { list.set(name, value); }
  void operator()(const std::string& value) const { list.set(name, value); }
  void operator()(const std::vector<int>& values) const { setArray(list, name, values); }
  void operator()(const std::vector<double>& values) const { setArray(list, name, values); }
  void operator()(const std::vector<std::string>& values) const { setArray(list, name, values); }
};

void setValue(Teuchos::ParameterList& list, const std::string& name, const Value& value) {
  std::visit(Setter{list, name}, value);
}

/// The most probable intended text in the type of `kind`; "" if there is none.
std::string rewritten(Kind kind, const RawParameter& given) {
  std::vector<std::string> candidates = {given.text, "{" + given.text + "}"};
  if (const double* real = std::get_if<double>(&given.value))
    candidates.push_back(formatNumber(*real));
  std::string ignored;
  for (const std::string& candidate : candidates) {
    if (parseValue(typeName(kind), candidate, ignored)) return candidate;
  }
  return "";
}

/// Checks one parameter against its description: gives a clause with the fault, or the value in SI.
class ParameterCheck {
 public:
  /// `unit` is the SI unit of the value, which may depend on another parameter.
  ParameterCheck(const ParameterSpec& spec, const RawParameter& given, std::string unit)
      : spec_(spec), given_(given), unit_(std::move(unit)) {}

  /// The value to store; none if fault() gives the reason.
  std::optional<Value> run() {
    std::optional<Value> value = converted();
    if (value && !inRange(*value)) return std::nullopt;
    if (value && !amongChoices(*value)) return std::nullopt;
    return value;
  }

  /// Continues the path: ` must be type="double" ...`, `: value="-1" ...`
  const std::string& fault() const { return fault_; }

 private:
  std::string quoted() const { return ": value=" + inQuotes(given_.text) + " "; }

  std::optional<Value> converted() {
    if (given_.type == typeName(spec_.kind)) return given_.value;
    const bool quantity = !spec_.unit.empty();
    if (spec_.kind == Kind::Real && quantity && given_.type == "string")
      return fromUnit(given_.text);
    if (spec_.kind == Kind::RealArray && quantity && given_.type == "Array(string)")
      return fromUnits();
    const std::string better = rewritten(spec_.kind, given_);
    const std::string wanted = "type=\"" + typeName(spec_.kind) + "\"";
    fault_ = " must be " + wanted + ", not type=" + inQuotes(given_.type);
    fault_ += better.empty() ? "." : ": write " + wanted + " value=" + inQuotes(better) + ".";
    fault_ += " " + introduce(spec_);
    return std::nullopt;
  }

  std::optional<Value> fromUnit(const std::string& text) {
    std::string why;
    const std::optional<double> value = toSi(text, unit_, why);
    if (value) return Value(*value);
    fault_ = quoted() + why + ".";
    return std::nullopt;
  }

  std::optional<Value> fromUnits() {
    std::vector<double> values;
    for (const std::string& entry : std::get<std::vector<std::string>>(given_.value)) {
      std::string why;
      const std::optional<double> value = toSi(entry, unit_, why);
      if (!value) {
        fault_ = ": the entry " + inQuotes(entry) + " (number " +
                 std::to_string(values.size() + 1) + ") " + why + ".";
        return std::nullopt;
      }
      values.push_back(*value);
    }
    return Value(values);
  }

  bool inRange(const Value& value) {
    if (const double* real = std::get_if<double>(&value)) return inRange(*real, 0);
    if (const int* whole = std::get_if<int>(&value)) return inRange(*whole, 0);
    if (const auto* reals = std::get_if<std::vector<double>>(&value)) return allInRange(*reals);
    if (const auto* wholes = std::get_if<std::vector<int>>(&value)) return allInRange(*wholes);
    return true;
  }

  template <class T>
  bool allInRange(const std::vector<T>& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      if (!inRange(values[i], i + 1)) return false;
    }
    return true;
  }

  /// `entry` is 1-based; 0 for a number outside an array.
  bool inRange(double number, std::size_t entry) {
    if (contains(spec_.range, number)) return true;
    const bool convertedUnit = given_.type == "string";
    fault_ = entry == 0
                 ? quoted()
                 : ": entry number " + std::to_string(entry) + ", " + formatNumber(number) + ", ";
    fault_ += (convertedUnit ? "(" + formatNumber(number) + " " + unit_ + ") " : std::string()) +
              "is out of range: it must be " + describe(spec_.range) + ". " + introduce(spec_);
    return false;
  }

  bool amongChoices(const Value& value) {
    if (spec_.choices.empty()) return true;
    std::vector<std::string> texts;
    if (const auto* text = std::get_if<std::string>(&value)) texts = {*text};
    if (const auto* array = std::get_if<std::vector<std::string>>(&value)) texts = *array;
    for (const std::string& text : texts) {
      if (std::find(spec_.choices.begin(), spec_.choices.end(), text) != spec_.choices.end())
        continue;
      const std::string near = closest(text, spec_.choices);
      const bool alone = spec_.kind == Kind::Choice;
      fault_ = alone ? quoted() : ": the entry " + inQuotes(text) + " ";
      fault_ += "is not one of " + quotedList(spec_.choices) + "." +
                (near.empty() ? "" : " Did you mean " + inQuotes(near) + "?");
      return false;
    }
    return true;
  }

  const ParameterSpec& spec_;
  const RawParameter& given_;
  std::string unit_;
  std::string fault_;
};

/// The choice of the list `spec` with `name` among its values; that list contains the parameters of
/// one of its variants.
const ParameterSpec* choiceOf(const ListSpec& spec, const std::string& name) {
  for (const auto& parameter : spec.parameters())
    if (parameter.kind == Kind::Choice &&
        std::find(parameter.choices.begin(), parameter.choices.end(), name) !=
            parameter.choices.end())
      return &parameter;
  return nullptr;
}

/// The first parameter in or below the list set by an override; null if there is none.
const RawParameter* overridden(const RawList& list) {
  for (const auto& parameter : list.parameters())
    if (parameter.place.overrideNumber > 0) return &parameter;
  for (const auto& sublist : list.lists())
    if (const auto* found = overridden(sublist)) return found;
  return nullptr;
}

class Validation {
 public:
  Validation(const ListSpec& root, std::vector<Finding>& findings, Places& places)
      : root_(root), findings_(findings), places_(places) {}

  /// `path` is the full path, `key` the path below the scene; `spec` is null inside a list that is
  /// passed through.
  void fill(const RawList& given, const ListSpec* spec, const std::string& path,
            const std::string& key, Teuchos::ParameterList& out) {
    out.setName(path);
    places_[key] = given.place;
    const std::string below = key.empty() ? "" : key + "/";
    for (const RawParameter& parameter : given.parameters()) {
      const ParameterSpec* known = spec == nullptr ? nullptr : spec->findParameter(parameter.name);
      Place place = parameter.place;
      if (known != nullptr && known->kind == Kind::Real && parameter.type == "string")
        place.unit = unitText(parameter.text);
      places_[below + parameter.name] = place;
      if (known != nullptr && !known->radius.empty()) {
        place.diameter = parameter.name;
        places_.emplace(below + known->radius, place);
      }
      fillParameter(parameter, given, spec, path, out);
    }
    for (const RawList& sublist : given.lists()) {
      const ListSpec* next = spec == nullptr ? nullptr : spec->findList(sublist.name);
      if (spec != nullptr && (next == nullptr || spec->findParameter(sublist.name) != nullptr)) {
        add(sublist.place, unknownList(root_, *spec, path, sublist.name, given));
        continue;
      }
      if (spec != nullptr) requireSelected(sublist, given, *spec, path);
      const bool described = next != nullptr && !next->passesThrough();
      fill(sublist, described ? next : nullptr, path + "/" + sublist.name, below + sublist.name,
           out.sublist(sublist.name));
    }
    if (spec != nullptr) complete(given, *spec, path, out);
  }

 private:
  /// A deck may contain lists of variants that it does not choose, but an override in such a list
  /// would be lost and is a fault. It is no fault if a later override changes the choice, as in the
  /// check of a study.
  void requireSelected(const RawList& variant, const RawList& list, const ListSpec& spec,
                       const std::string& path) {
    const ParameterSpec* choice = choiceOf(spec, variant.name);
    if (choice == nullptr) return;
    const RawParameter* given = list.findParameter(choice->name);
    const auto* usual = std::get_if<std::string>(&choice->value);
    const std::string chosen = given != nullptr   ? given->text
                               : usual != nullptr ? *usual
                                                  : std::string();
    if (chosen.empty() || chosen == variant.name) return;
    const RawParameter* lost = overridden(variant);
    if (lost == nullptr ||
        (given != nullptr && given->place.overrideNumber > lost->place.overrideNumber))
      return;
    const std::string below = path.substr(std::min(path.find('/', 1), path.size() - 1) + 1);
    add(lost->place, path + "/" + variant.name + " has no effect, since " + choice->name + " is " +
                         inQuotes(chosen) + ". Set " + below + "/" + choice->name + "=" +
                         variant.name + " too, or a parameter of " + below + "/" + chosen + ".");
  }

  void add(const Place& place, const std::string& text) { findings_.push_back({place, text}); }

  /// SI unit of a parameter in its list.
  static std::string unitOf(const ParameterSpec& parameter, const RawList& list) {
    if (!parameter.unitOf) return parameter.unit;
    const RawParameter* decides = list.findParameter(parameter.unitFrom);
    return parameter.unitOf(decides == nullptr ? "" : decides->text);
  }

  void fillParameter(const RawParameter& given, const RawList& list, const ListSpec* spec,
                     const std::string& path, Teuchos::ParameterList& out) {
    if (spec == nullptr) {
      setValue(out, given.name, given.value);
      return;
    }
    const ParameterSpec* parameter = spec->findParameter(given.name);
    if (parameter == nullptr) {
      add(given.place, unknownParameter(root_, *spec, path, given.name));
      return;
    }
    ParameterCheck check(*parameter, given, unitOf(*parameter, list));
    const std::optional<Value> value = check.run();
    if (!value) {
      add(given.place, path + "/" + given.name + check.fault());
    } else if (parameter->radius.empty()) {
      setValue(out, given.name, *value);
    } else if (list.holdsParameter(parameter->radius)) {
      add(given.place, path + "/" + given.name + " and " + parameter->radius +
                           " are both given: give one of them.");
    } else {
      out.set(parameter->radius, std::get<double>(*value) / 2.0);
    }
  }

  /// Reports missing required entries, and adds the defaults of omitted parameters.
  void complete(const RawList& given, const ListSpec& spec, const std::string& path,
                Teuchos::ParameterList& out) {
    for (const ParameterSpec& parameter : spec.parameters()) {
      if (given.holdsParameter(parameter.name) || given.holdsList(parameter.name)) continue;
      const ParameterSpec* diameter = spec.diameterOf(parameter.name);
      if (diameter != nullptr && given.holdsParameter(diameter->name)) continue;
      if (std::holds_alternative<Required>(parameter.value)) {
        add(given.place,
            path + "/" + parameter.name + " is required but missing: write <Parameter name=" +
                inQuotes(parameter.name) + " type=\"" + typeName(parameter.kind) +
                "\" value=\"...\"/>" + (diameter == nullptr ? "" : ", or give " + diameter->name) +
                ". " + introduce(parameter));
      }
      setDefault(out, parameter);
    }
    for (const ListSpec& sublist : spec.lists()) {
      if (!sublist.required() || given.holdsList(sublist.name()) ||
          given.holdsParameter(sublist.name()))
        continue;
      add(given.place,
          path + "/" + sublist.name() + " is required but missing: write <ParameterList name=" +
              inQuotes(sublist.name()) + ">...</ParameterList>. " + introduce(sublist));
    }
  }

  const ListSpec& root_;
  std::vector<Finding>& findings_;
  Places& places_;
};

}  // namespace

void setDefault(Teuchos::ParameterList& list, const ParameterSpec& parameter) {
  std::visit(Setter{list, parameter.name}, parameter.value);
}

Teuchos::ParameterList validate(const RawList& scene, const ListSpec& spec,
                                std::vector<Finding>& findings, Places& places) {
  Teuchos::ParameterList result;
  Validation(spec, findings, places).fill(scene, &spec, "/" + scene.name, "", result);
  return result;
}

}  // namespace tooljoint::deck
