// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// The units in which commands print results: the usual ones (SI with kN, kN m, rpm, deg), or those
/// of the field. Values stay SI inside the program and in all files; they are converted where a
/// line of text is made.
#pragma once

#include <string>
#include <vector>

namespace tooljoint::deck {

enum class PrintedSystem { Usual, Field };

/// The system of all lines printed from now on. Of the program, not of a thread; "Usual" until set.
void printIn(PrintedSystem system);
PrintedSystem printedSystem();

/// Values of the option --units: "si", "field".
const std::vector<std::string>& printedSystemNames();
/// The system of that name; UsageError with a suggestion for another one.
PrintedSystem printedSystemOf(const std::string& name);

/// A unit of usual lines and the one that replaces it in units of the field. Units that are not in
/// the table are the same in both: s, Hz, rpm, deg, rad, %.
struct FieldUnit {
  std::string quantity;
  std::string si;
  std::string usual;
  std::string field;

  /// SI value of one of the field's unit.
  double factor() const;
};
const std::vector<FieldUnit>& fieldUnits();

/// The unit a quantity is printed in.
class PrintedUnit {
 public:
  /// \param usual unit outside of units of the field: "kN", "deg/30 m"
  explicit PrintedUnit(const std::string& usual);

  /// An SI value in this unit.
  double operator()(double si) const { return si / factor_; }
  const std::string& name() const { return name_; }
  /// SI value of one of this unit.
  double factor() const { return factor_; }

 private:
  std::string name_;
  double factor_;
};

/// "12.3 klbf": an SI value with that many significant digits, and its unit; "10012 m" with all
/// digits before the point, however few are wanted.
std::string printed(double si, const std::string& usual, int digits);
/// A value of the deck: the shortest text that reads back in the usual unit, six digits in one of
/// the field.
std::string printed(double si, const std::string& usual);

}  // namespace tooljoint::deck
