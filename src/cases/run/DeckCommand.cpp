// SPDX-License-Identifier: BSD-3-Clause
#include "cases/run/DeckCommand.hpp"

#include <algorithm>
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

/// True for an override of the list or parameter `path`, or of something inside it.
bool touches(const std::string& override, const std::string& path) {
  const auto from = override.find_first_not_of("!/");
  if (from == std::string::npos || override.compare(from, path.size(), path) != 0) return false;
  const auto next = from + path.size();
  return next == override.size() || override[next] == '/' || override[next] == '=';
}

}  // namespace

std::string overrideSwitches(const deck::Deck& deck, const std::string& unread) {
  std::vector<std::string> read;
  for (const auto& one : deck.overrides())
    if (unread.empty() || !touches(one, unread)) read.push_back(one);
  return switches(read);
}

std::string fullModelSwitches(const deck::Deck& deck) {
  std::vector<std::string> gone{"Reduction"};
  if (deck.gives("Output/Export Parts")) gone.emplace_back("Output/Export Parts");
  if (!deck.gives("Coupling") && deck.gives("Substructures")) gone.emplace_back("Substructures");
  std::vector<std::string> all;
  for (const auto& path : gone) all.push_back("!" + path);
  const bool dual = deck.gives("Coupling/Assembly") &&
                    deck.list().sublist("Coupling").get<std::string>("Assembly") == "Dual";
  if (dual) gone.emplace_back("Coupling/Assembly");
  for (const auto& one : deck.overrides())
    if (std::none_of(gone.begin(), gone.end(),
                     [&](const std::string& path) { return touches(one, path); }))
      all.push_back(one);
  if (dual) all.emplace_back("Coupling/Assembly=Primal");
  return switches(all);
}

}  // namespace tooljoint::cases
