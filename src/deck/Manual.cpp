// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Manual.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/Describe.hpp"
#include "deck/PrintedUnits.hpp"
#include "deck/reading/Units.hpp"

namespace tooljoint::deck {
namespace {

using Json = nlohmann::ordered_json;

const std::string unitsTopic = "Units";

const std::string unitsIntroduction =
    "Units of quantities written with one, as in `type=\"string\" value=\"5 in\"`, and in the "
    "header of a survey. They combine: "
    "`kg/m3`, `lb/gal`, `bbl/min`, `N s/m`, `ft lbf`, `ft-lbf`, `ft.lbf`, `deg/30m`, `W/(m s)`. "
    "`t`, `lb` and `klb` are masses, "
    "and "
    "where a force or torque is expected the weight of that mass under standard gravity, 9.80665 "
    "m/s2. `sg` is the density "
    "referred to 1000 kg/m3.";

/// A list with its path; the path of the root is its name.
struct Located {
  const ListSpec* list;
  std::string path;
};

std::string patternName(const ListSpec& pattern) { return "<" + pattern.name() + ">"; }

void collect(const ListSpec& list, const std::string& path, std::vector<Located>& all) {
  all.push_back({&list, path});
  for (const ListSpec& sublist : list.lists()) collect(sublist, path + "/" + sublist.name(), all);
  if (list.pattern() != nullptr)
    collect(*list.pattern(), path + "/" + patternName(*list.pattern()), all);
}

std::vector<Located> collect(const ListSpec& root) {
  std::vector<Located> all;
  collect(root, root.name(), all);
  return all;
}

std::string lastName(const std::string& path) {
  const std::string name = path.substr(path.rfind('/') + 1);
  return name.size() > 2 && name.front() == '<' ? name.substr(1, name.size() - 2) : name;
}

/// True if `path` is the topic, or ends with "/topic". Case does not matter.
bool matches(const std::string& path, const std::string& topic) {
  const std::string whole = lower(path);
  const std::string end = lower(topic);
  if (whole == end || lower(lastName(path)) == end) return true;
  return whole.size() > end.size() &&
         whole.compare(whole.size() - end.size() - 1, std::string::npos, "/" + end) == 0;
}

bool startsWith(const std::string& text, const std::string& start) {
  return text.compare(0, start.size(), start) == 0;
}

/// Lists of a topic: those with that name and all below them, otherwise those with a parameter of
/// that name.
std::vector<Located> select(const std::vector<Located>& all, const std::string& rawTopic) {
  std::string topic = trim(rawTopic);
  while (!topic.empty() && topic.front() == '/') topic.erase(0, 1);
  if (topic.empty()) return all;
  std::vector<Located> found;
  for (const Located& item : all) {
    const bool below = std::any_of(all.begin(), all.end(), [&](const Located& top) {
      return matches(top.path, topic) &&
             (item.path == top.path || startsWith(item.path, top.path + "/"));
    });
    if (below) found.push_back(item);
  }
  if (!found.empty()) return found;
  for (const Located& item : all) {
    const auto& parameters = item.list->parameters();
    const bool holds =
        std::any_of(parameters.begin(), parameters.end(),
                    [&](const ParameterSpec& p) { return lower(p.name) == lower(topic); });
    if (holds) found.push_back(item);
  }
  return found;
}

[[noreturn]] void refuse(const std::vector<Located>& all, const std::string& topic) {
  std::vector<std::string> names;
  for (const Located& item : all) {
    const std::string name = lastName(item.path);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  std::vector<std::string> candidates = names;
  candidates.push_back(unitsTopic);
  for (const Located& item : all) {
    for (const ParameterSpec& parameter : item.list->parameters())
      candidates.push_back(parameter.name);
  }
  const std::string near = closest(topic, candidates);
  throw UsageError("The manual has no topic \"" + topic + "\"." +
                   (near.empty() ? "" : " Did you mean \"" + near + "\"?") +
                   " Topics are the lists " + quotedList(names) +
                   ", the names of parameters, and \"" + unitsTopic + "\".");
}

/// Text of a table cell: "|" and line ends would break the table, "<" would start HTML. Also
/// readable on terminals.
std::string cell(const std::string& text) {
  std::string result;
  for (const char c : text) {
    if (c == '|')
      result += "\\|";
    else if (c == '<')
      result += "\\<";
    else
      result += c == '\n' ? ' ' : c;
  }
  return result;
}

std::string rangeOrChoices(const ParameterSpec& parameter) {
  if (!parameter.choices.empty()) return join(parameter.choices, ", ");
  return describe(parameter.range);
}

std::string defaultCell(const ParameterSpec& parameter) {
  if (std::holds_alternative<Required>(parameter.value)) return "required";
  if (std::holds_alternative<Optional>(parameter.value)) return "none";
  const std::string text = describe(parameter.value);
  return text.empty() ? "\"\"" : "`" + text + "`";
}

std::string sentence(const std::string& doc) {
  const std::string text = trim(doc);
  return text.empty() || text.back() == '.' ? text : text + ".";
}

/// The parameters of one level; "" if there are none.
std::string table(const ListSpec& list, Level level) {
  std::string rows;
  for (const ParameterSpec& parameter : list.parameters()) {
    if (parameter.level != level) continue;
    rows += "| `" + parameter.name + "` | " + typeName(parameter.kind) + " | " +
            cell(parameter.unit) + " | " + cell(rangeOrChoices(parameter)) + " | " +
            defaultCell(parameter) + " | " + cell(sentence(parameter.doc)) + " |\n";
  }
  if (rows.empty()) return "";
  return "| Name | Type | Unit | Range | Default | Meaning |\n|---|---|---|---|---|---|\n" + rows +
         "\n";
}

std::string markdown(const Located& item, int headingLevel) {
  const ListSpec& list = *item.list;
  const auto depth = static_cast<int>(std::count(item.path.begin(), item.path.end(), '/'));
  std::string text = std::string(static_cast<std::size_t>(std::min(6, headingLevel + depth)), '#') +
                     " " + cell(item.path) + "\n\n";
  text += sentence(list.doc());
  if (list.required()) text += " Required.";
  if (list.passesThrough()) text += " Handed on to Trilinos as it is.";
  if (list.pattern() != nullptr)
    text += " Holds lists with names of your own, each described under " +
            cell(patternName(*list.pattern())) + ".";
  text += "\n\n";
  if (list.parameters().empty()) return text;
  text += table(list, Level::Basic);
  const std::string expert = table(list, Level::Expert);
  if (!expert.empty()) text += "For experts:\n\n" + expert;
  return text;
}

std::string kindName(Kind kind) {
  static const std::map<Kind, std::string> names = {{Kind::Real, "real"},
                                                    {Kind::Integer, "integer"},
                                                    {Kind::Boolean, "boolean"},
                                                    {Kind::Text, "text"},
                                                    {Kind::Choice, "choice"},
                                                    {Kind::RealArray, "real array"},
                                                    {Kind::IntegerArray, "integer array"},
                                                    {Kind::TextArray, "text array"}};
  return names.at(kind);
}

Json bound(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json jsonOf(const Default& value) {
  struct Writer {
    Json operator()(Required) const { return nullptr; }
    Json operator()(Optional) const { return nullptr; }
    Json operator()(bool flag) const { return flag; }
    Json operator()(int number) const { return number; }
    Json operator()(double number) const { return number; }
    Json operator()(const std::string& text) const { return text; }
    Json operator()(const std::vector<int>& values) const { return values; }
    Json operator()(const std::vector<double>& values) const { return values; }
    Json operator()(const std::vector<std::string>& values) const { return values; }
  };
  return std::visit(Writer{}, value);
}

Json jsonOf(const ParameterSpec& parameter) {
  return {{"name", parameter.name},
          {"type", typeName(parameter.kind)},
          {"kind", kindName(parameter.kind)},
          {"level", parameter.level == Level::Basic ? "basic" : "expert"},
          {"unit", parameter.unit},
          {"min", bound(parameter.range.min)},
          {"max", bound(parameter.range.max)},
          {"open_min", parameter.range.openMin},
          {"open_max", parameter.range.openMax},
          {"choices", parameter.choices},
          {"required", std::holds_alternative<Required>(parameter.value)},
          {"default", jsonOf(parameter.value)},
          {"doc", parameter.doc}};
}

Json jsonOf(const ListSpec& list) {
  Json parameters = Json::array();
  for (const ParameterSpec& parameter : list.parameters()) parameters.push_back(jsonOf(parameter));
  Json lists = Json::array();
  for (const ListSpec& sublist : list.lists()) lists.push_back(jsonOf(sublist));
  return {{"name", list.name()},
          {"doc", list.doc()},
          {"required", list.required()},
          {"pass_through", list.passesThrough()},
          {"parameters", parameters},
          {"lists", lists},
          {"named_lists", list.pattern() == nullptr ? Json(nullptr) : jsonOf(*list.pattern())}};
}

std::vector<Located> collect(const std::vector<ListSpec>& roots) {
  std::vector<Located> all;
  for (const ListSpec& root : roots) collect(root, root.name(), all);
  return all;
}

std::vector<Located> selectOrRefuse(const std::vector<Located>& all, const std::string& topic) {
  std::vector<Located> found = select(all, topic);
  if (found.empty()) refuse(all, topic);
  return found;
}

std::string printMarkdown(const std::vector<Located>& all, const std::string& topic,
                          int headingLevel) {
  std::string text;
  for (const Located& item : selectOrRefuse(all, topic)) text += markdown(item, headingLevel);
  while (text.size() > 1 && text[text.size() - 2] == '\n') text.pop_back();
  return text;
}

/// For a topic only its top lists; the lists below are inside them.
std::string printJson(const std::vector<Located>& all, const std::string& topic) {
  Json result = Json::array();
  std::string last;
  for (const Located& item : selectOrRefuse(all, topic)) {
    if (!last.empty() && startsWith(item.path, last + "/")) continue;
    last = item.path;
    Json entry = {{"path", item.path}};
    entry.update(jsonOf(*item.list));
    result.push_back(entry);
  }
  return result.dump(2) + "\n";
}

}  // namespace

std::string manualMarkdown(const ListSpec& root, const std::string& topic, int headingLevel) {
  return printMarkdown(collect(root), topic, headingLevel);
}

std::string manualMarkdown(const std::vector<ListSpec>& roots, const std::string& topic,
                           int headingLevel) {
  return printMarkdown(collect(roots), topic, headingLevel);
}

std::string manualJson(const ListSpec& root, const std::string& topic) {
  return printJson(collect(root), topic);
}

std::string manualJson(const std::vector<ListSpec>& roots, const std::string& topic) {
  return printJson(collect(roots), topic);
}

std::string unitsMarkdown(int headingLevel) {
  std::string text = std::string(static_cast<std::size_t>(headingLevel), '#') + " " + unitsTopic +
                     "\n\n" + unitsIntroduction +
                     "\n\n| Quantity | Unit | Also written | Value in SI |\n|---|---|---|---|\n";
  for (const UnitSymbol& symbol : unitSymbols()) {
    std::vector<std::string> also;
    for (const std::string& synonym : symbol.synonyms) also.push_back("`" + synonym + "`");
    text += "| " + symbol.quantity + " | `" + symbol.symbol + "` | " + join(also, ", ") + " | " +
            formatNumber(symbol.unit.factor) + " " + symbol.si + " |\n";
  }
  text +=
      "\n" + std::string(static_cast<std::size_t>(headingLevel + 1), '#') +
      " Printed results\n\nCommands that read a deck print results in the units of the second "
      "column, with `--units field` in those of the third; others (s, Hz, rpm, deg, rad, J) are "
      "the same in both. Files hold SI units.\n\n| Quantity | Printed in | With `--units field` "
      "| Value in SI |\n|---|---|---|---|\n";
  for (const FieldUnit& unit : fieldUnits())
    text += "| " + unit.quantity + " | " + unit.usual + " | " + unit.field + " | " +
            formatNumber(unit.factor()) + " " + unit.si + " |\n";
  return text;
}

std::string unitsJson() {
  Json quantities = Json::array();
  for (const UnitSymbol& symbol : unitSymbols()) {
    if (quantities.empty() || quantities.back()["quantity"] != symbol.quantity)
      quantities.push_back(
          {{"quantity", symbol.quantity}, {"si", symbol.si}, {"units", Json::array()}});
    quantities.back()["units"].push_back(
        {{"unit", symbol.symbol}, {"also", symbol.synonyms}, {"factor", symbol.unit.factor}});
  }
  return quantities.dump(2) + "\n";
}

bool isUnitsTopic(const std::string& topic) { return lower(trim(topic)) == lower(unitsTopic); }

}  // namespace tooljoint::deck
