// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Units of printed results: the usual ones (SI with kN, kN m, rpm, deg) or oilfield units. Values
/// are SI inside the program and in all files; they are converted when a line of text is made.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::deck {

enum class PrintedSystem { Usual, Field };

/// Sets the system of all lines printed afterwards. Global to the program, not to a thread;
/// initially "Usual".
void printIn(PrintedSystem system);
PrintedSystem printedSystem();

/// Values of the option --units: "si", "field".
const std::vector<std::string>& printedSystemNames();
/// The system of that name; UsageError with a suggestion for another one.
PrintedSystem printedSystemOf(const std::string& name);

/// A unit of usual lines and its replacement among the field units. Units not in the table are the
/// same in both systems: s, Hz, rpm, deg, rad, %.
struct FieldUnit {
  std::string quantity;
  std::string si;
  std::string usual;
  std::string field;

  /// SI value of one field unit.
  double factor() const;
};
const std::vector<FieldUnit>& fieldUnits();

/// The unit in which a quantity is printed.
class PrintedUnit {
 public:
  /// \param usual  unit in the usual system: "kN", "deg/30 m"
  explicit PrintedUnit(const std::string& usual);

  /// An SI value in this unit.
  double operator()(double si) const { return si / factor_; }
  const std::string& name() const { return name_; }
  /// SI value of one such unit.
  double factor() const { return factor_; }

 private:
  std::string name_;
  double factor_;
};

/// "12.3 klbf": an SI value with this number of significant digits, and its unit. All digits before
/// the point are printed: "10012 m".
std::string printed(double si, const std::string& usual, int digits);
/// A value of the deck: the shortest text that reads back in the usual unit, six digits in a field
/// unit.
std::string printed(double si, const std::string& usual);

}  // namespace tooljoint::deck
