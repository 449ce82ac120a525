// SPDX-License-Identifier: BSD-3-Clause
#include "parts/ContentEdits.hpp"

#include <algorithm>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/assembly/Congruence.hpp"

namespace tooljoint::parts {

using model::DofLabel;

std::string dofName(const model::SecondOrderModel& m, int position) {
  const auto& label = m.dofs[static_cast<std::size_t>(position)];
  return label.kind == DofLabel::Kind::Modal ? "mode " + std::to_string(label.component + 1)
                                             : model::describe(label, m.componentNames);
}

void widen(PartContent& content, const model::ComponentNames& names) {
  auto& m = content.part.model;
  if (m.componentNames == names) return;
  std::vector<int> to;
  for (const auto& name : m.componentNames)
    to.push_back(static_cast<int>(std::find(names.begin(), names.end(), name) - names.begin()));
  for (auto* labels : {&m.dofs, &content.basis.dofs})
    for (auto& label : *labels)
      if (label.kind == DofLabel::Kind::Physical)
        label.component = to[static_cast<std::size_t>(label.component)];
  const auto before = static_cast<int>(to.size()), after = static_cast<int>(names.size());
  const auto rows = static_cast<Eigen::Index>(m.recoveryNodes.size()) * after;
  Vector offset = Vector::Zero(rows);
  Triplets entries;
  for (int i = 0; i < m.recovery.rows(); ++i) {
    const int row = i / before * after + to[static_cast<std::size_t>(i % before)];
    offset[row] = m.recoveryOffset[i];
    for (model::SharedSparse::InnerIterator it(m.recovery, i); it; ++it)
      entries.emplace_back(row, static_cast<int>(it.col()), it.value());
  }
  Sparse recovery(rows, m.size());
  recovery.setFromTriplets(entries.begin(), entries.end());
  m.recovery = recovery;
  m.recoveryOffset = offset;
  m.componentNames = names;
}

void hold(PartContent& content, const std::vector<char>& held) {
  if (std::count(held.begin(), held.end(), char{0}) == static_cast<std::ptrdiff_t>(held.size()))
    return;
  auto& part = content.part;
  std::vector<int> to(held.size(), -1);
  coupling::Substitution free;
  Triplets entries;
  for (std::size_t i = 0; i < held.size(); ++i) {
    if (held[i]) continue;
    to[i] = static_cast<int>(free.dofs.size());
    entries.emplace_back(static_cast<int>(i), to[i], 1.0);
    free.dofs.push_back(part.model.dofs[i]);
  }
  const auto n = static_cast<Eigen::Index>(free.dofs.size());
  free.map = Sparse(part.model.size(), n);
  free.map.setFromTriplets(entries.begin(), entries.end());
  free.offset = Vector::Zero(part.model.size());
  const Sparse pick = free.map.transpose();
  free.initialDisplacement = pick * part.model.initialDisplacement;
  free.initialVelocity = pick * part.model.initialVelocity;
  if (part.reference.size() > 0) part.reference = Vector(pick * part.reference);
  coupling::substitute(part.model, free);
  part.model.dofs = free.dofs;
  if (!content.basis.empty()) content.basis.vectors = content.basis.vectors * free.map;
  const auto moved = [&](std::vector<int>& positions) {
    std::vector<int> out;
    for (int i : positions)
      if (to[static_cast<std::size_t>(i)] >= 0) out.push_back(to[static_cast<std::size_t>(i)]);
    positions = out;
  };
  moved(part.interface);
  moved(part.retained);
  for (auto& set : content.interfaces) moved(set.dofs);
}

namespace {

std::vector<std::string> words(const std::string& text) {
  std::vector<std::string> out;
  for (const auto& word : split(text, ' '))
    if (!trim(word).empty()) out.push_back(trim(word));
  return out;
}

/// Keeps those of `positions` with one of the named components.
std::vector<int> filtered(const PartContent& content, const std::vector<int>& positions,
                          const std::vector<std::string>& components, const std::string& who) {
  if (components.empty()) return positions;
  const auto& m = content.part.model;
  std::vector<int> out;
  for (const auto& name : components) {
    const auto it = std::find(m.componentNames.begin(), m.componentNames.end(), name);
    if (it == m.componentNames.end())
      throw DeckError("names the component " + inQuotes(name) + ", but the components of part " +
                      inQuotes(content.part.name) + " are " + quotedList(m.componentNames));
    const auto component = static_cast<int>(it - m.componentNames.begin());
    const std::size_t before = out.size();
    for (int i : positions)
      if (m.dofs[static_cast<std::size_t>(i)].component == component) out.push_back(i);
    if (out.size() == before)
      throw DeckError("names " + name + " of " + who + ", which part " +
                      inQuotes(content.part.name) + " does not have");
  }
  return out;
}

}  // namespace

std::vector<int> positionsOf(const PartContent& content, const std::string& text) {
  const auto all = words(text);
  if (all.empty()) throw DeckError("holds an empty text. Give a node or an interface set");
  for (std::size_t length = all.size(); length > 0; --length) {  // names of sets may contain blanks
    const std::string name =
        join({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(length)}, " ");
    for (const auto& set : content.interfaces)
      if (set.name == name)
        return filtered(content, set.dofs,
                        {all.begin() + static_cast<std::ptrdiff_t>(length), all.end()},
                        inQuotes(name));
  }
  const auto& first = all.front();
  if (first.find_first_not_of("0123456789") != std::string::npos || first.size() > 15) {
    std::vector<std::string> sets;
    for (const auto& set : content.interfaces) sets.push_back(set.name);
    const auto meant = closest(first, sets);
    throw DeckError("names " + inQuotes(text) +
                    ", which is neither a node nor an interface set of part " +
                    inQuotes(content.part.name) +
                    (!meant.empty() ? ". Did you mean " + inQuotes(meant) + "?"
                     : sets.empty() ? "; it has no sets"
                                    : "; its sets are " + quotedList(sets)));
  }
  const std::int64_t node = std::stoll(first);
  std::vector<int> positions;
  const auto& m = content.part.model;
  for (int i = 0; i < m.size(); ++i)
    if (const auto& label = m.dofs[static_cast<std::size_t>(i)];
        label.kind == DofLabel::Kind::Physical && label.entity == node)
      positions.push_back(i);
  if (positions.empty())
    throw DeckError("names node " + first + ", which part " + inQuotes(content.part.name) + " (" +
                    content.file + ") does not have as a dof");
  return filtered(content, positions, {all.begin() + 1, all.end()}, "node " + first);
}

}  // namespace tooljoint::parts
