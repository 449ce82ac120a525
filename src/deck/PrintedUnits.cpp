// SPDX-License-Identifier: BSD-3-Clause
#include "deck/PrintedUnits.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <fmt/format.h>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "deck/reading/Units.hpp"

namespace tooljoint::deck {
namespace {

/// From here on a number with fewer digits is printed with an exponent; below it is whole.
constexpr double longestWhole = 1e6;

PrintedSystem& chosen() {
  static PrintedSystem system = PrintedSystem::Usual;
  return system;
}

/// SI value of a printed unit; "deg/30 m" is read as "deg/30m". 1 for a text that is not a unit
/// ("1", "").
double factorOf(const std::string& unit) {
  std::string text;
  for (const char c : unit)
    if (c != ' ' || text.empty() || std::isdigit(static_cast<unsigned char>(text.back())) == 0)
      text += c;
  const auto known = parseUnit(text, nullptr, Reading::Force);
  return known ? known->factor : 1.0;
}

}  // namespace

void printIn(PrintedSystem system) { chosen() = system; }
PrintedSystem printedSystem() { return chosen(); }

const std::vector<std::string>& printedSystemNames() {
  static const std::vector<std::string> names{"si", "field"};
  return names;
}

PrintedSystem printedSystemOf(const std::string& name) {
  const auto& names = printedSystemNames();
  const auto found = std::find(names.begin(), names.end(), name);
  if (found != names.end())
    return found == names.begin() ? PrintedSystem::Usual : PrintedSystem::Field;
  const auto meant = closest(name, names);
  throw UsageError("--units " + inQuotes(name) + " is no system of units." +
                   (meant.empty() ? "" : " Did you mean " + inQuotes(meant) + "?") +
                   " Available: " + quotedList(names) + ".");
}

const std::vector<FieldUnit>& fieldUnits() {
  static const std::vector<FieldUnit> units{
      {"length", "m", "m", "ft"},
      {"length", "m", "mm", "in"},
      {"force", "N", "N", "lbf"},
      {"force", "N", "kN", "klbf"},
      {"torque", "N m", "N m", "ft-lbf"},
      {"torque", "N m", "kN m", "kft-lbf"},
      {"pressure", "Pa", "Pa", "psi"},
      {"pressure", "Pa", "MPa", "psi"},
      {"force per length", "N/m", "N/m", "lbf/ft"},
      {"force per length", "N/m", "kN/m", "lbf/ft"},
      {"velocity", "m/s", "m/s", "ft/s"},
      {"acceleration", "m/s2", "m/s2", "ft/s2"},
      {"curvature", "rad/m", "deg/30 m", "deg/100 ft"},
      {"mass", "kg", "kg", "lbm"},
      {"density", "kg/m3", "kg/m3", "ppg"},
      {"moment of inertia", "kg m2", "kg m2", "lbm ft2"},
      {"stiffness in rotation", "N m/rad", "N m/rad", "ft-lbf/rad"},
      {"damping in rotation", "N m s/rad", "N m s/rad", "ft-lbf s/rad"},
      {"displacement per force", "m/N", "m/N", "ft/lbf"},
      {"displacement per torque", "m/(N m)", "m/(N m)", "ft/(ft-lbf)"},
      {"rotation per force", "rad/N", "rad/N", "rad/lbf"},
      {"rotation per torque", "rad/(N m)", "rad/(N m)", "rad/(ft-lbf)"},
      {"coordinate per force", "1/N", "1/N", "1/lbf"},
      {"coordinate per torque", "1/(N m)", "1/(N m)", "1/(ft-lbf)"},
  };
  return units;
}

double FieldUnit::factor() const { return factorOf(field); }

PrintedUnit::PrintedUnit(const std::string& usual) : name_(usual) {
  if (printedSystem() == PrintedSystem::Field)
    for (const auto& unit : fieldUnits())
      if (unit.usual == usual) name_ = unit.field;
  factor_ = factorOf(name_);
}

std::string printed(double si, const std::string& usual, int digits) {
  const PrintedUnit unit(usual);
  const double value = unit(si);
  // 9999.5 rounds to five digits
  const bool whole = std::abs(value) + 0.5 >= std::pow(10.0, digits);
  return (whole && std::abs(value) < longestWhole ? fmt::format("{:.0f} ", value)
                                                  : fmt::format("{:.{}g} ", value, digits)) +
         unit.name();
}

std::string printed(double si, const std::string& usual) {
  constexpr int digits = 6;
  if (printedSystem() == PrintedSystem::Field) return printed(si, usual, digits);
  return formatNumber(PrintedUnit(usual)(si)) + " " + usual;
}

}  // namespace tooljoint::deck
