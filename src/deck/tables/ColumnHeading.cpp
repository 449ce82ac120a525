// SPDX-License-Identifier: BSD-3-Clause
#include "deck/tables/ColumnHeading.hpp"

#include <cctype>
#include <map>
#include <set>

#include "common/Constants.hpp"
#include "common/Text.hpp"
#include "deck/reading/Units.hpp"

namespace tooljoint::deck {
namespace {

/// The unit with its words in the case of the table of units; none if a word matches several of
/// them, or none.
std::string inTheCaseOfTheTable(const std::string& unit) {
  std::string text, word;
  const auto finish = [&] {
    std::set<std::string> meant;
    for (const auto& symbol : unitSymbols()) {
      if (lower(symbol.symbol) == lower(word)) meant.insert(symbol.symbol);
      for (const auto& also : symbol.synonyms)
        if (lower(also) == lower(word)) meant.insert(symbol.symbol);
    }
    text += meant.size() == 1 ? *meant.begin() : word;
    word.clear();
  };
  for (const char c : unit) {
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) {
      word += c;
      continue;
    }
    if (!word.empty()) finish();
    text += c;
  }
  if (!word.empty()) finish();
  return text;
}

/// Revolutions per minute or second as "per minute" or as cycles; none for other texts. "1/s" may
/// be rad/s as well as rev/s.
std::optional<double> revolutions(const std::string& unit) {
  static const std::map<std::string, double> spellings{
      {"1/min", constants::rpm},    {"min-1", constants::rpm}, {"min^-1", constants::rpm},
      {"c/min", constants::rpm},    {"cpm", constants::rpm},   {"cycles/min", constants::rpm},
      {"revs/min", constants::rpm}, {"c/s", constants::twoPi}, {"cycles/s", constants::twoPi}};
  const auto found = spellings.find(lower(unit));
  return found == spellings.end() ? std::nullopt : std::optional(found->second);
}

}  // namespace

ColumnHeading splitHeading(const std::string& cell) {
  const auto open = cell.find_first_of("[(");
  if (open == std::string::npos) return {trim(cell), ""};
  const auto close = cell.find_first_of("])", open);
  const auto length = close == std::string::npos ? close : close - open - 1;
  return {trim(cell.substr(0, open)), trim(cell.substr(open + 1, length))};
}

std::optional<double> unitFactor(const std::string& unit, const std::string& si) {
  std::string fault;
  if (unit.empty()) return std::nullopt;
  if (si == "m/s2" && lower(unit) == "g") return constants::standardGravity;
  if (si == "rad/s")
    if (const auto factor = revolutions(unit)) return factor;
  if (const auto factor = toSi("1 " + unit, si, fault)) return factor;
  return toSi("1 " + inTheCaseOfTheTable(unit), si, fault);
}

}  // namespace tooljoint::deck
