// SPDX-License-Identifier: BSD-3-Clause
#include "substructures/drillstring/Partition.hpp"

#include <Teuchos_Array.hpp>
#include <Teuchos_ParameterList.hpp>
#include <algorithm>
#include <limits>
#include <set>

#include "common/Error.hpp"
#include "substructures/contact/BoreholeContact.hpp"

namespace tooljoint::drillstring {

deck::ListSpec partitionParameters() {
  using deck::Range;
  deck::ListSpec list("Substructures",
                      "Where the string is cut into parts and what stays physical in them. Absent: "
                      "one part per component, "
                      "with the defaults below, when there is a Reduction list.");
  list.choice(
      "Rule", std::string("By component"),
      {"By component", "By length", "By cost", "By nodes", "Single"},
      "Where the string is cut: at every component boundary, at the component boundaries that "
      "leave parts of at least Length, so that a step of the reduced model is predicted to cost "
      "least, at Cut Nodes, or not at all (the single substructure of Nguyen et al. 2020). \"By "
      "cost\" needs modes by a cut-off or a tolerance. It tries lengths from one component on and, "
      "where that gains less than 15 %, to retain all nodes that can touch and a Minimum Reduced "
      "Run of 8, as far as the deck leaves these open.");
  list.real("Length", "m", deck::Optional{}, Range::positive(),
            "Shortest part of the rule \"By length\"; required there.");
  list.integerArray("Cut Nodes", deck::Optional{}, Range::atLeast(2),
                    "Nodes (1-based) where the rule \"By nodes\" cuts; required there.")
      .expert();
  list.choice("Retained Dofs", deck::Optional{}, {"Nodes", "Contact", "Translations"},
              "Dofs that stay physical at a retained node: all six, u v theta_z, or u v (the last "
              "two also w with Contact/Friction/Axial). Default: Nodes for implicit integrators, "
              "Translations for explicit ones.")
      .formerly("Retain");
  list.choice("Retained Nodes", std::string("Gap"),
              {"Gap", "Static contacts", "Gauges", "All", "List", "None"},
              "Which nodes are retained: static gap below Retained Gap, nodes in contact in the "
              "static state, gauges, every "
              "node that can touch, Node List, or none.");
  list.real("Retained Gap", "m", 0.008, Range::nonNegative(),
            "Static gap below which a node is retained by the choice \"Gap\".");
  list.real("Keep Full Below", "m", deck::Optional{}, Range::nonNegative(),
            "Depth below which every node is retained, in addition to those of Retained Nodes: the "
            "bottom-hole assembly and the pipes above it that strike the wall are not reduced, the "
            "long string above is.")
      .formerly("Whole Below");
  list.integer(
          "Minimum Reduced Run", 1, Range::atLeast(1),
          "Nodes in runs shorter than this between kept nodes (retained ones, loads, ends of "
          "parts) "
          "are retained too: a few nodes cost less as they "
          "are than as constraint modes and modes. 8 is a good choice for speed; 1 keeps all runs.")
      .expert()
      .formerly("Shortest Run");
  list.integerArray("Node List", deck::Optional{}, Range::atLeast(1),
                    "Nodes (1-based) of the choice \"List\"; required there.")
      .expert();
  list.choice("Contact Nodes", std::string("All"), {"All", "Retained"},
              "Where contact is evaluated in the reduced model: at every node that can touch, or "
              "at retained nodes alone (a short "
              "cut: the run warns when a skipped node would have touched).")
      .expert();
  return list;
}

namespace {

std::vector<int> integers(const Teuchos::ParameterList& list, const std::string& name,
                          const std::string& choice) {
  if (!list.isParameter(name))
    throw DeckError(list.name() + "/" + name + " is required by the choice \"" + choice +
                    "\" and is missing.");
  return list.get<Teuchos::Array<int>>(name).toVector();
}

void requireNodes(const std::vector<int>& nodes, int count, const std::string& parameter) {
  for (int node : nodes)
    if (node < 1 || node > count)
      throw DeckError(parameter + ": node " + std::to_string(node) +
                      " does not exist; the string has nodes 1 to " + std::to_string(count) + ".");
}

}  // namespace

PartitionRules readPartition(const Teuchos::ParameterList& list, bool explicitIntegrator) {
  PartitionRules rules;
  rules.where = list.name();
  rules.retain = explicitIntegrator ? Retain::Translations : Retain::Nodes;
  rules.rule = list.get<std::string>("Rule");
  if (rules.rule == "By length") {
    if (!list.isParameter("Length"))
      throw DeckError(list.name() +
                      "/Length is required by the rule \"By length\" and is missing.");
    rules.length = list.get<double>("Length");
  }
  if (rules.rule == "By nodes") rules.cutNodes = integers(list, "Cut Nodes", rules.rule);
  if (list.isParameter("Retained Dofs")) {
    const auto retain = list.get<std::string>("Retained Dofs");
    rules.retain = retain == "Nodes"     ? Retain::Nodes
                   : retain == "Contact" ? Retain::Contact
                                         : Retain::Translations;
  }
  rules.retainedNodes = list.get<std::string>("Retained Nodes");
  rules.retainedGap = list.get<double>("Retained Gap");
  if (list.isParameter("Keep Full Below"))
    rules.keepFullBelow = list.get<double>("Keep Full Below");
  rules.minimumReducedRun = list.get<int>("Minimum Reduced Run");
  if (rules.retainedNodes == "List") rules.nodeList = integers(list, "Node List", "List");
  rules.contactAtRetainedOnly = list.get<std::string>("Contact Nodes") == "Retained";
  return rules;
}

std::vector<PartRange> cutParts(const DrillString& string, const PartitionRules& rules) {
  const int last = string.elementCount() - 1;
  std::vector<PartRange> parts;
  if (rules.rule == "Single") return {{"string", 0, last}};
  if (rules.rule == "By nodes") {
    const std::set<int> cuts(rules.cutNodes.begin(), rules.cutNodes.end());
    int first = 0;
    for (int node : cuts) {  // element e joins nodes e and e+1 (0-based); cutting at 1-based node n
                             // ends element n-2
      if (node < 2 || node > last + 1)
        throw DeckError(rules.where + "/Cut Nodes: node " + std::to_string(node) +
                        " is an end of the string; cut between 2 and " + std::to_string(last + 1) +
                        ".");
      parts.push_back({"part " + std::to_string(parts.size() + 1), first, node - 2});
      first = node - 1;
    }
    parts.push_back({"part " + std::to_string(parts.size() + 1), first, last});
    return parts;
  }
  if (rules.rule == "By component" || rules.rule == "By cost") {
    for (const auto& instance : string.instances)
      parts.push_back({instance.path, instance.firstElement, instance.lastElement});
    return parts;
  }
  // By length: join neighbouring components until a part is long enough; a short remainder joins
  // the last part.
  PartRange open;
  bool isOpen = false;
  double length = 0.0;
  for (const auto& instance : string.instances) {
    if (!isOpen) open = {instance.path, instance.firstElement, instance.lastElement};
    isOpen = true;
    open.lastElement = instance.lastElement;
    for (int e = instance.firstElement; e <= instance.lastElement; ++e)
      length += string.elements[static_cast<std::size_t>(e)].length();
    if (length < rules.length * (1.0 - 1e-12)) continue;
    parts.push_back(open);
    isOpen = false;
    length = 0.0;
  }
  if (isOpen && parts.empty())
    parts.push_back(open);
  else if (isOpen)
    parts.back().lastElement = open.lastElement;
  return parts;
}

void requireKnownNodes(const DrillString& string, const PartitionRules& rules) {
  requireNodes(rules.cutNodes, string.nodeCount(), rules.where + "/Cut Nodes");
  requireNodes(rules.nodeList, string.nodeCount(), rules.where + "/Node List");
}

std::vector<int> chosenNodes(const DrillString& string, const PartitionRules& rules,
                             const NodeState& state) {
  std::vector<int> nodes;
  if (rules.retainedNodes == "List") {
    for (int node : rules.nodeList) nodes.push_back(node - 1);
    std::sort(nodes.begin(), nodes.end());
    nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    return nodes;
  }
  for (int node = 0; node < string.nodeCount(); ++node) {
    const auto n = static_cast<std::size_t>(node);
    const bool gauge = rules.retainedNodes == "Gauges" && string.nodes[n].gauge;
    const bool gap =
        state.candidate[n] && rules.retainedNodes == "Gap" && state.gap[n] < rules.retainedGap;
    const bool touching =
        state.candidate[n] && rules.retainedNodes == "Static contacts" && state.gap[n] < 0.0;
    const bool all = state.candidate[n] && rules.retainedNodes == "All";
    if (gauge || gap || touching || all) nodes.push_back(node);
  }
  return nodes;
}

namespace {

/// Nodes at or below rules.keepFullBelow.
std::vector<int> wholeNodes(const DrillString& string, const PartitionRules& rules) {
  const auto depths = string.depths();
  std::vector<int> nodes;
  for (int node = 0; node < string.nodeCount(); ++node)
    if (depths[static_cast<std::size_t>(node)] >= rules.keepFullBelow * (1.0 - 1e-12))
      nodes.push_back(node);
  return nodes;
}

/// Inner nodes of runs of fewer than rules.minimumReducedRun nodes between retained nodes.
std::vector<int> nodesOfShortRuns(const DrillString& string, const PartitionRules& rules,
                                  const std::set<int>& keptDofs, const std::vector<int>& chosen) {
  std::vector<char> kept(static_cast<std::size_t>(string.nodeCount()), 0);
  for (int node : wholeNodes(string, rules)) kept[static_cast<std::size_t>(node)] = 1;
  for (int dof : keptDofs) kept[static_cast<std::size_t>(dof / 6)] = 1;
  for (int node : chosen) kept[static_cast<std::size_t>(node)] = 1;
  for (const auto& part : cutParts(string, rules))
    kept[static_cast<std::size_t>(part.firstElement)] =
        kept[static_cast<std::size_t>(part.lastElement + 1)] = 1;
  std::vector<int> nodes, run;
  for (int node = 0; node < string.nodeCount(); ++node) {
    if (!kept[static_cast<std::size_t>(node)]) {
      run.push_back(node);
      continue;
    }
    if (static_cast<int>(run.size()) < rules.minimumReducedRun)
      nodes.insert(nodes.end(), run.begin(), run.end());
    run.clear();
  }
  return nodes;
}

}  // namespace

std::vector<int> retainedDofs(const DrillString& string, const PartitionRules& rules,
                              const NodeState& state) {
  std::set<int> dofs(state.loadedDofs.begin(), state.loadedDofs.end());
  std::vector<int> components;
  switch (rules.retain) {
    case Retain::Nodes:
      components = {0, 1, 2, 3, 4, 5};
      break;
    case Retain::Contact:
      components = contact::contactComponents(rules.axialContact ? 4 : 3);
      break;
    case Retain::Translations:
      components = {0, 1};
      if (rules.axialContact) components.push_back(2);
      break;
  }
  const auto chosen = chosenNodes(string, rules, state);
  const auto shortRuns = nodesOfShortRuns(string, rules, dofs, chosen);
  for (int node : chosen)
    for (int component : components) dofs.insert(6 * node + component);
  for (int node : wholeNodes(string, rules))
    for (int component = 0; component < 6; ++component) dofs.insert(6 * node + component);
  for (int node : shortRuns)
    for (int component = 0; component < 6; ++component) dofs.insert(6 * node + component);
  return {dofs.begin(), dofs.end()};
}

}  // namespace tooljoint::drillstring
