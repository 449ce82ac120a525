// SPDX-License-Identifier: BSD-3-Clause
#include "deck/tables/LogTable.hpp"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include "common/Error.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "deck/reading/Units.hpp"
#include "deck/tables/ClockTime.hpp"
#include "deck/tables/ColumnHeading.hpp"
#include "deck/tables/DelimitedText.hpp"
#include "deck/tables/LasFile.hpp"

namespace tooljoint::deck {
namespace {

constexpr std::uint64_t largestLog = 1U << 26U;  // bytes
/// Largest number of printed faults; the others are counted.
constexpr std::size_t mostFaults = 10;
/// Headings of the time, if the deck names none.
const std::vector<std::string> timeNames{"time",     "elapsed time", "etim",     "t",
                                         "datetime", "date time",    "timestamp"};

/// Names are compared without case, "_" and surrounding blanks.
std::string plain(const std::string& name) {
  std::string text = lower(trim(name));
  std::replace(text.begin(), text.end(), '_', ' ');
  return text;
}

/// A wanted column and its position in the file.
struct Column {
  WantedColumn wanted;
  std::size_t place = 0;
  double factor = 1.0;
};

class Reader {
 public:
  explicit Reader(std::string file) : file_(std::move(file)) {}

  std::vector<LogSignal> read(const WantedColumn& time, const std::vector<WantedColumn>& wanted) {
    columns_.push_back({time});
    for (const auto& one : wanted) columns_.push_back({one});
    load();
    for (auto& column : columns_) find(column);
    raise();
    signals_.resize(wanted.size());
    for (std::size_t i = firstRow_; i < rows_.size(); ++i) take(rows_[i]);
    for (std::size_t i = 0; i < signals_.size(); ++i)
      if (faults_.empty() && signals_[i].value.size() < 2)
        fault(headerLine_, "the column " + inQuotes(wanted[i].name) + " has " +
                               std::to_string(signals_[i].value.size()) +
                               " values, at least two are needed.");
    raise();
    return std::move(signals_);
  }

 private:
  void fault(int line, const std::string& sentence) {
    faults_.push_back(file_ + ":" + std::to_string(line) + ": " + sentence);
  }
  void raise() const {
    if (!faults_.empty()) throw DeckError(firstLines(faults_, mostFaults, file_));
  }

  void load() {
    std::string text;
    try {
      text = readInput(file_, largestLog);
    } catch (const FileError& error) {
      throw DeckError(std::string("The measured log ") + error.what());
    }
    if (looksLikeLas(text)) {
      auto las = parseLas(text, file_);
      las_ = true;
      headings_ = std::move(las.curves);
      rows_ = std::move(las.rows);
      null_ = las.null;
      headerLine_ = las.curveLine;
      return;
    }
    DelimitedText table;
    try {
      table = splitDelimited(fromHeader(
          text, columns_.size(),
          [this](const std::vector<std::string>& cells) { return wantedNames(cells); }, &above_));
    } catch (const DeckError& error) {
      throw DeckError("The measured log " + file_ + " " + error.what());
    }
    if (table.rows.empty()) throw DeckError("The measured log " + file_ + " is empty.");
    rows_ = std::move(table.rows);
    marks_ = DecimalMarks(table.separator);
    header();
  }

  static bool names(const WantedColumn& wanted, const std::string& heading) {
    const std::string name = plain(heading);
    return wanted.name.empty() ? std::count(timeNames.begin(), timeNames.end(), name) > 0
                               : name == plain(wanted.name);
  }

  /// Number of wanted columns that the cells of a line name.
  std::size_t wantedNames(const std::vector<std::string>& cells) const {
    std::size_t count = 0;
    for (const Column& column : columns_)
      if (std::any_of(cells.begin(), cells.end(), [&](const std::string& cell) {
            return names(column.wanted, splitHeading(cell).name);
          }))
        ++count;
    return count;
  }

  /// Reads the first row of a CSV file, and units in the next row if that contains no number.
  void header() {
    auto cells = rows_.front().cells;
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    headerLine_ = rows_.front().line;
    for (const auto& cell : cells) headings_.push_back(splitHeading(cell));
    firstRow_ = 1;
    if (rows_.size() < 2 || rows_[1].cells.size() < headings_.size()) return;
    const auto& below = rows_[1].cells;
    if (std::any_of(below.begin(), below.end(), [](const std::string& cell) {
          return cellNumber(cell).has_value() || clockTime(cell).has_value();
        }))
      return;
    for (std::size_t i = 0; i < headings_.size(); ++i) {
      const auto bracketed = splitHeading(below[i]);
      const std::string& unit = bracketed.unit.empty() ? bracketed.name : bracketed.unit;
      if (headings_[i].unit.empty()) headings_[i].unit = unit;
    }
    firstRow_ = 2;
  }

  void find(Column& column) {
    std::vector<std::string> known;
    std::vector<std::size_t> places;
    for (std::size_t i = 0; i < headings_.size(); ++i) {
      known.push_back(headings_[i].name);
      const bool isIndex = las_ && column.wanted.name.empty();
      if (isIndex ? i == 0 : names(column.wanted, headings_[i].name)) places.push_back(i);
    }
    if (places.empty()) return missing(column.wanted, known);
    if (places.size() > 1)
      return fault(headerLine_, "the column " + inQuotes(known[places[0]]) +
                                    " occurs more than once in the header. Rename one.");
    column.place = places[0];
    if (column.wanted.name.empty()) column.wanted.name = known[places[0]];
    if (&column == &columns_[0] && hasClock(column)) return;
    unit(column, unitOf(column));
  }

  /// The unit in the header or below it, otherwise that of a line of units above the header.
  std::string unitOf(const Column& column) const {
    const std::string& given = headings_[column.place].unit;
    if (!given.empty() || above_.size() != headings_.size()) return given;
    const auto cell = splitHeading(above_[column.place]);
    const std::string& unit = cell.unit.empty() ? cell.name : cell.unit;
    return unitFactor(unit, column.wanted.si) ? unit : "";
  }

  /// True if the first nonempty time cell is a time of day, even in an unsupported form, such as a
  /// date with an ambiguous order of day and month.
  bool hasClock(const Column& time) {
    for (std::size_t i = firstRow_; i < rows_.size(); ++i) {
      if (time.place >= rows_[i].cells.size() || isAbsent(rows_[i].cells[time.place])) continue;
      const std::string& first = rows_[i].cells[time.place];
      clock_ = clockTime(first).has_value();
      const bool otherForm = !clock_ && first.find(':') != std::string::npos;
      if (otherForm)
        fault(rows_[i].line, "the time " + inQuotes(first) + " of the column " +
                                 inQuotes(time.wanted.name) +
                                 " has a form that is not read. Write times as hh:mm:ss or as "
                                 "YYYY-MM-DD hh:mm:ss.");
      return clock_ || otherForm;
    }
    return false;
  }

  void missing(const WantedColumn& wanted, const std::vector<std::string>& names) {
    if (wanted.name.empty())
      return fault(headerLine_,
                   "the header has no column \"Time\". Name the column of the time in "
                   "Measured Log/Time Column. Columns: " +
                       quotedList(names) + ".");
    const auto meant = closest(wanted.name, names);
    fault(headerLine_, "the header has no column " + inQuotes(wanted.name) + "." +
                           (meant.empty() ? "" : " Did you mean " + inQuotes(meant) + "?") +
                           " Columns: " + quotedList(names) + ".");
  }

  void unit(Column& column, const std::string& given) {
    const auto& wanted = column.wanted;
    const auto ofFile = unitFactor(given, wanted.si), ofDeck = unitFactor(wanted.unit, wanted.si);
    const std::string known = quotedList(unitsLike(wanted.si)) + ".";
    const std::string name = "the column " + inQuotes(wanted.name);
    if (given.empty() && wanted.unit.empty())
      return fault(headerLine_, name +
                                    " has no unit. Write one into the header, or give it in the "
                                    "deck: " +
                                    known);
    if (!given.empty() && !ofFile)
      return fault(headerLine_, name + " has the unit " + inQuotes(given) +
                                    ", which is not a unit of the compared quantity (" + wanted.si +
                                    "). Expected is one of " + known);
    if (!wanted.unit.empty() && !ofDeck)
      return fault(headerLine_, "the unit " + inQuotes(wanted.unit) + " that the deck gives for " +
                                    name + " is not a unit of the compared quantity (" + wanted.si +
                                    "). Expected is one of " + known);
    if (ofFile && ofDeck && *ofFile != *ofDeck)
      return fault(headerLine_, name + " has the unit " + inQuotes(given) + ", the deck gives " +
                                    inQuotes(wanted.unit) + ". Leave out the one of the deck.");
    column.factor = ofFile ? *ofFile : *ofDeck;
  }

  void take(const DelimitedRow& row) {
    if (faults_.size() > mostFaults) {
      faults_.push_back("");  // only counted
      return;
    }
    auto cells = row.cells;
    while (cells.size() > headings_.size() && cells.back().empty()) cells.pop_back();
    if (cells.size() != headings_.size())
      return fault(row.line, "found " + std::to_string(cells.size()) +
                                 " cells where the header has " + std::to_string(headings_.size()) +
                                 ". Write an empty cell where nothing was measured.");
    const auto time = clock_ ? sinceFirst(row.line, cells[columns_[0].place])
                             : number(row.line, cells, columns_[0]);
    if (!time) {
      if (isGap(cells[columns_[0].place]))
        fault(row.line, "the time is missing. Leave out rows without one.");
      return;
    }
    if (lastTime_ && !(*time > *lastTime_)) {
      if (std::exchange(sorted_, false))  // reported once
        fault(row.line, "the time " + inQuotes(cells[columns_[0].place]) +
                            " does not increase from the row before. Sort the log, and leave out "
                            "rows that are there twice.");
      return;
    }
    lastTime_ = time;
    for (std::size_t i = 0; i < signals_.size(); ++i)
      if (const auto value = number(row.line, cells, columns_[i + 1])) {
        signals_[i].time.push_back(*time);
        signals_[i].value.push_back(*value);
      }
  }

  /// A time of day counts from the first one. Without a date, a time earlier by more than half a
  /// day belongs to the next day. None for a gap, and for a fault that has been collected.
  std::optional<double> sinceFirst(int line, const std::string& cell) {
    if (isGap(cell)) return std::nullopt;
    const auto read = clockTime(cell);
    if (!read || read->dated != firstClock_.value_or(*read).dated) {
      fault(line, "the value " + inQuotes(cell) + " of the column " +
                      inQuotes(columns_[0].wanted.name) +
                      " is not a time as in the rows before. Write all of them as hh:mm:ss, or all "
                      "as YYYY-MM-DD hh:mm:ss.");
      return std::nullopt;
    }
    if (!firstClock_) firstClock_ = read;
    double time = read->seconds - firstClock_->seconds + midnights_ * dayLength;
    if (!read->dated && lastTime_ && time < *lastTime_ - 0.5 * dayLength) {
      ++midnights_;
      time += dayLength;
    }
    return time;
  }

  bool isGap(const std::string& cell) const {
    const auto read = cellNumber(cell);
    if (!read) return isAbsent(cell);
    return (null_ && read->value == *null_) || isUsualNull(read->value);
  }

  /// The value in SI; none for a gap, and for a fault that has been collected.
  std::optional<double> number(int line, const std::vector<std::string>& cells,
                               const Column& column) {
    const std::string& cell = cells[column.place];
    if (isGap(cell)) return std::nullopt;
    const auto read = cellNumber(cell);
    if (!read) {
      fault(line, "the value " + inQuotes(cell) + " of the column " + inQuotes(column.wanted.name) +
                      " is not a finite number. " +
                      (las_ ? "Write NULL where nothing was measured."
                            : "Leave the cell empty where nothing was measured."));
      return std::nullopt;
    }
    if (const std::string wrong = marks_.fault(*read, line); !wrong.empty())
      fault(line, "the value " + inQuotes(cell) + wrong);
    return read->value * column.factor;
  }

  std::string file_;
  bool las_ = false;
  int headerLine_ = 1;
  std::vector<ColumnHeading> headings_;
  std::vector<std::string> above_;  ///< cells of the line above the header
  std::vector<DelimitedRow> rows_;
  std::size_t firstRow_ = 0;
  std::optional<double> null_, lastTime_;
  bool clock_ = false;  ///< times are times of day
  std::optional<ClockTime> firstClock_;
  int midnights_ = 0;  ///< number of midnights passed
  DecimalMarks marks_;
  bool sorted_ = true;
  std::vector<Column> columns_;  ///< the time first
  std::vector<LogSignal> signals_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<LogSignal> readLog(const std::string& file, const WantedColumn& time,
                               const std::vector<WantedColumn>& wanted) {
  return Reader(file).read(time, wanted);
}

}  // namespace tooljoint::deck
