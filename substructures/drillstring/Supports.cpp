// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/Supports.hpp"

#include <Teuchos_ParameterList.hpp>
#include <algorithm>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "substructures/beam/NodalDofs.hpp"

namespace tooljoint::drillstring {
namespace {

const std::vector<std::string> dofNames = {"u", "v", "w", "theta_x", "theta_y", "theta_z"};
const std::vector<std::string> familyNames = {"lateral", "axial", "torsional"};

/// Looks up each word of a text in `known`; returns one flag per known name.
std::vector<bool> flags(const std::string& text, const std::vector<std::string>& known,
                        const std::string& where, const std::string& what) {
  std::vector<bool> found(known.size(), false);
  std::string blanks = text;
  std::replace(blanks.begin(), blanks.end(), ',', ' ');
  for (const std::string& word : split(blanks, ' ')) {
    if (trim(word).empty()) continue;
    const auto it = std::find(known.begin(), known.end(), trim(word));
    if (it == known.end()) {
      const std::string meant = closest(trim(word), known);
      throw DeckError(where + ": " + inQuotes(trim(word)) + " is not a " + what + "." +
                      (meant.empty() ? "" : " Did you mean " + inQuotes(meant) + "?") +
                      " Known are " + quotedList(known) + ".");
    }
    found[static_cast<std::size_t>(it - known.begin())] = true;
  }
  return found;
}

}  // namespace

DofFlags parseDofs(const std::string& text, const std::string& where) {
  DofFlags dofs{};
  if (trim(text) == "none") return dofs;
  if (trim(text) == "all") {
    dofs.fill(true);
    return dofs;
  }
  const std::vector<bool> found = flags(text, dofNames, where, "degree of freedom");
  std::copy(found.begin(), found.end(), dofs.begin());
  return dofs;
}

std::vector<char> SupportSettings::held(int nodes) const {
  std::vector<char> held(static_cast<std::size_t>(6 * nodes), 0);
  const auto hold = [&](int node, const DofFlags& dofs) {
    for (std::size_t c = 0; c < 6; ++c)
      if (dofs[c]) held[static_cast<std::size_t>(6 * node) + c] = 1;
  };
  const DofFlags absent = {!lateral, !lateral, !axial, !lateral, !lateral, !torsional};
  for (int i = 0; i < nodes; ++i) hold(i, absent);
  hold(0, top);
  hold(nodes - 1, bit);
  for (const NamedSupport& support : named) {
    if (support.node < 1 || support.node > nodes)
      throw DeckError(support.path + "/Node: node " + std::to_string(support.node) +
                      " does not exist; the string has nodes 1 to " + std::to_string(nodes) + ".");
    hold(support.node - 1, support.dofs);
  }
  return held;
}

deck::ListSpec supportParameters() {
  const std::string standardTop = "u v w theta_z";
  const std::string standardBit = "u v";
  return deck::ListSpec("Supports",
                        "Held degrees of freedom; those of the defaults when the list is absent.")
      .text("Top", standardTop,
            "Dofs held at the surface, among u v w theta_x theta_y theta_z; \"none\" or \"all\".")
      .text("Bit", standardBit, "Dofs held at the last node.")
      .text("Dofs", std::string("lateral axial torsional"),
            "Families of dofs that are modelled; those of the others are held everywhere.")
      .namedLists(deck::ListSpec("Support", "A support at another node.")
                      .integer("Node", deck::Required{}, deck::Range::atLeast(1),
                               "Node number, 1 at the surface.")
                      .text("Dofs", deck::Required{}, "Dofs held there."));
}

SupportSettings readSupports(const Teuchos::ParameterList& list) {
  SupportSettings settings;
  settings.top = parseDofs(list.get<std::string>("Top"), list.name() + "/Top");
  settings.bit = parseDofs(list.get<std::string>("Bit"), list.name() + "/Bit");
  const std::vector<bool> families =
      flags(list.get<std::string>("Dofs"), familyNames, list.name() + "/Dofs", "family of dofs");
  if (std::find(families.begin(), families.end(), true) == families.end())
    throw DeckError(list.name() + "/Dofs: every family of dofs is left out. Available: " +
                    quotedList(familyNames) + ".");
  settings.lateral = families[0];
  settings.axial = families[1];
  settings.torsional = families[2];
  for (auto it = list.begin(); it != list.end(); ++it) {
    const std::string& name = list.name(it);
    if (!list.isSublist(name)) continue;
    const Teuchos::ParameterList& sub = list.sublist(name);
    settings.named.push_back({name, sub.get<int>("Node"),
                              parseDofs(sub.get<std::string>("Dofs"), sub.name() + "/Dofs"),
                              sub.name()});
  }
  return settings;
}

std::vector<char> heldDofs(const SupportSettings& supports, const DrillString& string) {
  std::vector<char> held = supports.held(string.nodeCount());
  const auto present = beam::nodalDofs(string.formulations());
  constexpr std::size_t n = beam::nodal::perNode;
  for (std::size_t i = 0; i < held.size(); ++i)
    if (!present[i / n][i % n]) held[i] = 1;
  return held;
}

}  // namespace tooljoint::drillstring
