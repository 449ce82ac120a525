// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/Value.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "common/Text.hpp"
#include "deck/reading/Units.hpp"

namespace tooljoint::deck {
namespace {

/// Reason why a text is not a number although a number precedes `rest`.
std::string trailing(const std::string& text, const std::string& rest, bool inArray) {
  const std::optional<Unit> unit = parseUnit(rest);
  const bool quantity = unit && unit->dimension != Dimension{};
  if (rest[0] == ',') return "is not a number: write a decimal point, not a comma";
  if (!inArray && quantity) {
    return "is not a number. A quantity with a unit is written type=\"string\" value=" +
           inQuotes(text);
  }
  if (inArray && quantity)
    return "is not a number. Quantities with a unit are written type=\"Array(string)\"";
  return "is not a number: " + inQuotes(rest) + " is left over";
}

std::string numberText(const std::string& text) {
  const bool plus = text.size() > 1 && text[0] == '+' && text[1] != '-' && text[1] != '+';
  return plus ? text.substr(1) : text;
}

std::optional<double> parseReal(const std::string& raw, std::string& fault, bool inArray = false) {
  const std::string text = numberText(trim(raw));
  if (text.empty()) {
    fault = "is empty; a number is expected";
    return std::nullopt;
  }
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc::result_out_of_range) {
    fault = "is too large or too small for a double";
  } else if (error != std::errc()) {
    fault = "is not a number";
  } else if (!std::isfinite(value)) {
    fault = "is not a finite number";
  } else if (end != text.data() + text.size()) {
    fault = trailing(trim(raw), trim(std::string(end, text.data() + text.size())), inArray);
  } else {
    return value;
  }
  return std::nullopt;
}

std::optional<int> parseInteger(const std::string& raw, std::string& fault) {
  const std::string text = numberText(trim(raw));
  if (text.empty()) {
    fault = "is empty; a whole number is expected";
    return std::nullopt;
  }
  int value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error == std::errc() && end == text.data() + text.size()) return value;
  std::string ignored;
  if (error == std::errc::result_out_of_range) {
    fault = "is too large for an int";
  } else if (error == std::errc() && !parseReal(text, ignored)) {
    fault = "is not a whole number: \"" + std::string(end, text.data() + text.size()) +
            "\" is left over";
  } else {
    fault = "is not a whole number";
  }
  return std::nullopt;
}

std::optional<bool> parseBoolean(const std::string& text, std::string& fault) {
  if (text == "true") return true;
  if (text == "false") return false;
  const std::string small = lower(trim(text));
  const bool yes = small == "true" || small == "yes" || small == "on" || small == "1";
  const bool no = small == "false" || small == "no" || small == "off" || small == "0";
  fault = "is not a bool: write ";
  fault += yes ? "\"true\"" : (no ? "\"false\"" : "\"true\" or \"false\"");
  return std::nullopt;
}

/// "{a, b}" -> entries without surrounding blanks; "{}" has none.
std::optional<std::vector<std::string>> parseEntries(const std::string& raw, std::string& fault) {
  const std::string text = trim(raw);
  if (text.size() < 2 || text.front() != '{' || text.back() != '}') {
    fault = "is not an array: write the entries in braces, \"{" + trim(text) + "}\"";
    if (text.find_first_of("{}[]()") != std::string::npos || text.empty())
      fault = "is not an array: write \"{a, b, c}\"";
    return std::nullopt;
  }
  const std::string inner = text.substr(1, text.size() - 2);
  if (inner.find_first_of("{}") != std::string::npos) {
    fault = "is not a plain array: braces stand once around all entries";
    return std::nullopt;
  }
  std::vector<std::string> entries;
  if (trim(inner).empty()) return entries;
  for (const std::string& entry : split(inner, ',')) {
    entries.push_back(trim(entry));
    if (entries.back().empty()) {
      fault = "has an empty entry (number " + std::to_string(entries.size()) + ")";
      return std::nullopt;
    }
  }
  return entries;
}

template <class T, class Parse>
std::optional<Value> parseArray(const std::string& text, std::string& fault, Parse parse) {
  const auto entries = parseEntries(text, fault);
  if (!entries) return std::nullopt;
  std::vector<T> values;
  for (const std::string& entry : *entries) {
    std::string why;
    const std::optional<T> value = parse(entry, why);
    if (!value) {
      fault = "has the entry " + inQuotes(entry) + " (number " + std::to_string(values.size() + 1) +
              "), which " + why;
      return std::nullopt;
    }
    values.push_back(*value);
  }
  return Value(values);
}

template <class T>
std::optional<Value> wrap(std::optional<T> value) {
  if (!value) return std::nullopt;
  return Value(*value);
}

}  // namespace

const std::vector<std::string>& typeNames() {
  static const std::vector<std::string> names = {
      "double", "int", "bool", "string", "Array(double)", "Array(int)", "Array(string)"};
  return names;
}

std::string meantType(const std::string& type) {
  static const std::map<std::string, std::string> others = {
      {"float", "double"}, {"real", "double"}, {"number", "double"}, {"quantity", "string"},
      {"integer", "int"},  {"long", "int"},    {"longlong", "int"},  {"unsigned", "int"},
      {"size_t", "int"},   {"short", "int"},   {"boolean", "bool"},  {"logical", "bool"},
      {"text", "string"},  {"char", "string"}, {"str", "string"},    {"double", "double"},
      {"int", "int"},      {"bool", "bool"},   {"string", "string"}};
  std::string small;
  for (const char c : lower(type)) {
    if (c != ' ') small += c;
  }
  const auto open = small.find('(');
  if (open == std::string::npos) {
    const auto it = others.find(small);
    return it == others.end() ? closest(type, typeNames()) : it->second;
  }
  const auto it = others.find(small.substr(open + 1, small.find(')') - open - 1));
  if (it == others.end() || it->second == "bool") return closest(type, typeNames());
  return "Array(" + it->second + ")";
}

std::optional<Value> parseValue(const std::string& type, const std::string& text,
                                std::string& fault) {
  if (type == "double") return wrap(parseReal(text, fault));
  if (type == "int") return wrap(parseInteger(text, fault));
  if (type == "bool") return wrap(parseBoolean(text, fault));
  if (type == "string") return Value(text);
  if (type == "Array(double)") {
    return parseArray<double>(text, fault, [](const std::string& e, std::string& why) {
      return parseReal(e, why, true);
    });
  }
  if (type == "Array(int)") return parseArray<int>(text, fault, parseInteger);
  if (type == "Array(string)") {
    return parseArray<std::string>(text, fault, [](const std::string& e, std::string&) {
      return std::optional<std::string>(e);
    });
  }
  const std::string meant = meantType(type);
  fault = "has the unknown type " + inQuotes(type) + ". Available: " + quotedList(typeNames());
  if (!meant.empty()) fault += ". Did you mean type=" + inQuotes(meant) + "?";
  return std::nullopt;
}

std::string typeOf(const Value& value) {
  return typeNames()[std::vector<std::size_t>{2, 1, 0, 3, 5, 4, 6}[value.index()]];
}

}  // namespace tooljoint::deck
