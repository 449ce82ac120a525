// SPDX-License-Identifier: BSD-3-Clause
#include <algorithm>
#include <array>
#include <cmath>

#include "common/Constants.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "deck/reading/Units.hpp"
#include "deck/tables/DelimitedText.hpp"
#include "substructures/well/ArcChain.hpp"

namespace tooljoint::well {
namespace {

using constants::pi;
constexpr std::uint64_t largestSurvey = 1U << 26U;  // bytes
constexpr std::size_t mostFaults = 100;
const std::string degreeSign = "\u00b0";

/// Kind of quantity in a column.
struct ColumnKind {
  const char* name;
  const char* si;
  std::vector<std::string> headings;
};
const std::array<ColumnKind, 3> kinds = {
    {{"measured depth", "m", {"md", "measured depth", "meas depth", "depth"}},
     {"inclination", "rad", {"inc", "incl", "inclination"}},
     {"azimuth", "rad", {"azi", "az", "azim", "azimuth"}}}};
/// Words of a heading that do not name another column: the hole, and the north of an azimuth, which
/// rotates the well as a whole.
const std::array<const char*, 2> ofTheHole = {"hole", "wellbore"};
const std::array<const char*, 7> norths = {"true", "grid", "magnetic", "mag", "tn", "gn", "mn"};

/// Factor to SI of a unit for a column of this kind.
std::optional<double> unitFactor(const ColumnKind& kind, const std::string& unit) {
  std::string plain = unit.rfind(degreeSign, 0) == 0 ? degreeSign : unit;  // "(deg TN)" too
  while (!plain.empty() && plain.back() == '.') plain.pop_back();
  for (const std::string& spelling : {plain, lower(plain)}) {
    const auto found = deck::parseUnit(spelling);
    if (found && !spelling.empty() && found->dimension == deck::parseUnit(kind.si)->dimension)
      return found->factor;
  }
  return std::nullopt;
}

/// Words of a heading, "Meas. Depth" -> {"meas", "depth"}.
std::vector<std::string> wordsOf(const std::string& heading) {
  std::string text = lower(heading);
  text.erase(std::remove(text.begin(), text.end(), '.'), text.end());
  std::replace(text.begin(), text.end(), '_', ' ');
  std::vector<std::string> words = tooljoint::split(trim(text), ' ');
  words.erase(std::remove(words.begin(), words.end(), ""), words.end());
  return words;
}

template <std::size_t N>
bool isOneOf(const std::string& word, const std::array<const char*, N>& words) {
  return std::find(words.begin(), words.end(), word) != words.end();
}

/// "[deg]" and "(deg)" -> "deg"
std::string withoutBrackets(const std::string& text) {
  const auto open = text.find_first_of("[(");
  if (open == std::string::npos) return trim(text);
  return trim(text.substr(open + 1, text.find_first_of("])", open) - open - 1));
}

bool endsInDegreeSign(const std::string& text) {
  return text.size() > degreeSign.size() &&
         text.compare(text.size() - degreeSign.size(), degreeSign.size(), degreeSign) == 0;
}

/// Reads a survey row by row; faults are collected and thrown together.
class SurveyReader {
 public:
  SurveyReader(std::string file, const std::string& depthUnit, const std::string& angleUnit)
      : file_(std::move(file)) {
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::string& unit = k == 0 ? depthUnit : angleUnit;
      const auto factor = unitFactor(kinds[k], unit);
      if (!factor)
        throw DeckError("The survey unit " + inQuotes(unit) + " of the " + kinds[k].name +
                        " is unknown. " + expected(kinds[k]) + ".");
      factor_[k] = *factor;
    }
  }

  SurveyTable read() {
    const deck::DelimitedText text = split();
    marks_ = deck::DecimalMarks(text.separator);
    noteNumbers(text.rows);
    for (const deck::DelimitedRow& row : text.rows) take(row);
    finish();
    remark(text);
    return std::move(table_);
  }

  /// From depth, inclination and azimuth of one station after the other.
  std::vector<Station> take(const std::vector<double>& numbers) {
    for (std::size_t i = 0; i + kinds.size() <= numbers.size(); i += kinds.size()) {
      ++line_;
      add({numbers[i] * factor_[0], numbers[i + 1] * factor_[1], numbers[i + 2] * factor_[2]});
    }
    finish();
    return std::move(table_.stations);
  }

 private:
  deck::DelimitedText split() {
    try {
      return deck::splitDelimited(withoutPreamble(withTabs(readInput(file_, largestSurvey))));
    } catch (const FileError& error) {
      throw DeckError(std::string("The survey file ") + error.what());
    } catch (const DeckError& error) {
      throw DeckError("The survey file " + file_ + " " + error.what());
    }
  }

  /// Replaces the blanks of a table that is separated by blanks only by tabs.
  std::string withTabs(const std::string& text) {
    if (text.find_first_of(",;\t") != std::string::npos) return text;
    std::vector<std::string> lines = tooljoint::split(text, '\n');
    std::size_t stations = 0;
    for (std::string& line : lines) {
      if (trim(line).empty() || trim(line)[0] == '#') continue;
      const auto cells = blankCells(trim(line));
      if (cells.size() >= kinds.size() && deck::cellNumber(cells[0])) ++stations;
      line = join(cells, "\t");
    }
    blanks_ = stations > 1;
    return blanks_ ? join(lines, "\n") : text;
  }

  /// Splits at two or more blanks if that gives all columns, otherwise at each blank; a unit in
  /// brackets stays with its name.
  static std::vector<std::string> blankCells(const std::string& line) {
    std::vector<std::string> wide(1), narrow;
    std::size_t blanks = 0;
    for (const std::string& word : tooljoint::split(line, ' ')) {
      if (word.empty()) {
        ++blanks;
        continue;
      }
      const bool unit = word[0] == '[' || word[0] == '(';
      if (blanks > 0 && !wide.back().empty() && !unit)
        wide.push_back(word);
      else
        wide.back() += (wide.back().empty() ? "" : " ") + word;
      if (unit && !narrow.empty())
        narrow.back() += " " + word;
      else
        narrow.push_back(word);
      blanks = 0;
    }
    return wide.size() >= kinds.size() ? wide : narrow;
  }

  /// Turns lines of text above a header with all columns (well, company, datum) into comments.
  std::string withoutPreamble(const std::string& text) {
    std::vector<std::string> lines = tooljoint::split(text, '\n');
    std::vector<std::size_t> above;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const auto line = deck::splitDelimited(lines[i]);
      if (line.rows.empty()) continue;
      const auto& cells = line.rows[0].cells;
      if (namesAllColumns(cells)) {
        for (const std::size_t j : above) lines[j].insert(0, 1, '#');
        preamble_ = above.size();
        return above.empty() ? text : join(lines, "\n");
      }
      const auto numbers = std::count_if(cells.begin(), cells.end(), [](const std::string& cell) {
        return deck::cellNumber(cell).has_value();
      });
      if (static_cast<std::size_t>(numbers) >= kinds.size()) break;  // a station
      above.push_back(i);
    }
    return text;
  }

  static bool namesAllColumns(const std::vector<std::string>& cells) {
    std::array<bool, 3> seen = {false, false, false};
    for (const std::string& cell : cells)
      if (const int which = columnOf(heading(cell)); which >= 0)
        seen[static_cast<std::size_t>(which)] = true;
    return seen[0] && seen[1] && seen[2];
  }

  static bool namesNorth(const std::string& heading) {
    const auto words = wordsOf(heading);
    return std::any_of(words.begin(), words.end(),
                       [](const auto& word) { return isOneOf(word, norths); });
  }

  /// A cell of the header without its unit.
  static std::string heading(const std::string& cell) {
    if (endsInDegreeSign(cell)) return cell.substr(0, cell.size() - degreeSign.size());
    return cell.substr(0, cell.find_first_of("[("));
  }

  static std::string expected(const ColumnKind& kind) {
    return "Available: " + quotedList(deck::unitsLike(kind.si));
  }

  void finish() {
    if (line_ == 0) faults_.push_back(file_ + " is empty; a survey needs at least two stations.");
    if (table_.stations.size() < 2 && faults_.empty())
      fault("a survey needs at least two stations.");
    raise();
  }

  void fault(const std::string& sentence) {
    faults_.push_back(file_ + ":" + std::to_string(line_) + ": " + sentence);
  }

  void raise() const {
    if (!faults_.empty()) throw DeckError(firstLines(faults_, mostFaults, file_));
  }

  void take(const deck::DelimitedRow& row) {
    line_ = row.line;
    std::vector<std::string> cells = row.cells;
    const bool first = !started_;
    started_ = true;
    if (first && !cells[0].empty() && !deck::cellNumber(cells[0]) &&
        std::isdigit(static_cast<unsigned char>(cells[0][0])) == 0 &&
        std::string("+-.").find(cells[0][0]) == std::string::npos) {
      header(cells);
      return;
    }
    while (cells.size() > columns_ && cells.back().empty())
      cells.pop_back();  // empty cells from separators at the end of a row
    if (cells.size() > columns_ || cells.size() < fewestCells()) return wrongCount(cells.size());
    if (cells.size() < columns_) ++shortRows_;
    cells.resize(columns_);
    if (afterHeader_ && unitRow(cells)) return;
    afterHeader_ = false;
    station(cells);
  }

  /// Notes the last column that holds a number in any row.
  void noteNumbers(const std::vector<deck::DelimitedRow>& rows) {
    for (const deck::DelimitedRow& row : rows)
      for (std::size_t i = columnsWithNumbers_; i < row.cells.size(); ++i)
        if (deck::cellNumber(row.cells[i])) columnsWithNumbers_ = i + 1;
  }

  /// A row may end before columns of text that are not read. It may not end before columns with
  /// numbers, because a number inside the row may be the missing one.
  std::size_t fewestCells() const {
    const std::size_t read = *std::max_element(position_.begin(), position_.end()) + 1;
    return std::min(columns_, std::max(read, columnsWithNumbers_));
  }

  void wrongCount(std::size_t found) {
    const std::string names =
        names_.empty() ? "measured depth, inclination, azimuth" : join(names_, ", ");
    fault("found " + std::to_string(found) + " columns where " + std::to_string(columns_) +
          " are expected (" + names +
          "; separated by commas, semicolons or tabs). Write an empty cell for each missing one.");
  }

  void header(std::vector<std::string> cells) {
    while (!cells.empty() && cells.back().empty()) cells.pop_back();
    columns_ = cells.size();
    names_ = cells;
    afterHeader_ = true;
    std::array<bool, 3> seen = {false, false, false};
    for (std::size_t i = 0; i < cells.size(); ++i) {
      const bool bare = endsInDegreeSign(cells[i]);
      const auto end = bare ? cells[i].size() - degreeSign.size() : cells[i].find_first_of("[(");
      const int which = columnOf(heading(cells[i]));
      if (which < 0) {  // not used: comments, true vertical depth
        ignored_.push_back(cells[i]);
        continue;
      }
      const auto k = static_cast<std::size_t>(which);
      const bool toNorth = namesNorth(heading(cells[i]));
      if (seen[k] && toNorth) {  // a second azimuth, with another north
        ignored_.push_back(cells[i]);
        continue;
      }
      if (toNorth) azimuth_ = cells[i];
      if (seen[k])
        fault(std::string("the column ") + kinds[k].name + " occurs twice in the header.");
      seen[k] = true;
      position_[k] = i;
      if (end != std::string::npos)
        unit(k, bare ? degreeSign : withoutBrackets(cells[i].substr(end)));
    }
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (!seen[k])
        fault(std::string("the header has no column for the ") + kinds[k].name +
              " (known names: MD, Measured Depth; Inc, Inclination; Azi, Azimuth).");
    raise();
  }

  static int columnOf(const std::string& heading) {
    std::vector<std::string> words = wordsOf(heading);
    words.erase(std::remove_if(words.begin(), words.end(),
                               [](const auto& word) {
                                 return isOneOf(word, ofTheHole) || isOneOf(word, norths);
                               }),
                words.end());
    const std::string name = join(words, " ");
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (std::find(kinds[k].headings.begin(), kinds[k].headings.end(), name) !=
          kinds[k].headings.end())
        return static_cast<int>(k);
    return -1;
  }

  /// The row below the header, if it holds units and no number.
  bool unitRow(const std::vector<std::string>& cells) {
    bool any = false;
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const std::string& cell = cells[position_[k]];
      if (deck::cellNumber(cell)) return false;
      any = any || unitFactor(kinds[k], withoutBrackets(cell)).has_value();
    }
    if (!any) return false;
    afterHeader_ = false;
    for (std::size_t k = 0; k < kinds.size(); ++k)
      if (const std::string name = withoutBrackets(cells[position_[k]]); !name.empty())
        unit(k, name);
    return true;
  }

  void unit(std::size_t k, const std::string& name) {
    const auto factor = unitFactor(kinds[k], name);
    if (!factor)
      fault("the unit " + inQuotes(name) + " of the " + kinds[k].name + " is unknown. " +
            expected(kinds[k]) + ".");
    else if (given_[k] && *factor != factor_[k])
      fault("the unit " + inQuotes(name) + " of the " + kinds[k].name +
            " is another one than that of the header.");
    else
      factor_[k] = *factor;
    given_[k] = true;
  }

  /// The number of a cell. An angle may be followed by a degree sign if its unit is degrees.
  std::optional<double> number(std::size_t k, std::string cell) {
    if (k > 0 && endsInDegreeSign(cell) && factor_[k] != 1.0)
      cell = trim(cell.substr(0, cell.size() - degreeSign.size()));
    double factor = factor_[k];
    if (const auto found = unitBehind(k, cell)) {
      if (given_[k] && *found != factor) {
        fault("the " + std::string(kinds[k].name) + " " + inQuotes(cell) +
              " has another unit than the header.");
        return std::nullopt;
      }
      factor = *found;
      unitsInCells_ = true;
      cell = cell.substr(0, cell.size() - deck::unitText(cell).size());
    }
    const auto read = deck::cellNumber(trim(cell));
    if (!read) {
      fault("the " + std::string(kinds[k].name) + " " + inQuotes(cell) +
            " is not a finite number.");
      return std::nullopt;
    }
    if (const std::string wrong = marks_.fault(*read, line_); !wrong.empty()) {
      fault("the " + std::string(kinds[k].name) + " " + inQuotes(cell) + wrong);
      return std::nullopt;
    }
    return read->value * factor;
  }

  /// Factor of the unit after the number of a cell, "200 ft".
  static std::optional<double> unitBehind(std::size_t k, const std::string& cell) {
    if (deck::cellNumber(cell) || cell.empty() ||
        !std::isalpha(static_cast<unsigned char>(cell.back())))
      return std::nullopt;
    return unitFactor(kinds[k], deck::unitText(cell));
  }

  void station(const std::vector<std::string>& cells) {
    std::array<double, 3> value{};
    for (std::size_t k = 0; k < kinds.size(); ++k) {
      const auto read = number(k, cells[position_[k]]);
      if (!read) return;
      value[k] = *read;
    }
    add(value);
  }

  void add(const std::array<double, 3>& value) {
    auto& stations = table_.stations;
    if (stations.empty() && value[0] != 0.0)
      fault(
          "the first station must be at measured depth 0 (add the line of the surface, for example "
          "\"0, 0, 0\").");
    if (!stations.empty() && !(value[0] > stations.back().depth))
      fault(
          "the measured depth does not increase from the station before. Sort the stations by "
          "depth, and remove those that are there twice.");
    if (value[1] < 0.0 || value[1] > pi)
      fault("the inclination must lie between 0 and 180 degrees.");
    if (std::abs(value[2]) > 2.0 * pi * (1.0 + 1e-12))
      fault("the azimuth must lie between -360 and 360 degrees.");
    const Station now{value[0], value[1], value[2]};
    if (!stations.empty() && (direction(now.inclination, now.azimuth) +
                              direction(stations.back().inclination, stations.back().azimuth))
                                     .norm() < 1e-6)
      fault(
          "the hole turns back by 180 degrees from the station before, so the arc between them is "
          "not defined.");
    stations.push_back(now);
  }

  void remark(const deck::DelimitedText& text) {
    std::vector<std::string> how;
    if (text.separator != ',')
      how.push_back(std::string("cells separated by ") + (text.separator == ';' ? "semicolons"
                                                          : blanks_             ? "blanks"
                                                                                : "tabs"));
    if (marks_.commas()) how.emplace_back("decimal commas");
    if (unitsInCells_) how.emplace_back("units in the cells");
    if (!azimuth_.empty()) how.push_back("azimuth from " + inQuotes(azimuth_));
    std::vector<std::string> left;
    if (!ignored_.empty())
      left.push_back((ignored_.size() == 1 ? "column " : "columns ") + quotedList(ignored_));
    if (preamble_ > 0)
      left.push_back(std::to_string(preamble_) +
                     (preamble_ == 1 ? " line above the header" : " lines above the header"));
    if (const auto comments = text.comments - static_cast<int>(preamble_); comments > 0)
      left.push_back(std::to_string(comments) +
                     (comments == 1 ? " comment line" : " comment lines"));
    if (shortRows_ > 0)
      how.push_back(std::to_string(shortRows_) + (shortRows_ == 1
                                                      ? " row without its last columns"
                                                      : " rows without their last columns"));
    if (text.emptyRows > 0)
      left.push_back(std::to_string(text.emptyRows) +
                     (text.emptyRows == 1 ? " empty row" : " empty rows"));
    if (how.empty() && left.empty()) return;
    table_.remarks.push_back(file_ + ": " + std::to_string(table_.stations.size()) + " stations" +
                             (how.empty() ? "" : ", " + join(how, ", ")) +
                             (left.empty() ? "" : "; not read: " + join(left, ", ")));
  }

  std::string file_;
  std::array<double, 3> factor_{};
  std::array<bool, 3> given_ = {false, false, false};  ///< the file gives the unit
  std::array<std::size_t, 3> position_ = {0, 1, 2};
  std::size_t columns_ = kinds.size();
  std::size_t columnsWithNumbers_ = 0;  ///< up to the last column with a number in any row
  std::size_t shortRows_ = 0;           ///< rows that end before columns of text
  std::vector<std::string> names_;      ///< of the columns in the header
  std::size_t preamble_ = 0;            ///< lines of text above the header
  bool started_ = false, afterHeader_ = false;
  int line_ = 0;
  deck::DecimalMarks marks_;
  std::string azimuth_;  ///< heading of an azimuth that names its north
  bool unitsInCells_ = false, blanks_ = false;
  std::vector<std::string> ignored_, faults_;
  SurveyTable table_;
};

}  // namespace

SurveyTable readSurveyTable(const std::string& file, const std::string& depthUnit,
                            const std::string& angleUnit) {
  return SurveyReader(file, depthUnit, angleUnit).read();
}

std::vector<Station> surveyStations(const std::vector<double>& numbers, const std::string& path,
                                    const std::string& depthUnit, const std::string& angleUnit) {
  if (numbers.size() % kinds.size() != 0)
    throw DeckError(path + " has " + std::to_string(numbers.size()) +
                    " numbers. Give three for each station: measured depth, inclination, azimuth.");
  return SurveyReader(path, depthUnit, angleUnit).take(numbers);
}

std::vector<Station> readSurvey(const std::string& file, const std::string& depthUnit,
                                const std::string& angleUnit) {
  return readSurveyTable(file, depthUnit, angleUnit).stations;
}

}  // namespace tooljoint::well
