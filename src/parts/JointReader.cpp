// SPDX-License-Identifier: BSD-3-Clause
#include "parts/JointReader.hpp"

#include <algorithm>
#include <map>

#include "common/Error.hpp"
#include "common/Text.hpp"
#include "coupling/input/ComponentAxes.hpp"

namespace tooljoint::parts {

using model::DofLabel;

void JointReader::fail(const std::string& text, const std::string& what) const {
  throw DeckError(where_ + " says " + inQuotes(text) + ", but " + what);
}

JointReader::Side JointReader::side(const std::string& text, const std::string& whole) const {
  Side out;
  out.text = trim(text);
  const auto colon = out.text.rfind(':');
  if (colon == std::string::npos || colon == 0 || colon + 1 == out.text.size())
    fail(whole, "a place is written PART:NODE or PART:SET, for example \"left:tip\".");
  const std::string name = trim(out.text.substr(0, colon)),
                    place = trim(out.text.substr(colon + 1));
  std::vector<std::string> names;
  for (const auto& one : parts_) names.push_back(one.part.name);
  const auto it = std::find(names.begin(), names.end(), name);
  if (it == names.end()) {
    const auto meant = closest(name, names);
    fail(whole, "there is no part " + inQuotes(name) +
                    (meant.empty() ? "; the parts are " + quotedList(names) + "."
                                   : ". Did you mean " + inQuotes(meant) + "?"));
  }
  out.part = static_cast<int>(it - names.begin());
  const auto& content = parts_[static_cast<std::size_t>(out.part)];
  const auto set = std::find_if(content.interfaces.begin(), content.interfaces.end(),
                                [&](const auto& one) { return one.name == place; });
  const bool number =
      place.find_first_not_of("0123456789") == std::string::npos && place.size() < 16;
  if (set == content.interfaces.end() && !number) {
    std::vector<std::string> sets;
    for (const auto& one : content.interfaces) sets.push_back(one.name);
    const auto meant = closest(place, sets);
    fail(whole, "part " + inQuotes(name) + " (" + content.file + ") has no interface set " +
                    inQuotes(place) +
                    (!meant.empty() ? ". Did you mean " + inQuotes(meant) + "?"
                     : sets.empty() ? ". It has none."
                                    : "; its sets are " + quotedList(sets) + "."));
  }
  if (set != content.interfaces.end())
    out.nodes = set->nodes;
  else
    out.nodes = {std::stoll(place)};
  for (auto node : out.nodes) {
    std::set<int> had, joined;
    const auto& dofs = content.part.model.dofs;
    for (int i = 0; i < static_cast<int>(dofs.size()); ++i) {
      const auto& label = dofs[static_cast<std::size_t>(i)];
      if (label.kind != DofLabel::Kind::Physical || label.entity != node) continue;
      had.insert(label.component);
      if (set == content.interfaces.end() ||
          std::find(set->dofs.begin(), set->dofs.end(), i) != set->dofs.end())
        joined.insert(label.component);
    }
    for (const auto& [p, label] : held_)
      if (p == out.part && label.entity == node && label.kind == DofLabel::Kind::Physical)
        had.insert(label.component);
    if (had.empty())
      fail(whole, "part " + inQuotes(name) + " (" + content.file + ") has no node " +
                      std::to_string(node) + ".");
    out.had.push_back(had);
    out.joined.push_back(joined);
  }
  return out;
}

bool JointReader::splitsTriple(const Side& side, std::size_t k, const std::set<int>& some) const {
  const auto axes = coupling::componentAxes(parts_.front().part.model.componentNames);
  for (const auto& triple : {axes.translation, axes.rotation}) {
    std::size_t had = 0, in = 0;
    for (int c : triple) had += side.had[k].count(c), in += some.count(c);
    if (in > 0 && in < had) return true;
  }
  return false;
}

ReadJoint JointReader::read(const std::string& text) const {
  std::vector<Side> sides;
  for (const auto& one : split(text, '=')) sides.push_back(side(one, text));
  if (sides.size() < 2) fail(text, "a joint needs two or more places with \"=\" between them.");
  for (std::size_t s = 0; s < sides.size(); ++s) {
    for (std::size_t other = 0; other < s; ++other)
      if (sides[other].part == sides[s].part)
        fail(text, "both places are in part \"" +
                       parts_[static_cast<std::size_t>(sides[s].part)].part.name +
                       "\". Join nodes of one part by constraints of the list Coupling.");
    if (sides[s].nodes.size() != sides[0].nodes.size())
      fail(text, inQuotes(sides[0].text) + " has " + std::to_string(sides[0].nodes.size()) +
                     " nodes and " + inQuotes(sides[s].text) + " has " +
                     std::to_string(sides[s].nodes.size()) +
                     ". Sets are joined node by node: give sets of the same size.");
  }
  const auto& names = parts_.front().part.model.componentNames;
  ReadJoint out;
  for (std::size_t k = 0; k < sides[0].nodes.size(); ++k) {
    coupling::JointInput joint;
    joint.name = text;
    joint.path = where_;
    std::set<int> common = sides[0].joined[k];
    std::map<int, int> owners;
    for (const auto& one : sides) {
      joint.nodes.push_back({parts_[static_cast<std::size_t>(one.part)].part.name, one.nodes[k]});
      std::set<int> both;
      std::set_intersection(common.begin(), common.end(), one.joined[k].begin(),
                            one.joined[k].end(), std::inserter(both, both.begin()));
      common = both;
      for (int c : one.had[k]) ++owners[c];
    }
    for (const auto& one : sides)
      for (int c : one.had[k]) {
        const bool fixed = held_.count({one.part, DofLabel::physical(one.nodes[k], c)}) > 0;
        for (const auto& other : sides)
          if (fixed && other.joined[k].count(c) > 0)
            fail(text, names[static_cast<std::size_t>(c)] + " of node " +
                           std::to_string(one.nodes[k]) + " is fixed in part \"" +
                           parts_[static_cast<std::size_t>(one.part)].part.name +
                           "\" and free in part \"" +
                           parts_[static_cast<std::size_t>(other.part)].part.name +
                           "\". Fix it in both.");
      }
    if (common.empty())
      fail(text, "node " + std::to_string(sides[0].nodes[k]) + " of " +
                     inQuotes(joint.nodes[0].part) + " and node " +
                     std::to_string(sides[1].nodes[k]) + " of " + inQuotes(joint.nodes[1].part) +
                     " have no free component in common.");
    for (const auto& one : sides) {
      coupling::ReleaseInput release;
      release.name = text;
      release.path = where_;
      release.node = {parts_[static_cast<std::size_t>(one.part)].part.name, one.nodes[k]};
      std::set<int> released;
      for (int c : one.had[k])
        if (owners[c] > 1 && common.count(c) == 0 &&
            held_.count({one.part, DofLabel::physical(one.nodes[k], c)}) == 0)
          released.insert(c);
      if (released.empty()) continue;
      for (int c : released) release.components.push_back(names[static_cast<std::size_t>(c)]);
      if (splitsTriple(one, k, released)) out.mixed.insert(one.part);
      out.releases.push_back(release);
    }
    out.joints.push_back(joint);
  }
  return out;
}

}  // namespace tooljoint::parts
