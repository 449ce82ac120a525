// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/Overrides.hpp"

#include <charconv>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/Describe.hpp"
#include "deck/reading/Units.hpp"
#include "deck/reading/Validator.hpp"

namespace tooljoint::deck {
namespace {

struct Override {
  std::vector<std::string> path;
  std::string value;
  bool removes = false;  ///< "!PATH": the list or parameter is removed
  Place place;
};

const ListSpec* declaredList(const ListSpec& spec, const std::string& name) {
  for (const ListSpec& list : spec.lists()) {
    if (list.name() == name) return &list;
  }
  return nullptr;
}

Override parseOverride(const std::string& text, int number) {
  Override result;
  result.removes = !text.empty() && text[0] == '!';
  const auto equals = result.removes ? text.size() : text.find('=');
  const std::string path = trim(result.removes ? text.substr(1) : text.substr(0, equals));
  if (result.removes && (path.empty() || path == "/"))
    throw UsageError("--without needs the path of a list, for example --without Reduction.");
  if (equals == std::string::npos || path.empty() || path == "/") {
    throw UsageError("--set " + text +
                     ": write --set PATH=VALUE, for example --set \"Transient/End Time=20\".");
  }
  result.path = split(path[0] == '/' ? path.substr(1) : path, '/');
  if (!result.removes) result.value = text.substr(equals + 1);
  result.place.overrideNumber = number;
  result.place.overrideText = text;
  return result;
}

/// The type attribute of an override: that of the description, or a string when the text is a
/// quantity with a unit.
std::string typeFor(const ParameterSpec& parameter, const std::string& text) {
  std::string type = typeName(parameter.kind);
  std::string ignored;
  if (parameter.unit.empty() || parseValue(type, text, ignored)) return type;
  if (parameter.kind == Kind::Real && !trim(text).empty()) return "string";
  if (parameter.kind == Kind::RealArray && parseValue("Array(string)", text, ignored))
    return "Array(string)";
  return type;
}

std::string typeLike(const std::string& text) {
  std::string ignored;
  for (const char* type : {"bool", "int", "double", "Array(int)", "Array(double)"}) {
    if (parseValue(type, text, ignored)) return type;
  }
  return parseValue("Array(string)", text, ignored) ? "Array(string)" : "string";
}

/// The text after the number at its beginning; "" if it does not begin with a number.
std::string tailOf(const std::string& text) {
  const std::string whole = trim(text);
  double number = 0.0;
  const auto [end, error] = std::from_chars(whole.data(), whole.data() + whole.size(), number);
  return error == std::errc()
             ? trim(std::string_view(end,
                                     static_cast<std::size_t>(whole.data() + whole.size() - end)))
             : "";
}

class Applier {
 public:
  Applier(RawList& scene, const ListSpec& spec, std::vector<Finding>& findings)
      : scene_(scene), spec_(spec), findings_(findings) {}

  void apply(Override item) {
    stripSceneName(item.path);
    RawList* list = &scene_;
    const ListSpec* spec = &spec_;  // null inside a list that is passed through
    std::string path = "/" + scene_.name;
    for (std::size_t i = 0; i < item.path.size(); ++i) {
      if (trim(item.path[i]).empty()) {
        findings_.push_back({item.place, "the path has an empty name."});
        return;
      }
      if (item.path[i].size() > longestQuote) {
        findings_.push_back({item.place, "the path has a name of " +
                                             std::to_string(item.path[i].size()) +
                                             " characters; the longest one has " +
                                             std::to_string(longestQuote) + "."});
        return;
      }
      if (i + 1 == item.path.size()) break;
      if (item.removes && !list->holdsList(item.path[i])) {
        missing(item, path, item.path[i], *list, spec);
        return;
      }
      if (!enter(item, item.path[i], path, list, spec)) return;
    }
    if (item.removes)
      remove(item, path, *list, spec);
    else
      assign(item, path, *list, spec);
  }

 private:
  void stripSceneName(std::vector<std::string>& path) const {
    const bool named = path.size() > 1 && (path[0] == scene_.name || path[0] == spec_.name());
    if (named && declaredList(spec_, path[0]) == nullptr && !scene_.holdsList(path[0]))
      path.erase(path.begin());
  }

  /// Enters the list `name`; false (and a finding) if there is no such list.
  bool enter(const Override& item, const std::string& name, std::string& path, RawList*& list,
             const ListSpec*& spec) {
    const ListSpec* next = spec == nullptr ? nullptr : declaredList(*spec, name);
    const bool ownName =
        spec != nullptr && next == nullptr && spec->pattern() != nullptr && list->holdsList(name);
    if (ownName) next = spec->pattern();
    if (spec != nullptr && next == nullptr) {
      findings_.push_back({item.place, unknownList(spec_, *spec, path, name, *list)});
      return false;
    }
    if (!list->holdsList(name)) {
      RawList fresh;
      fresh.name = name;
      fresh.place = item.place;
      list->add(std::move(fresh));
    }
    list = list->findList(name);
    path += "/" + name;
    spec = next == nullptr || next->passesThrough() ? nullptr : next;
    return true;
  }

  /// Removes a list or a parameter. A known but absent one is not a fault, so that the option works
  /// for every deck.
  void remove(const Override& item, const std::string& path, RawList& list, const ListSpec* spec) {
    const std::string& name = item.path.back();
    if (list.removeList(name) || list.removeParameter(name)) return;
    if (spec == nullptr || spec->findParameter(name) == nullptr)
      missing(item, path, name, list, spec);
  }

  void missing(const Override& item, const std::string& path, const std::string& name,
               const RawList& list, const ListSpec* spec) {
    if (spec != nullptr && declaredList(*spec, name) != nullptr) return;
    findings_.push_back({item.place, spec == nullptr
                                         ? path + " holds no list " + name + "."
                                         : unknownList(spec_, *spec, path, name, list)});
  }

  void assign(const Override& item, const std::string& path, RawList& list, const ListSpec* spec) {
    const std::string& name = item.path.back();
    RawParameter* present = list.findParameter(name);
    std::string type = present != nullptr ? present->type : typeLike(item.value);
    if (spec != nullptr) {
      const ParameterSpec* parameter = spec->findParameter(name);
      if (parameter == nullptr) {
        findings_.push_back({item.place, unknownParameter(spec_, *spec, path, name)});
        return;
      }
      type = typeFor(*parameter, item.value);
    }
    std::string fault;
    const std::optional<Value> value = parseValue(type, item.value, fault);
    if (!value) {
      const bool unitless =
          spec != nullptr && type == "double" && parseUnit(tailOf(item.value)).has_value();
      if (unitless && !tailOf(item.value).empty())
        fault = "is not a number: this parameter has no unit";
      findings_.push_back(
          {item.place, path + "/" + name + ": value=" + inQuotes(item.value) + " " + fault + "."});
      return;
    }
    RawParameter fresh{name, type, item.value, *value, item.place};
    if (present != nullptr) {
      *present = std::move(fresh);
    } else {
      list.add(std::move(fresh));
    }
  }

  RawList& scene_;
  const ListSpec& spec_;
  std::vector<Finding>& findings_;
};

}  // namespace

void applyOverrides(RawList& scene, const ListSpec& spec, const std::vector<std::string>& overrides,
                    std::vector<Finding>& findings) {
  Applier applier(scene, spec, findings);
  int number = 0;
  for (const std::string& text : overrides) applier.apply(parseOverride(text, ++number));
}

}  // namespace tooljoint::deck
