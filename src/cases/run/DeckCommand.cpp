// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/DeckCommand.hpp"

#include <vector>

#include "common/Text.hpp"

namespace tooljoint::cases {

namespace {

std::string switches(const std::vector<std::string>& overrides) {
  std::string words;
  for (const auto& one : overrides)
    words += one[0] == '!' ? " --without " + inShellQuotes(one.substr(1))
                           : " --set " + inShellQuotes(one);
  return words;
}

/// True of an override of the list or parameter `path`, or of something in it.
bool touches(const std::string& override, const std::string& path) {
  const auto from = override.find_first_not_of("!/");
  if (from == std::string::npos || override.compare(from, path.size(), path) != 0) return false;
  const auto next = from + path.size();
  return next == override.size() || override[next] == '/' || override[next] == '=';
}

}  // namespace

std::string overrideSwitches(const deck::Deck& deck) { return switches(deck.overrides()); }

std::string fullModelSwitches(const deck::Deck& deck) {
  const auto& list = deck.list();
  std::vector<std::string> without{"Reduction"}, set;
  if (deck.gives("Output/Export Parts")) without.push_back("Output/Export Parts");
  if (!deck.gives("Coupling") && deck.gives("Substructures")) without.push_back("Substructures");
  if (deck.gives("Coupling/Assembly") &&
      list.sublist("Coupling").get<std::string>("Assembly") == "Dual")
    set.push_back("Coupling/Assembly=Primal");
  std::vector<std::string> all;
  for (const auto& path : without) all.push_back("!" + path);
  for (const auto& one : deck.overrides()) {
    bool gone = false;
    for (const auto& path : without) gone = gone || touches(one, path);
    if (!gone) all.push_back(one);
  }
  all.insert(all.end(), set.begin(), set.end());
  return switches(all);
}

}  // namespace tooljoint::cases
