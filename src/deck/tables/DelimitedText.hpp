// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables as spreadsheets and survey programs write them: cells separated by commas, semicolons or
/// tabs.
#pragma once

#include <optional>
#include <string>
#include <vector>

namespace tooljoint::deck {

/// Line of the text (1-based) and its cells without blanks around them.
struct DelimitedRow {
  int line = 0;
  std::vector<std::string> cells;
};

struct DelimitedText {
  char separator = ',';
  std::vector<DelimitedRow> rows;
  int comments = 0;   ///< lines that begin with #, not read
  int emptyRows = 0;  ///< rows of separators alone, not read
};

/// Splits a text into rows of cells. The first line that is no comment and not empty decides the
/// separator: a semicolon where it has one, else a tab, else a comma. A cell in double quotes may
/// hold the separator; "" in it is one quote. A byte-order mark of UTF-8 is skipped; a degree sign
/// of Latin-1 becomes one of UTF-8. Throws DeckError for UTF-16, whose bytes hold zeros.
DelimitedText splitDelimited(const std::string& text);

/// A number as a cell writes it; `comma` says whether it has a decimal comma.
struct CellNumber {
  double value = 0.0;
  bool comma = false;
  bool point = false;
};

/// The number that fills the whole cell and is finite, with a decimal point or a decimal comma (not
/// both, no groups of thousands).
std::optional<CellNumber> cellNumber(const std::string& cell);

/// Whether a number is what loggers write where nothing was measured: -999.25, -9999 and the like.
bool isUsualNull(double number);

/// The decimal marks of one file: commas or points, and no commas where they separate cells.
class DecimalMarks {
 public:
  explicit DecimalMarks(char separator = ' ') : separator_(separator) {}

  /// What is wrong with the mark of a number of this line, to be put behind its name; empty where
  /// nothing is.
  std::string fault(const CellNumber& number, int line);

  bool commas() const { return commaLine_ > 0; }

 private:
  char separator_;
  int commaLine_ = 0, pointLine_ = 0;  ///< first line with a decimal comma, and with a point
};

}  // namespace tooljoint::deck
