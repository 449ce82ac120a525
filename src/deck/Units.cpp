// SPDX-License-Identifier: BSD-3-Clause
#include "deck/Units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>

#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

constexpr double pi = 3.141592653589793238462643383279502884;
constexpr double inch = 0.0254;
constexpr double foot = 0.3048;
constexpr double pound = 0.45359237;
constexpr double gravity = 9.80665;
constexpr double poundForce = pound * gravity;
constexpr double gallon = 231.0 * inch * inch * inch;  // US gallon, 231 cubic inches
constexpr double rotation = 2.0 * pi;

constexpr Dimension none{0, 0, 0, 0, 0};
constexpr Dimension length{1, 0, 0, 0, 0};
constexpr Dimension mass{0, 1, 0, 0, 0};
constexpr Dimension time{0, 0, 1, 0, 0};
constexpr Dimension angle{0, 0, 0, 1, 0};
constexpr Dimension force{1, 1, -2, 0, 0};
constexpr Dimension torque{2, 1, -2, 0, 0};
constexpr Dimension pressure{-1, 1, -2, 0, 0};
constexpr Dimension power{2, 1, -3, 0, 0};
constexpr Dimension density{-3, 1, 0, 0, 0};
constexpr Dimension volume{3, 0, 0, 0, 0};
constexpr Dimension flow{3, 0, -1, 0, 0};
constexpr Dimension viscosity{2, 0, -1, 0, 0};
constexpr Dimension dynamicViscosity{-1, 1, -1, 0, 0};
constexpr Dimension rotarySpeed{0, 0, -1, 1, 0};
constexpr Dimension frequency{0, 0, -1, 0, 1};

/// What the table is made of, kept apart from the compound units that people look for in a manual.
std::vector<UnitSymbol> makeSymbols() {
  return {
      {"m", "length", {1.0, length}},
      {"mm", "length", {1e-3, length}},
      {"cm", "length", {1e-2, length}},
      {"km", "length", {1e3, length}},
      {"ft", "length", {foot, length}},
      {"in", "length", {inch, length}},
      {"kg", "mass", {1.0, mass}},
      {"g", "mass", {1e-3, mass}},
      {"t", "mass", {1e3, mass}},
      {"lbm", "mass", {pound, mass}},
      {"s", "time", {1.0, time}},
      {"ms", "time", {1e-3, time}},
      {"min", "time", {60.0, time}},
      {"h", "time", {3600.0, time}},
      {"rad", "angle", {1.0, angle}},
      {"deg", "angle", {pi / 180.0, angle}},
      {"rev", "angle", {rotation, angle}},
      {"N", "force", {1.0, force}},
      {"kN", "force", {1e3, force}},
      {"MN", "force", {1e6, force}},
      {"lbf", "force", {poundForce, force}},
      {"klbf", "force", {1e3 * poundForce, force}},
      {"Nm", "torque", {1.0, torque}},
      {"kNm", "torque", {1e3, torque}},
      {"Pa", "pressure", {1.0, pressure}},
      {"kPa", "pressure", {1e3, pressure}},
      {"MPa", "pressure", {1e6, pressure}},
      {"GPa", "pressure", {1e9, pressure}},
      {"bar", "pressure", {1e5, pressure}},
      {"psi", "pressure", {poundForce / (inch * inch), pressure}},
      {"W", "power", {1.0, power}},
      {"kW", "power", {1e3, power}},
      {"ppg", "density", {pound / gallon, density}},
      {"rpm", "rotary speed", {rotation / 60.0, rotarySpeed}},
      {"Hz", "frequency", {1.0, frequency}},
      {"kHz", "frequency", {1e3, frequency}},
      {"l", "volume", {1e-3, volume}},
      {"gal", "volume", {gallon, volume}},
      {"gpm", "volume flow", {gallon / 60.0, flow}},
      {"cSt", "kinematic viscosity", {1e-6, viscosity}},
      {"cP", "dynamic viscosity", {1e-3, dynamicViscosity}},
  };
}

Unit multiply(const Unit& a, const Unit& b, int power_) {
  Unit result = a;
  const double scale = std::pow(b.factor, std::abs(power_));
  result.factor = power_ < 0 ? result.factor / scale : result.factor * scale;
  for (std::size_t i = 0; i < result.dimension.size(); ++i) result.dimension[i] += power_ * b.dimension[i];
  return result;
}

/// number * factor, by a division where the factor is one over a whole number (12.5 mm is 12.5 / 1000, the nearest double).
double scaled(double number, double factor) {
  const double inverse = std::round(1.0 / factor);
  const bool whole = inverse > 1.0 && std::abs(factor * inverse - 1.0) < 1e-14;
  return whole ? number / inverse : number * factor;
}

bool isLetter(char c) { return std::isalpha(static_cast<unsigned char>(c)) != 0; }
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

/// The symbol for a unit a person has spelled out or written another way; "" when there is no good guess.
std::string meantUnit(const std::string& name) {
  static const std::map<std::string, std::string> spelled = {
      {"inch", "in"},  {"inches", "in"}, {"foot", "ft"},    {"feet", "ft"},     {"meter", "m"},     {"metre", "m"},
      {"meters", "m"}, {"metres", "m"},  {"degree", "deg"}, {"degrees", "deg"}, {"radian", "rad"},  {"radians", "rad"},
      {"sec", "s"},    {"second", "s"},  {"seconds", "s"},  {"minute", "min"},  {"minutes", "min"}, {"hr", "h"},
      {"hour", "h"},   {"hours", "h"},   {"lb", "lbf"},     {"lbs", "lbf"},     {"kip", "klbf"},    {"kips", "klbf"},
      {"klb", "klbf"}, {"newton", "N"},  {"pascal", "Pa"},  {"liter", "l"},     {"litre", "l"},     {"liters", "l"},
      {"litres", "l"}, {"tonne", "t"}};
  const auto it = spelled.find(lower(name));
  if (it != spelled.end()) return it->second;
  std::vector<std::string> known;
  for (const UnitSymbol& symbol : unitSymbols()) known.push_back(symbol.symbol);
  return closest(name, known);
}

/// Recursive descent over the grammar of the header: product of factors, "/" applies to the one factor after it.
class UnitParser {
 public:
  explicit UnitParser(std::string_view text) : text_(text) {}

  std::optional<Unit> parse() {
    std::optional<Unit> unit = product();
    skipBlanks();
    if (unit && at_ < text_.size())
      return fail("\"" + std::string(text_.substr(at_)) + "\" is not understood in the unit \"" + trim(text_) + "\"");
    return unit;
  }

  const std::string& fault() const { return fault_; }

 private:
  std::optional<Unit> fail(std::string why) {
    if (fault_.empty()) fault_ = std::move(why);
    return std::nullopt;
  }

  void skipBlanks() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }

  /// product := factor { ("*" | blank) factor | "/" factor }
  std::optional<Unit> product() {
    std::optional<Unit> result = factor();
    bool divided = false;
    while (result) {
      skipBlanks();
      if (at_ >= text_.size() || text_[at_] == ')') return result;
      const bool divide = text_[at_] == '/';
      if (divide || text_[at_] == '*') ++at_;
      if (divided && !divide)
        return fail("the unit \"" + trim(text_) + "\" is ambiguous: write parentheses around what it divides by");
      const std::optional<Unit> next = factor();
      if (!next) return next;
      result = multiply(*result, *next, divide ? -1 : 1);
      divided = divided || divide;
    }
    return result;
  }

  /// factor := "(" product ")" | whole number [symbol] | symbol [exponent]
  std::optional<Unit> factor() {
    skipBlanks();
    if (at_ >= text_.size()) return fail("the unit \"" + trim(text_) + "\" ends too early");
    if (text_[at_] == '(') return group();
    if (isDigit(text_[at_])) return number();
    return symbol();
  }

  std::optional<Unit> group() {
    if (++depth_ > 20) return fail("the unit is nested too deeply");
    ++at_;
    std::optional<Unit> inner = product();
    if (!inner) return inner;
    if (at_ >= text_.size() || text_[at_] != ')') return fail("a \")\" is missing in the unit \"" + trim(text_) + "\"");
    ++at_;
    --depth_;
    return power(*inner);
  }

  /// "1/s", and the "30m" of "deg/30m"
  std::optional<Unit> number() {
    int value = 0;
    const auto [end, error] = std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc() || value == 0) return fail("the number in the unit \"" + trim(text_) + "\" is not usable");
    at_ = static_cast<std::size_t>(end - text_.data());
    Unit result;
    result.factor = value;
    if (at_ >= text_.size() || !isLetter(text_[at_])) return result;
    const std::optional<Unit> next = symbol();
    if (!next) return next;
    return multiply(result, *next, 1);
  }

  std::optional<Unit> symbol() {
    const std::size_t begin = at_;
    while (at_ < text_.size() && isLetter(text_[at_])) ++at_;
    const std::string name(text_.substr(begin, at_ - begin));
    const auto& symbols = unitSymbols();
    const auto it = std::find_if(symbols.begin(), symbols.end(), [&](const UnitSymbol& s) { return s.symbol == name; });
    if (it != symbols.end()) return power(it->unit);
    if (name.empty()) return fail("\"" + trim(text_.substr(begin)) + "\" is not a unit");
    const std::string near = meantUnit(name);
    return fail("\"" + name + "\" is not a known unit" + (near.empty() ? "" : " (did you mean \"" + near + "\"?)"));
  }

  /// exponent := ["^"] ["-"] digit
  std::optional<Unit> power(const Unit& base) {
    std::size_t at = at_;
    const bool caret = at < text_.size() && text_[at] == '^';
    if (caret) ++at;
    const bool minus = at < text_.size() && text_[at] == '-';
    if (minus) ++at;
    if (at >= text_.size() || !isDigit(text_[at])) {
      if (caret || minus) return fail("an exponent is missing in the unit \"" + trim(text_) + "\"");
      return base;
    }
    const int exponent = text_[at] - '0';
    at_ = at + 1;
    if (at_ < text_.size() && isDigit(text_[at_])) return fail("an exponent in the unit \"" + trim(text_) + "\" is too large");
    return multiply(Unit{}, base, minus ? -exponent : exponent);
  }

  std::string_view text_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string fault_;
};

}  // namespace

const std::vector<UnitSymbol>& unitSymbols() {
  static const std::vector<UnitSymbol> symbols = makeSymbols();
  return symbols;
}

std::optional<Unit> parseUnit(std::string_view text, std::string* fault) {
  if (trim(text).empty()) return Unit{1.0, none};
  UnitParser parser(text);
  const std::optional<Unit> unit = parser.parse();
  if (!unit && fault != nullptr) *fault = parser.fault();
  return unit;
}

std::vector<std::string> unitsLike(const std::string& si) {
  static const std::vector<std::string> compounds = {
      "m/s",    "ft/s", "m/h",   "ft/h",  "m/s2", "m2",      "mm2",  "in2", "kg/m3", "g/cm3", "kg/m",    "lbm/ft",    "N/m",
      "kN/m",   "MN/m", "N s/m", "N m",   "kN m", "ft lbf",  "kg m", "1/m", "rad/m", "deg/m", "deg/30m", "rad/s",     "deg/s",
      "rad/s2", "1/s",  "m3/s",  "l/min", "m2/s", "N m/rad", "Pa s", "m4",  "mm4",   "in4",   "kg m2",   "N m s/rad", "m3"};
  std::vector<std::string> result;
  const std::optional<Unit> wanted = parseUnit(si);
  if (!wanted) return result;
  const auto offer = [&](const std::string& candidate) {
    const std::optional<Unit> unit = parseUnit(candidate);
    if (unit && unit->dimension == wanted->dimension) result.push_back(candidate);
  };
  for (const UnitSymbol& symbol : unitSymbols()) offer(symbol.symbol);
  for (const std::string& compound : compounds) offer(compound);
  if (std::find(result.begin(), result.end(), si) == result.end()) result.insert(result.begin(), si);
  return result;
}

std::optional<double> toSi(std::string_view text, const std::string& si, std::string& fault) {
  const std::string whole = trim(text);
  const std::optional<Unit> wanted = parseUnit(si);
  if (!wanted || si.empty()) {
    fault = si.empty() ? "stands where a plain number is expected" : "must be a plain number in " + si;
    return std::nullopt;
  }
  const std::string expected = "a number and a unit such as " + quotedList(unitsLike(si));
  const char* begin = whole.data() + (whole.size() > 1 && whole[0] == '+' && whole[1] != '-' ? 1 : 0);
  double number = 0.0;
  const auto [end, error] = std::from_chars(begin, whole.data() + whole.size(), number);
  if (error == std::errc::invalid_argument || !std::isfinite(number)) {
    fault = "does not begin with a number; expected is " + expected;
    return std::nullopt;
  }
  if (error != std::errc()) {
    fault = "is a number too large or too small for a double";
    return std::nullopt;
  }
  const std::string rest = trim(std::string_view(end, static_cast<std::size_t>(whole.data() + whole.size() - end)));
  if (rest.empty()) {
    fault = "has no unit; expected is " + expected;
    return std::nullopt;
  }
  if (rest[0] == ',') {
    fault = "has a decimal comma; write a decimal point";
    return std::nullopt;
  }
  std::string why;
  const std::optional<Unit> unit = parseUnit(rest, &why);
  if (!unit) {
    fault = "has a unit that is not understood: " + why + "; expected is " + expected;
    return std::nullopt;
  }
  if (unit->dimension != wanted->dimension) {
    fault = "has the unit \"" + rest + "\", which does not measure what is asked for here (" + si + "); expected is " + expected;
    return std::nullopt;
  }
  const double value = scaled(number, unit->factor / wanted->factor);
  if (!std::isfinite(value)) {
    fault = "is a number too large for a double";
    return std::nullopt;
  }
  return value;
}

}  // namespace tooljoint::deck
