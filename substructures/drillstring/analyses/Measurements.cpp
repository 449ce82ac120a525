// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/analyses/Measurements.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "common/Error.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "deck/reading/Units.hpp"
#include "deck/tables/ColumnHeading.hpp"
#include "deck/tables/DelimitedText.hpp"

namespace tooljoint::drillstring {
namespace {

constexpr std::uint64_t largestFile = 1U << 26U;  // bytes

struct MeasuredColumn {
  const char* name;
  const char* si;  ///< "": a text
  std::vector<std::string> headings;
};
enum Kind : std::size_t { Depth, Operation, HookLoad, Torque, kinds };
const std::array<MeasuredColumn, kinds> measuredColumns = {
    {{"bit depth", "m", {"bit depth", "depth", "md"}},
     {"operation", "", {"operation"}},
     {"hook load", "N", {"hook load", "hookload"}},
     {"surface torque", "N m", {"surface torque", "torque"}}}};

class Reader {
 public:
  Reader(std::string file, const std::vector<std::string>& operations)
      : file_(std::move(file)), operations_(operations) {}

  std::vector<Measurement> read() {
    const auto text =
        deck::splitDelimited(deck::fromHeader(readInput(file_, largestFile), kinds, namedColumns));
    if (text.rows.empty()) throw DeckError(file_ + ": the table of measurements is empty.");
    marks_ = deck::DecimalMarks(text.separator);
    header(text.rows.front());
    for (std::size_t i = 1; i < text.rows.size() && faults_.empty(); ++i) row(text.rows[i]);
    if (faults_.empty() && found_.empty()) fault(text.rows.front().line, "no measurement follows.");
    if (!faults_.empty()) throw DeckError(join(faults_, "\n"));
    return std::move(found_);
  }

 private:
  void fault(int line, const std::string& sentence) {
    faults_.push_back(file_ + ":" + std::to_string(line) + ": " + sentence);
  }

  /// The measured column with this heading; the end of measuredColumns if there is none.
  static auto kindOf(const deck::ColumnHeading& heading) {
    std::string name = lower(heading.name);
    std::replace(name.begin(), name.end(), '_', ' ');
    return std::find_if(
        measuredColumns.begin(), measuredColumns.end(), [&](const MeasuredColumn& column) {
          return std::count(column.headings.begin(), column.headings.end(), name) > 0;
        });
  }

  static std::size_t namedColumns(const std::vector<std::string>& cells) {
    return static_cast<std::size_t>(
        std::count_if(cells.begin(), cells.end(), [](const std::string& cell) {
          return kindOf(deck::splitHeading(cell)) != measuredColumns.end();
        }));
  }

  void header(const deck::DelimitedRow& row) {
    position_.fill(-1);
    for (std::size_t i = 0; i < row.cells.size(); ++i) {
      const auto heading = deck::splitHeading(row.cells[i]);
      const auto kind = kindOf(heading);
      if (kind == measuredColumns.end()) continue;
      const auto k = static_cast<std::size_t>(kind - measuredColumns.begin());
      if (position_[k] >= 0)
        fault(row.line, "the column " + std::string(kind->name) + " occurs twice in the header.");
      position_[k] = static_cast<int>(i);
      if (*kind->si == '\0') continue;
      const std::string& unit = heading.unit;
      const auto factor = deck::unitFactor(unit, kind->si);
      if (!factor)
        fault(row.line, "the column " + std::string(kind->name) + " has " +
                            (unit.empty() ? "no unit" : "the unit " + inQuotes(unit)) +
                            ". Write one in brackets: " + quotedList(deck::unitsLike(kind->si)) +
                            ".");
      factor_[k] = factor.value_or(1.0);
    }
    for (const Kind k : {Depth, Operation})
      if (position_[k] < 0)
        fault(row.line, "the header has no column " + inQuotes(measuredColumns[k].name) + ".");
    if (position_[HookLoad] < 0 && position_[Torque] < 0)
      fault(row.line,
            "the header has neither \"hook load\" nor \"surface torque\": nothing was measured.");
  }

  void row(const deck::DelimitedRow& row) {
    Measurement one;
    const auto depth = number(row, Depth);
    if (!depth || !(*depth > 0.0))
      return fault(row.line, "the bit depth must be a positive number.");
    one.bit = *depth;
    const std::string name = cell(row, Operation);
    const auto known =
        std::find_if(operations_.begin(), operations_.end(),
                     [&](const std::string& operation) { return lower(operation) == lower(name); });
    if (known == operations_.end()) {
      const std::string meant = closest(name, operations_);
      return fault(row.line, "the operation " + inQuotes(name) + " is unknown. " +
                                 (meant.empty() ? "" : "Did you mean " + inQuotes(meant) + "? ") +
                                 "Known are " + quotedList(operations_) + ".");
    }
    one.operation = *known;
    one.hookLoad = number(row, HookLoad);
    one.surfaceTorque = number(row, Torque);
    if (one.hookLoad || one.surfaceTorque) found_.push_back(one);
  }

  std::string cell(const deck::DelimitedRow& row, Kind k) const {
    const int i = position_[k];
    return i < 0 || i >= static_cast<int>(row.cells.size())
               ? ""
               : row.cells[static_cast<std::size_t>(i)];
  }

  /// The number of a cell; none for an empty cell or the null value of loggers.
  std::optional<double> number(const deck::DelimitedRow& row, Kind k) {
    const std::string text = cell(row, k);
    if (deck::isAbsent(text)) return std::nullopt;
    const auto read = deck::cellNumber(text);
    if (!read) {
      fault(row.line,
            "the " + std::string(measuredColumns[k].name) + " " + inQuotes(text) +
                " is not a finite number. Leave the cell empty where nothing was measured.");
      return std::nullopt;
    }
    if (const std::string wrong = marks_.fault(*read, row.line); !wrong.empty())
      fault(row.line, "the " + std::string(measuredColumns[k].name) + " " + inQuotes(text) + wrong);
    if (deck::isUsualNull(read->value)) return std::nullopt;
    return read->value * factor_[k];
  }

  std::string file_;
  const std::vector<std::string>& operations_;
  std::array<int, kinds> position_{};
  std::array<double, kinds> factor_{};
  deck::DecimalMarks marks_;
  std::vector<Measurement> found_;
  std::vector<std::string> faults_;
};

}  // namespace

std::vector<Measurement> readMeasurements(const std::string& file,
                                          const std::vector<std::string>& operations) {
  try {
    return Reader(file, operations).read();
  } catch (const FileError& error) {
    throw DeckError(std::string("The table of measurements ") + error.what());
  }
}

}  // namespace tooljoint::drillstring
