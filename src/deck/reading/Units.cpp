// SPDX-License-Identifier: BSD-3-Clause
#include "deck/reading/Units.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <map>
#include <utility>

#include "common/Constants.hpp"
#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

using constants::standardGravity;
constexpr double inch = 0.0254;
constexpr double foot = 0.3048;
constexpr double pound = 0.45359237;
constexpr double poundForce = pound * standardGravity;
constexpr double gallon = 231.0 * inch * inch * inch;  // US gallon, 231 cubic inches

constexpr double barrel = 42.0 * gallon;
constexpr double waterDensity =
    1000.0;  // kg/m3, reference of the specific gravity of drilling fluids

constexpr Dimension none{0, 0, 0, 0, 0};

/// A physical quantity, its SI unit and its dimension.
struct Quantity {
  const char* name;
  const char* si;
  Dimension dimension;
};

constexpr Quantity length{"length", "m", {1, 0, 0, 0, 0}};
constexpr Quantity mass{"mass", "kg", {0, 1, 0, 0, 0}};
constexpr Quantity time{"time", "s", {0, 0, 1, 0, 0}};
constexpr Quantity angle{"angle", "rad", {0, 0, 0, 1, 0}};
constexpr Quantity force{"force", "N", {1, 1, -2, 0, 0}};
constexpr Quantity torque{"torque", "N m", {2, 1, -2, 0, 0}};
constexpr Quantity pressure{"pressure", "Pa", {-1, 1, -2, 0, 0}};
constexpr Quantity power{"power", "W", {2, 1, -3, 0, 0}};
constexpr Quantity density{"density", "kg/m3", {-3, 1, 0, 0, 0}};
constexpr Quantity volume{"volume", "m3", {3, 0, 0, 0, 0}};
constexpr Quantity flow{"volume flow", "m3/s", {3, 0, -1, 0, 0}};
constexpr Quantity viscosity{"kinematic viscosity", "m2/s", {2, 0, -1, 0, 0}};
constexpr Quantity dynamicViscosity{"dynamic viscosity", "Pa s", {-1, 1, -1, 0, 0}};
constexpr Quantity rotarySpeed{"rotary speed", "rad/s", {0, 0, -1, 1, 0}};
constexpr Quantity frequency{"frequency", "Hz", {0, 0, -1, 0, 1}};

/// Source of the table, without the compound units of the manual. Symbols are grouped by quantity.
/// Inch, foot, pound, gallon and standard gravity are exact by definition (NIST SP 811, appendix
/// B).
std::vector<UnitSymbol> makeSymbols() {
  std::vector<UnitSymbol> table;
  const auto add = [&table](const Quantity& quantity, const char* symbol, double factor,
                            std::vector<std::string> synonyms = {}) {
    table.push_back(
        {symbol, std::move(synonyms), quantity.name, quantity.si, {factor, quantity.dimension}});
  };
  add(length, "m", 1.0, {"meter", "meters", "metre", "metres"});
  add(length, "mm", 1e-3);
  add(length, "cm", 1e-2);
  add(length, "km", 1e3);
  add(length, "ft", foot, {"foot", "feet"});
  add(length, "in", inch, {"inch", "inches"});
  add(length, "kft", 1e3 * foot);
  add(length, "um", 1e-6);
  add(mass, "kg", 1.0);
  add(mass, "g", 1e-3);
  add(mass, "t", 1e3, {"tonne", "tonnes"});
  add(mass, "lbm", pound);
  add(mass, "lb", pound, {"lbs"});
  add(mass, "klb", 1e3 * pound, {"klbs"});
  add(time, "s", 1.0, {"sec", "second", "seconds"});
  add(time, "ms", 1e-3);
  add(time, "us", 1e-6);
  add(time, "min", 60.0, {"minute", "minutes"});
  add(time, "h", 3600.0, {"hr", "hour", "hours"});
  add(angle, "rad", 1.0, {"radian", "radians"});
  add(angle, "deg", constants::degree, {"\u00b0", "degree", "degrees"});
  add(angle, "rev", constants::twoPi, {"r"});
  add(force, "N", 1.0, {"newton"});
  add(force, "daN", 10.0);
  add(force, "kN", 1e3);
  add(force, "MN", 1e6);
  add(force, "lbf", poundForce);
  add(force, "klbf", 1e3 * poundForce, {"kip", "kips"});
  add(force, "tf", 1e3 * standardGravity);
  add(force, "t", 1e3 * standardGravity, {"tonne", "tonnes"});
  add(force, "lb", poundForce, {"lbs"});
  add(force, "klb", 1e3 * poundForce, {"klbs"});
  add(force, "kdaN", 1e4);
  add(torque, "Nm", 1.0);
  add(torque, "kNm", 1e3);
  add(pressure, "Pa", 1.0, {"pascal"});
  add(pressure, "kPa", 1e3);
  add(pressure, "MPa", 1e6);
  add(pressure, "GPa", 1e9);
  add(pressure, "bar", 1e5);
  add(pressure, "psi", poundForce / (inch * inch), {"PSI"});
  add(pressure, "ksi", 1e3 * poundForce / (inch * inch), {"kpsi"});
  add(power, "W", 1.0);
  add(power, "kW", 1e3);
  add(density, "ppg", pound / gallon, {"PPG"});
  add(density, "pcf", pound / (foot * foot * foot));
  add(density, "sg", waterDensity, {"SG"});
  add(rotarySpeed, "rpm", constants::rpm, {"RPM"});
  add(frequency, "Hz", 1.0);
  add(frequency, "kHz", 1e3);
  add(volume, "l", 1e-3, {"liter", "liters", "litre", "litres"});
  add(volume, "cc", 1e-6);
  add(volume, "gal", gallon);
  add(volume, "bbl", barrel);
  add(flow, "gpm", gallon / 60.0, {"GPM"});
  add(flow, "lpm", 1e-3 / 60.0);
  add(viscosity, "cSt", 1e-6);
  add(dynamicViscosity, "cP", 1e-3);
  return table;
}

Unit multiply(const Unit& a, const Unit& b, int power_) {
  Unit result = a;
  const double scale = std::pow(b.factor, std::abs(power_));
  result.factor = power_ < 0 ? result.factor / scale : result.factor * scale;
  for (std::size_t i = 0; i < result.dimension.size(); ++i)
    result.dimension[i] += power_ * b.dimension[i];
  return result;
}

/// number * factor, as a division if the factor is the reciprocal of a whole number (12.5 mm is
/// 12.5 / 1000, the nearest double).
double scaled(double number, double factor) {
  const double inverse = std::round(1.0 / factor);
  const bool whole = inverse > 1.0 && std::abs(factor * inverse - 1.0) < 1e-14;
  return whole ? number / inverse : number * factor;
}

/// Letters, and bytes of characters outside ASCII (the degree sign).
bool isLetter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) != 0 || static_cast<unsigned char>(c) >= 0x80;
}
bool isDigit(char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; }

bool isNamed(const UnitSymbol& symbol, const std::string& name) {
  const auto& also = symbol.synonyms;
  return symbol.symbol == name || std::find(also.begin(), also.end(), name) != also.end();
}

/// The table entry with this name; for a symbol of both mass and force the entry selected by
/// `reading`. Null if there is none.
const UnitSymbol* findSymbol(const std::string& name, Reading reading) {
  const UnitSymbol* found = nullptr;
  for (const UnitSymbol& symbol : unitSymbols())
    if (isNamed(symbol, name) && (found == nullptr || reading == Reading::Force)) found = &symbol;
  return found;
}

/// The symbol for a misspelt unit; "" if there is no good match.
std::string meantUnit(const std::string& name) {
  std::vector<std::string> known;
  for (const UnitSymbol& symbol : unitSymbols()) {
    known.push_back(symbol.symbol);
    known.insert(known.end(), symbol.synonyms.begin(), symbol.synonyms.end());
  }
  return closest(name, known);
}

/// Recursive descent over the grammar in the header: product of factors; "/" applies to the single
/// factor after it.
class UnitParser {
 public:
  UnitParser(std::string_view text, Reading reading) : text_(text), reading_(reading) {}

  std::optional<Unit> parse() {
    std::optional<Unit> unit = product();
    skipBlanks();
    if (unit && at_ < text_.size())
      return fail(inQuotes(std::string(text_.substr(at_))) + " is not understood in the unit " +
                  inQuotes(trim(text_)));
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

  /// "-" or "." between two symbols: "ft-lbf", "N.m"
  bool joins(std::size_t at) const {
    return at + 1 < text_.size() && (text_[at] == '-' || text_[at] == '.') &&
           isLetter(text_[at + 1]);
  }

  /// product := factor { ("*" | "-" | "." | blank) factor | "/" factor }
  std::optional<Unit> product() {
    std::optional<Unit> result = factor();
    bool divided = false;
    while (result) {
      skipBlanks();
      if (at_ >= text_.size() || text_[at_] == ')') return result;
      const bool divide = text_[at_] == '/';
      if (divide || text_[at_] == '*' || joins(at_)) ++at_;
      if (divided && !divide)
        return fail("the unit " + inQuotes(trim(text_)) +
                    " is ambiguous: write parentheses around what it divides by");
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
    if (at_ >= text_.size()) return fail("the unit " + inQuotes(trim(text_)) + " ends too early");
    if (text_[at_] == '(') return group();
    if (isDigit(text_[at_])) return number();
    return symbol();
  }

  std::optional<Unit> group() {
    if (++depth_ > 20) return fail("the unit is nested too deeply");
    ++at_;
    std::optional<Unit> inner = product();
    if (!inner) return inner;
    if (at_ >= text_.size() || text_[at_] != ')')
      return fail("a \")\" is missing in the unit " + inQuotes(trim(text_)));
    ++at_;
    --depth_;
    return power(*inner);
  }

  /// "1/s", and the "30m" of "deg/30m"
  std::optional<Unit> number() {
    int value = 0;
    const auto [end, error] =
        std::from_chars(text_.data() + at_, text_.data() + text_.size(), value);
    if (error != std::errc() || value == 0)
      return fail("the number in the unit " + inQuotes(trim(text_)) + " is not usable");
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
    if (const UnitSymbol* known = findSymbol(name, reading_)) return power(known->unit);
    if (name.empty()) return fail(inQuotes(trim(text_.substr(begin))) + " is not a unit");
    const std::string near = meantUnit(name);
    return fail(inQuotes(name) + " is not a known unit" +
                (near.empty() ? "" : " (did you mean " + inQuotes(near) + "?)"));
  }

  /// exponent := ["^"] ["-"] digit
  std::optional<Unit> power(const Unit& base) {
    std::size_t at = at_;
    if (joins(at)) return base;
    const bool caret = at < text_.size() && text_[at] == '^';
    if (caret) ++at;
    const bool minus = at < text_.size() && text_[at] == '-';
    if (minus) ++at;
    if (at >= text_.size() || !isDigit(text_[at])) {
      if (caret || minus)
        return fail("an exponent is missing in the unit " + inQuotes(trim(text_)));
      return base;
    }
    const int exponent = text_[at] - '0';
    at_ = at + 1;
    if (at_ < text_.size() && isDigit(text_[at_]))
      return fail("an exponent in the unit " + inQuotes(trim(text_)) + " is too large");
    return multiply(Unit{}, base, minus ? -exponent : exponent);
  }

  std::string_view text_;
  Reading reading_;
  std::size_t at_ = 0;
  int depth_ = 0;
  std::string fault_;
};

}  // namespace

const std::vector<UnitSymbol>& unitSymbols() {
  static const std::vector<UnitSymbol> symbols = makeSymbols();
  return symbols;
}

std::optional<Unit> parseUnit(std::string_view text, std::string* fault, Reading reading) {
  if (trim(text).empty()) return Unit{1.0, none};
  UnitParser parser(text, reading);
  const std::optional<Unit> unit = parser.parse();
  if (!unit && fault != nullptr) *fault = parser.fault();
  return unit;
}

std::string unitText(const std::string& quantity) {
  const std::string whole = trim(quantity);
  double number = 0.0;
  const char* end = whole.data() + whole.size();
  const char* begin = whole.data() + (whole[0] == '+' ? 1 : 0);
  const char* unit = std::from_chars(begin, end, number).ptr;
  return trim(std::string_view(unit, static_cast<std::size_t>(end - unit)));
}

std::vector<std::string> unitsLike(const std::string& si) {
  static const std::vector<std::string> compounds = {
      "m/s",   "ft/s",  "m/h",    "ft/h",   "m/s2",      "m2",      "mm2",   "in2",     "kg/m3",
      "g/cm3", "kg/m",  "lbm/ft", "lb/gal", "bbl/min",   "kft lbf", "N/m",   "kN/m",    "MN/m",
      "N s/m", "N m",   "kN m",   "ft lbf", "kg m",      "1/m",     "rad/m", "deg/m",   "deg/30m",
      "rad/s", "deg/s", "rad/s2", "1/s",    "m3/s",      "l/min",   "m2/s",  "N m/rad", "Pa s",
      "m4",    "mm4",   "in4",    "kg m2",  "N m s/rad", "m3"};
  std::vector<std::string> result;
  const std::optional<Unit> wanted = parseUnit(si);
  if (!wanted) return result;
  for (const UnitSymbol& symbol : unitSymbols())
    if (symbol.unit.dimension == wanted->dimension) result.push_back(symbol.symbol);
  for (const std::string& compound : compounds) {
    const std::optional<Unit> unit = parseUnit(compound);
    if (unit && unit->dimension == wanted->dimension) result.push_back(compound);
  }
  if (std::find(result.begin(), result.end(), si) == result.end())
    result.insert(result.begin(), si);
  return result;
}

std::optional<double> toSi(std::string_view text, const std::string& si, std::string& fault) {
  const std::string whole = trim(text);
  const std::optional<Unit> wanted = parseUnit(si);
  if (!wanted || si.empty()) {
    fault =
        si.empty() ? "stands where a plain number is expected" : "must be a plain number in " + si;
    return std::nullopt;
  }
  const std::string expected = "a number and a unit such as " + quotedList(unitsLike(si));
  const char* begin =
      whole.data() + (whole.size() > 1 && whole[0] == '+' && whole[1] != '-' ? 1 : 0);
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
  const std::string rest =
      trim(std::string_view(end, static_cast<std::size_t>(whole.data() + whole.size() - end)));
  if (rest.empty()) {
    fault = "has no unit; expected is " + expected;
    return std::nullopt;
  }
  if (rest[0] == ',') {
    fault = "has a decimal comma; write a decimal point";
    return std::nullopt;
  }
  std::string why;
  std::optional<Unit> unit = parseUnit(rest, &why);
  const std::optional<Unit> weight = parseUnit(rest, nullptr, Reading::Force);
  if (weight && weight->dimension == wanted->dimension) unit = weight;
  if (!unit) {
    fault = "has a unit that is not understood: " + why + "; expected is " + expected;
    return std::nullopt;
  }
  if (unit->dimension != wanted->dimension) {
    fault = "has the unit " + inQuotes(rest) + ", which is not a unit of the expected quantity (" +
            si + "); expected is " + expected;
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
