// SPDX-License-Identifier: BSD-3-Clause
#include "deck/tables/DelimitedText.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <set>
#include <utility>

#include "common/Error.hpp"
#include "common/Text.hpp"

namespace tooljoint::deck {
namespace {

/// Removes a byte-order mark and converts degree signs to UTF-8.
std::string normalised(const std::string& text) {
  constexpr char utf8Lead = '\xC2', degree = '\xB0';
  std::string result;
  result.reserve(text.size());
  for (std::size_t i = text.rfind("\xEF\xBB\xBF", 0) == 0 ? 3 : 0; i < text.size(); ++i) {
    if (text[i] == degree && (i == 0 || (static_cast<unsigned char>(text[i - 1]) & 0x80U) == 0))
      result += utf8Lead;
    result += text[i];
  }
  return result;
}

char separatorOf(const std::string& line) {
  bool quoted = false, tab = false;
  for (const char c : line) {
    if (c == '"') quoted = !quoted;
    if (c == ';' && !quoted) return ';';
    tab = tab || (c == '\t' && !quoted);
  }
  return tab ? '\t' : ',';
}

std::vector<std::string> cellsOf(const std::string& line, char separator) {
  std::vector<std::string> cells(1);
  bool quoted = false;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const char c = line[i];
    if (c == '"' && quoted && i + 1 < line.size() && line[i + 1] == '"') {
      cells.back() += line[++i];
    } else if (c == '"' && (quoted || trim(cells.back()).empty())) {
      quoted = !quoted;
    } else if (c == separator && !quoted) {
      cells.emplace_back();
    } else {
      cells.back() += c;
    }
  }
  for (std::string& cell : cells) cell = trim(cell);
  return cells;
}

}  // namespace

DelimitedText splitDelimited(const std::string& text) {
  if (text.find('\0') != std::string::npos)
    throw DeckError(
        "holds bytes of zero, as UTF-16 or a binary file does. Save it as text in UTF-8.");
  DelimitedText result;
  bool decided = false;
  int number = 0;
  for (const std::string& line : split(normalised(text), '\n')) {
    ++number;
    const std::string content = trim(line);
    if (content.empty()) continue;
    if (content[0] == '#') {
      ++result.comments;
      continue;
    }
    if (!decided) result.separator = separatorOf(line);
    decided = true;
    DelimitedRow row{number, cellsOf(line, result.separator)};
    const bool empty = std::all_of(row.cells.begin(), row.cells.end(),
                                   [](const std::string& cell) { return cell.empty(); });
    if (empty)
      ++result.emptyRows;
    else
      result.rows.push_back(std::move(row));
  }
  return result;
}

std::string fromHeader(const std::string& text, std::size_t all, const NamedColumns& named,
                       std::vector<std::string>* above) {
  constexpr std::size_t mostLinesAbove = 200;
  std::vector<std::string> lines = split(text, '\n');
  std::size_t header = 0, most = 0, looked = 0;
  for (std::size_t i = 0; i < lines.size() && looked < mostLinesAbove && most < all; ++i) {
    const auto rows = splitDelimited(lines[i]).rows;
    if (rows.empty()) continue;
    ++looked;
    const std::size_t count = named(rows[0].cells);
    if (count <= most) continue;
    header = i;
    most = count;
  }
  for (std::size_t i = 0; i < header; ++i) {
    const auto rows = splitDelimited(lines[i]).rows;
    if (!rows.empty() && above != nullptr) *above = rows[0].cells;
    lines[i].insert(0, 1, '#');
  }
  return header == 0 ? text : join(lines, "\n");
}

std::optional<CellNumber> cellNumber(const std::string& cell) {
  CellNumber number;
  std::string text = cell.size() > 1 && cell[0] == '+' && cell[1] != '-' ? cell.substr(1) : cell;
  const auto comma = text.find(',');
  number.comma = comma != std::string::npos;
  number.point = text.find('.') != std::string::npos;
  if (number.comma && number.point) return std::nullopt;
  if (number.comma) text[comma] = '.';
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number.value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(number.value))
    return std::nullopt;
  return number;
}

bool isUsualNull(double number) {
  constexpr double nulls[] = {-999.25, -9999.0, -9999.25, -99999.0};
  return std::find(std::begin(nulls), std::end(nulls), number) != std::end(nulls);
}

bool isAbsent(const std::string& cell) {
  static const std::set<std::string> words{"",    "nan", "null", "nil", "none",
                                           "n/a", "na",  "#n/a", "-",   "--"};
  return words.count(lower(cell)) > 0;
}

std::string DecimalMarks::fault(const CellNumber& number, int line) {
  if (number.comma && separator_ == ',')
    return " has a comma, but commas separate the cells. Write a decimal point, and no groups of "
           "thousands.";
  int& own = number.comma ? commaLine_ : pointLine_;
  if ((number.comma || number.point) && own == 0) own = line;
  if (!(number.comma && pointLine_ > 0) && !(number.point && commaLine_ > 0)) return "";
  return std::string(" has a decimal ") + (number.comma ? "comma" : "point") +
         ", but there is a decimal " + (number.comma ? "point" : "comma") + " in line " +
         std::to_string(number.comma ? pointLine_ : commaLine_) +
         ". Write one of them, and no groups of thousands.";
}

}  // namespace tooljoint::deck
