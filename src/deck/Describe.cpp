// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Describe.hpp"

#include <cctype>
#include <cmath>
#include <vector>

#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

template <class T, class Write>
std::string braces(const std::vector<T>& values, Write write) {
  std::string result;
  for (const T& value : values) result += (result.empty() ? "" : ", ") + write(value);
  return "{" + result + "}";
}

/// "The axial load." -> "the axial load"; "WOB at the bit" and "RK4 step" keep their capitals, and
/// so does "Young's modulus".
std::string clause(const std::string& doc) {
  std::string text = trim(doc);
  while (!text.empty() && text.back() == '.') text.pop_back();
  const bool word = text.size() > 1 && std::islower(static_cast<unsigned char>(text[1])) != 0;
  const bool person = text.substr(0, text.find(' ')).find('\'') != std::string::npos;
  if ((word && !person) || text.compare(0, 2, "A ") == 0)
    text[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(text[0])));
  return text;
}

/// Description of a named thing: "It is the ..." if the words begin with an article.
std::string introduce(const std::string& name, const std::string& words) {
  for (const char* article : {"the ", "a ", "an "}) {
    if (words.compare(0, std::char_traits<char>::length(article), article) == 0)
      return "It is " + words + ".";
  }
  return "\"" + name + "\": " + words + ".";
}

double exampleNumber(const Range& range, bool whole) {
  if (contains(range, 1.0)) return 1.0;
  if (std::isfinite(range.min) && !range.openMin) return range.min;
  if (std::isfinite(range.max) && !range.openMax) return range.max;
  if (std::isfinite(range.min) && std::isfinite(range.max))
    return whole ? std::floor(range.min) + 1.0 : 0.5 * (range.min + range.max);
  return std::isfinite(range.min) ? std::floor(range.min) + 1.0 : std::ceil(range.max) - 1.0;
}

}  // namespace

std::string typeName(Kind kind) {
  switch (kind) {
    case Kind::Real:
      return "double";
    case Kind::Integer:
      return "int";
    case Kind::Boolean:
      return "bool";
    case Kind::Text:
    case Kind::Choice:
      return "string";
    case Kind::RealArray:
      return "Array(double)";
    case Kind::IntegerArray:
      return "Array(int)";
    case Kind::TextArray:
      return "Array(string)";
  }
  return "string";
}

bool contains(const Range& range, double value) {
  const bool above = range.openMin ? value > range.min : value >= range.min;
  const bool below = range.openMax ? value < range.max : value <= range.max;
  return above && below;
}

std::string describe(const Range& range) {
  const bool low = std::isfinite(range.min);
  const bool high = std::isfinite(range.max);
  if (low && high) {
    return std::string("in ") + (range.openMin ? "(" : "[") + formatNumber(range.min) + ", " +
           formatNumber(range.max) + (range.openMax ? ")" : "]");
  }
  if (low) return (range.openMin ? "> " : ">= ") + formatNumber(range.min);
  if (high) return (range.openMax ? "< " : "<= ") + formatNumber(range.max);
  return "";
}

std::string describe(double value) { return formatNumber(value); }

std::string describe(const Default& value) {
  struct Writer {
    std::string operator()(Required) const { return "required"; }
    std::string operator()(Optional) const { return "none"; }
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(int number) const { return formatNumber(number); }
    std::string operator()(double number) const { return formatNumber(number); }
    std::string operator()(const std::string& text) const { return text; }
    std::string operator()(const std::vector<int>& v) const {
      return braces(v, [](int i) { return formatNumber(i); });
    }
    std::string operator()(const std::vector<double>& v) const {
      return braces(v, [](double d) { return formatNumber(d); });
    }
    std::string operator()(const std::vector<std::string>& v) const {
      return braces(v, [](const std::string& s) { return s; });
    }
  };
  return std::visit(Writer{}, value);
}

std::string describe(const ParameterSpec& parameter) {
  // Unit and range follow the first sentence.
  const std::string words = clause(parameter.doc);
  const auto end = words.find(". ");
  std::string text = words.substr(0, end);
  if (!parameter.unit.empty()) text += ", " + parameter.unit;
  const std::string range = describe(parameter.range);
  if (!range.empty()) text += ", " + range;
  if (!parameter.choices.empty()) text += ", one of " + quotedList(parameter.choices);
  return end == std::string::npos ? text : text + words.substr(end);
}

std::string introduce(const ParameterSpec& parameter) {
  return introduce(parameter.name, describe(parameter));
}

std::string introduce(const ListSpec& list) { return introduce(list.name(), clause(list.doc())); }

std::string exampleValue(const ParameterSpec& parameter) {
  if (!std::holds_alternative<Required>(parameter.value) &&
      !std::holds_alternative<Optional>(parameter.value)) {
    return describe(parameter.value);
  }
  switch (parameter.kind) {
    case Kind::Real:
      return formatNumber(exampleNumber(parameter.range, false));
    case Kind::Integer:
      return formatNumber(exampleNumber(parameter.range, true));
    case Kind::Boolean:
      return "true";
    case Kind::Text:
      return "...";
    case Kind::Choice:
      return parameter.choices.front();
    case Kind::RealArray:
      return "{" + formatNumber(exampleNumber(parameter.range, false)) + "}";
    case Kind::IntegerArray:
      return "{" + formatNumber(exampleNumber(parameter.range, true)) + "}";
    case Kind::TextArray:
      return "{" + (parameter.choices.empty() ? std::string("...") : parameter.choices.front()) +
             "}";
  }
  return "";
}

}  // namespace tooljoint::deck
