// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/assembly/PipeTable.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/Error.hpp"
#include "common/InputFile.hpp"
#include "common/Text.hpp"
#include "deck/reading/Units.hpp"
#include "deck/tables/ColumnHeading.hpp"
#include "deck/tables/DelimitedText.hpp"

namespace tooljoint::drillstring {
namespace {

constexpr std::uint64_t largestTable = 1U << 24U;  // bytes
/// Longest beam element of a pipe body [m]; the pipe between two tool joints then has five.
constexpr double longestElement = 1.8;
constexpr int jointsOfAStand = 3;

enum Quantity : std::size_t {
  Length,
  Outer,
  Inner,
  UpsetLength,
  UpsetOuter,
  UpsetInner,
  JointOuter,
  JointInner,
  Box,
  Pin,
  Strength,
  JointStrength,
  quantities
};

struct ColumnKind {
  const char* name;
  const char* si;
};
constexpr std::array<ColumnKind, quantities> kinds{{{"Length", "m"},
                                                    {"Outer Diameter", "m"},
                                                    {"Inner Diameter", "m"},
                                                    {"Upset Length", "m"},
                                                    {"Upset Outer Diameter", "m"},
                                                    {"Upset Inner Diameter", "m"},
                                                    {"Tool Joint Outer Diameter", "m"},
                                                    {"Tool Joint Inner Diameter", "m"},
                                                    {"Box Length", "m"},
                                                    {"Pin Length", "m"},
                                                    {"Yield Strength", "Pa"},
                                                    {"Tool Joint Yield Strength", "Pa"}}};

class Reader {
 public:
  Reader(const std::string& file, const SegmentDefaults& standard, ComponentLibrary& library,
         std::vector<std::string>& faults)
      : file_(file), standard_(standard), library_(library), faults_(faults) {}

  void read() {
    const deck::DelimitedText table = split();
    if (table.rows.empty()) return fault(1, "the table of drill pipe is empty.");
    marks_ = deck::DecimalMarks(table.separator);
    if (!header(table.rows.front())) return;
    for (std::size_t i = 1; i < table.rows.size(); ++i) take(table.rows[i]);
  }

 private:
  void fault(int line, const std::string& sentence) {
    faults_.push_back(file_ + ":" + std::to_string(line) + ": " + sentence);
  }

  deck::DelimitedText split() const {
    try {
      return deck::splitDelimited(readInput(file_, largestTable));
    } catch (const DeckError& error) {
      throw DeckError("The table of drill pipe " + file_ + " " + error.what());
    }
  }

  /// Reads positions and units of the columns; false after faults.
  bool header(const deck::DelimitedRow& row) {
    const std::size_t before = faults_.size();
    std::vector<std::string> known{"Name"};
    for (const auto& kind : kinds) known.emplace_back(kind.name);
    columns_ = row.cells.size();
    for (std::size_t place = 0; place < row.cells.size(); ++place) {
      const auto heading = deck::splitHeading(row.cells[place]);
      const auto which = std::find_if(known.begin(), known.end(), [&](const std::string& name) {
        return lower(name) == lower(heading.name);
      });
      if (which == known.end()) {
        const auto meant = closest(heading.name, known);
        fault(row.line, "the column " + inQuotes(heading.name) + " is unknown." +
                            (meant.empty() ? "" : " Did you mean " + inQuotes(meant) + "?") +
                            " Columns: " + quotedList(known) + ".");
        continue;
      }
      auto& found = place_[static_cast<std::size_t>(which - known.begin())];
      if (found) fault(row.line, "the column " + inQuotes(*which) + " occurs twice.");
      found = place;
      if (which != known.begin())
        unit(row.line, static_cast<std::size_t>(which - known.begin()) - 1, heading.unit);
    }
    for (std::size_t i = 0; i < known.size(); ++i)
      if (!place_[i]) fault(row.line, "the column " + inQuotes(known[i]) + " is missing.");
    return faults_.size() == before;
  }

  void unit(int line, std::size_t quantity, const std::string& name) {
    const auto& kind = kinds[quantity];
    const auto factor = deck::unitFactor(name, kind.si);
    if (factor) {
      factor_[quantity] = *factor;
      return;
    }
    fault(line, "the column " + inQuotes(kind.name) + " has " +
                    (name.empty() ? "no unit" : "the unit " + inQuotes(name)) +
                    ". Expected in brackets: " + quotedList(deck::unitsLike(kind.si)) + ".");
  }

  /// The numbers of a row in SI; none after a fault.
  std::optional<std::array<double, quantities>> numbers(const deck::DelimitedRow& row) {
    std::array<double, quantities> value{};
    for (std::size_t i = 0; i < quantities; ++i) {
      const std::string& cell = row.cells[*place_[i + 1]];
      const auto number = deck::cellNumber(cell);
      const std::string problem = !number
                                      ? " is not a number."
                                      : (number->value > 0.0 || (i == Inner && number->value == 0.0)
                                             ? marks_.fault(*number, row.line)
                                             : " must be positive.");
      if (!problem.empty()) {
        fault(row.line, std::string(kinds[i].name) + " " + inQuotes(cell) + problem);
        return std::nullopt;
      }
      value[i] = number->value * factor_[i];
    }
    return value;
  }

  void take(const deck::DelimitedRow& row) {
    if (row.cells.size() != columns_)
      return fault(row.line, "found " + std::to_string(row.cells.size()) + " columns where the " +
                                 "header has " + std::to_string(columns_) + ".");
    const std::string& name = row.cells[*place_[0]];
    const auto value = numbers(row);
    if (!value) return;
    const auto& v = *value;
    for (const auto& [outer, inner] :
         {std::pair{Outer, Inner}, {UpsetOuter, UpsetInner}, {JointOuter, JointInner}})
      if (!(v[inner] < v[outer]))
        return fault(row.line, std::string(kinds[inner].name) + " must be below the " +
                                   kinds[outer].name + ".");
    const double body = v[Length] - v[Box] - v[Pin] - 2.0 * v[UpsetLength];
    if (!(body > 0.0))
      return fault(row.line, "box, pin and upsets are longer than the joint (" +
                                 formatNumber(v[Length]) + " m).");
    Component joint;
    joint.name = name;
    joint.where = file_ + ":" + std::to_string(row.line);
    const Segment upset = piece(v[UpsetLength], v[UpsetOuter], v[UpsetInner], v[Strength]);
    joint.segments = {piece(v[Box], v[JointOuter], v[JointInner], v[JointStrength]), upset,
                      piece(body, v[Outer], v[Inner], v[Strength]), upset,
                      piece(v[Pin], v[JointOuter], v[JointInner], v[JointStrength])};
    Component stand;
    stand.name = name + " stand";
    stand.where = joint.where;
    stand.parts = {{jointsOfAStand, name}};
    for (Component* one : {&joint, &stand})
      if (const auto problem = addComponent(*one, library_); !problem.empty())
        return fault(row.line, problem);
  }

  Segment piece(double length, double outer, double inner, double strength) const {
    beam::Material material = standard_.material;
    material.yieldStrength = strength;
    // the tolerance keeps a length that is a whole number of elements, up to rounding, at that
    // number
    const int elements = static_cast<int>(std::ceil(length / longestElement - 1e-9));
    return {length, std::max(1, elements),
            beam::Section::hollow(0.5 * outer, 0.5 * inner, material), standard_.element};
  }

  const std::string& file_;
  const SegmentDefaults& standard_;
  ComponentLibrary& library_;
  std::vector<std::string>& faults_;
  deck::DecimalMarks marks_;
  std::size_t columns_ = 0;
  std::array<std::optional<std::size_t>, quantities + 1> place_;  ///< of Name and the quantities
  std::array<double, quantities> factor_{};                       ///< to SI
};

}  // namespace

void readPipeTable(const std::string& file, const SegmentDefaults& standard,
                   ComponentLibrary& library, std::vector<std::string>& faults) {
  Reader(file, standard, library, faults).read();
}

}  // namespace tooljoint::drillstring
