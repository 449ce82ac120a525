// SPDX-License-Identifier: BSD-3-Clause
/// \file
/// Tables in the formats of spreadsheets and survey programs: cells separated by commas, semicolons
/// or tabs.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tooljoint::deck {

/// Line number in the text (1-based) and its cells without surrounding blanks.
struct DelimitedRow {
  int line = 0;
  std::vector<std::string> cells;
};

struct DelimitedText {
  char separator = ',';
  std::vector<DelimitedRow> rows;
  int comments = 0;   ///< lines that begin with #, ignored
  int emptyRows = 0;  ///< rows of separators only, ignored
};

/// Splits a text into rows of cells. The first line that is neither comment nor empty decides the
/// separator: a semicolon if it has one, otherwise a tab, otherwise a comma. A cell in double
/// quotes may contain the separator; "" in it is one quote. A UTF-8 byte-order mark is skipped; a
/// Latin-1 degree sign is converted to UTF-8. Throws DeckError for UTF-16, whose bytes contain
/// zeros.
DelimitedText splitDelimited(const std::string& text);

/// Number of wanted columns that the cells of a line name.
using NamedColumns = std::function<std::size_t(const std::vector<std::string>&)>;

/// The text with the lines above its header (title, well, rig) turned into comments. The header is
/// the line that names most of the `all` wanted columns, the first of several, among the first 200
/// lines.
/// \param above  optional; the cells of the last line above the header
std::string fromHeader(const std::string& text, std::size_t all, const NamedColumns& named,
                       std::vector<std::string>* above = nullptr);

/// The number of a cell; `comma` is true for a decimal comma.
struct CellNumber {
  double value = 0.0;
  bool comma = false;
  bool point = false;
};

/// A finite number that fills the whole cell, with a decimal point or a decimal comma (not both, no
/// groups of thousands).
std::optional<CellNumber> cellNumber(const std::string& cell);

/// True for numbers that loggers write for missing measurements: -999.25, -9999 and the like.
bool isUsualNull(double number);

/// True for a cell without a number: empty, or a word of loggers and spreadsheets for a missing
/// measurement ("NaN", "null", "N/A", "-" and the like, in any case).
bool isAbsent(const std::string& cell);

/// Consistency of the decimal marks of one file: commas or points, and no commas if they separate
/// cells.
class DecimalMarks {
 public:
  explicit DecimalMarks(char separator = ' ') : separator_(separator) {}

  /// Fault of the decimal mark of a number in this line, to follow its name; empty if there is
  /// none.
  std::string fault(const CellNumber& number, int line);

  bool commas() const { return commaLine_ > 0; }

 private:
  char separator_;
  int commaLine_ = 0, pointLine_ = 0;  ///< first line with a decimal comma, and with a point
};

}  // namespace tooljoint::deck
