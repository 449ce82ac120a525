// SPDX-License-Identifier: BSD-3-Clause
#include "cases/imported/ImportedCase.hpp"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "cases/CaseKinds.hpp"
#include "cases/CaseLists.hpp"
#include "cases/ListText.hpp"
#include "cases/ReducedCase.hpp"
#include "cases/imported/ImportedRecord.hpp"
#include "cases/imported/MeasuredComponents.hpp"
#include "common/Error.hpp"
#include "common/Index.hpp"
#include "common/Text.hpp"
#include "common/report/Log.hpp"
#include "linalg/SparseProducts.hpp"
#include "parts/PartsGeometry.hpp"
#include "stability/StabilityText.hpp"

namespace tooljoint::cases {

namespace {

void append(std::string& text, const double* values, Eigen::Index count) {
  text.append(reinterpret_cast<const char*>(values),
              static_cast<std::size_t>(count) * sizeof(double));
}

void append(std::string& text, const Sparse& matrix) {
  for (int row = 0; row < matrix.outerSize(); ++row)
    for (Sparse::InnerIterator it(matrix, row); it; ++it) {
      text += std::to_string(row) + "," + std::to_string(it.col()) + ";";
      append(text, &it.value(), 1);
    }
}

/// \param started  the parts are in the state from which the motion starts
coupling::Coupling joinUnreduced(const parts::PartsScene& scene, bool started) {
  auto options = scene.coupling;
  options.requireAgreeingStarts = started;
  options.assembly = coupling::Assembly::Primal;
  return coupling::coupleWithPositions(scene.parts, options);
}

/// Imported parts in the state they start from.
class RestingParts : public RestingCase {
 public:
  RestingParts(std::shared_ptr<const ImportedDeck> lists, std::shared_ptr<const JoinedParts> joined)
      : lists_(std::move(lists)), joined_(std::move(joined)) {}

  coupling::Coupling full() const override { return joined_->whole; }
  coupling::ResolvedCoupling parts() const override {
    return {joined_->scene.parts, joined_->scene.coupling};
  }
  Vector rest() const override {
    const auto& m = model();
    return m.recoveryOffset + m.recovery * m.initialDisplacement;
  }

  /// The case has no walls and bits.
  Measures measures() const override {
    Measures m;
    m.nodes = model().recoveryNodes;
    m.components = measuredComponents(model().componentNames);
    m.vibrating = m.components.size();
    m.clearance.assign(m.nodes.size(), std::numeric_limits<double>::infinity());
    return m;
  }

  void judge() const override {
    const auto& found = joined_->stability;
    if (!found || found->stable()) return;
    log::warn(std::string(lists_->settings.atRest ? "The equilibrium" : "The state") +
              " of the parts is " + stabilityText() +
              (found->diverges()
                   ? " A small disturbance leaves it: check the signs of the stiffness, reduce the "
                     "loads, or start where the parts come to rest (Parts/Starts)."
                   : " A small disturbance grows into a vibration without an excitation."));
  }

  std::string describe() const override {
    return joined_->stability ? "stability   " + stabilityText() : "";
  }
  void summarise(io::Summary& summary) const override {
    if (lists_->settings.atRest) summary.set("static.converged", true);
    if (!joined_->stability) return;
    stability::summarise(*joined_->stability, summary);
    if (!joined_->stability->stable()) summary.set("static.unstable_node", unstableNode());
  }

  /// Group /model (part and node of each row), and the displacements at the start.
  void write(io::ResultsFile& file) const override {
    writeProfile(file);
    writeGeometry(file);
    file.write("/static/displacement", rest(),
               {model().recoveryNodes.size(), model().componentNames.size()}, "m, rad",
               "Displacements at the start, in the common frame");
  }

  void writeProfile(io::ResultsFile& file) const override {
    std::vector<int> part, node;
    for (auto number : model().recoveryNodes) {
      const auto& name = joined_->scene.nodes.at(number).front();
      part.push_back(name.part + 1);
      node.push_back(static_cast<int>(name.node));
    }
    std::vector<std::string> names, units;
    for (const auto& one : joined_->scene.parts) names.push_back(one.name);
    for (const auto& name : model().componentNames) units.push_back(unitOf(name));
    const std::size_t count = node.size();
    file.write("/model/part_names", names, "Parts in the order of the deck");
    file.write("/model/components", model().componentNames, "Components of a node");
    file.write("/model/component_units", units,
               "Unit of each component; empty where its name says neither a translation nor a "
               "rotation");
    file.write("/model/part", part, {count}, "1",
               "Part of each node, counted from 1; the first one of a joined node");
    file.write("/model/node", node, {count}, "1", "Number of each node in that part");
  }

  std::unique_ptr<MotionRecord> record(const model::SecondOrderModel& model) const override {
    const auto& output = lists_->common.output;
    const auto names = [joined = joined_](std::int64_t number) {
      const auto& name = joined->scene.nodes.at(number).front();
      return std::pair{joined->scene.parts[static_cast<std::size_t>(name.part)].name,
                       static_cast<long>(name.node)};
    };
    return std::make_unique<ImportedRecord>(
        model, output.hasField("normal_force"),
        figureWindow(output.figures, lists_->list().sublist("Transient")), names);
  }
  std::vector<parts::PartContent> contents(const std::vector<model::Substructure>&) const override {
    auto contents = joined_->scene.contents;
    for (std::size_t p = 0; p < contents.size(); ++p)
      contents[p].turned = lists_->settings.imported[p].turned;
    return contents;
  }

 private:
  const model::SecondOrderModel& model() const { return joined_->whole.model; }

  /// "part:node"; empty if no node moves.
  std::string unstableNode() const {
    const auto found = joined_->scene.nodes.find(joined_->stability->outline.node);
    if (found == joined_->scene.nodes.end()) return "";
    const auto& name = found->second.front();
    return joined_->scene.parts[static_cast<std::size_t>(name.part)].name + ":" +
           std::to_string(name.node);
  }
  std::string stabilityText() const {
    return stability::inWords(*joined_->stability, "the parts leave it", "node " + unstableNode());
  }

  /// Positions of the nodes and edges of the mesh, if the files give positions.
  void writeGeometry(io::ResultsFile& file) const {
    const auto positions = parts::nodePositions(joined_->scene, lists_->settings.imported);
    if (positions.empty()) return;
    std::map<std::int64_t, int> rows;
    std::vector<int> located, links;
    std::vector<double> coordinates;
    int row = 0;
    for (auto number : model().recoveryNodes) {
      ++row;
      const auto found = positions.find(number);
      if (found == positions.end()) continue;
      rows.emplace(number, row);
      located.push_back(row);
      coordinates.insert(coordinates.end(), found->second.begin(), found->second.end());
    }
    if (located.empty()) return;
    for (const auto& [first, second] : parts::nodeLinks(joined_->scene))
      if (rows.count(first) > 0 && rows.count(second) > 0)
        links.insert(links.end(), {rows.at(first), rows.at(second)});
    file.write("/model/located", located, {located.size()}, "1",
               "Rows of the nodes whose positions are known, counted from 1");
    file.write("/model/position", coordinates, {located.size(), 3}, "m",
               "Their positions in the common frame");
    if (links.empty()) return;
    file.write("/model/links", links, {links.size() / 2, 2}, "1",
               "Rows of the nodes that the stiffness of a part couples, counted from 1");
  }

  std::shared_ptr<const ImportedDeck> lists_;
  std::shared_ptr<const JoinedParts> joined_;
};

const bool importedCaseRegistered =
    CaseKinds::instance().add({{"Parts"}, 0, importedSpec, [](const deck::Deck& deck) {
                                 return std::make_unique<ImportedCase>(ImportedDeck(deck));
                               }});

/// True when a part neither rests nor starts from its reference state.
bool startsElsewhere(const model::Substructure& part) {
  const auto& m = part.model;
  const Vector rest = part.reference.size() > 0 ? part.reference : Vector(Vector::Zero(m.size()));
  return !m.initialVelocity.isZero(0.0) || m.initialDisplacement != rest;
}

}  // namespace

ImportedCase::ImportedCase(ImportedDeck lists)
    : ImportedCase(std::move(lists), std::make_shared<Shared>()) {}

ImportedCase::ImportedCase(ImportedDeck lists, std::shared_ptr<Shared> shared)
    : lists_(std::make_shared<const ImportedDeck>(std::move(lists))), shared_(std::move(shared)) {
  auto key = list();
  for (const char* name : {"Reduction", "Transient", "Output"}) key.remove(name, false);
  for (const auto& analysis : AnalysisLists::instance().lists()) key.remove(analysis.name, false);
  auto& joined = (*shared_)[canonicalText(key) + formatNumber(lists_->startTime())];
  if (!joined) {
    auto fresh = std::make_shared<JoinedParts>();
    fresh->scene = lists_->build();
    fresh->whole = joinUnreduced(fresh->scene, false);
    joined = fresh;
  }
  joined_ = joined;
  lists_->checkReduction(joined_->scene);
}

std::unique_ptr<Case> ImportedCase::with(const std::vector<std::string>& overrides) const {
  ImportedDeck lists(deck().with(overrides));
  return std::unique_ptr<Case>(new ImportedCase(std::move(lists), shared_));
}

/// Node numbers in the scene for "part:node".
std::vector<std::int64_t> ImportedCase::recordedNodes() const {
  const auto& scene = joined_->scene;
  const auto wanted = cases::listOrDefaults(list(), io::parameters());
  if (wanted.isParameter("Depths"))
    throw DeckError(deck().error(
        "Output/Depths", "gives depths of a string. Nodes of parts are chosen by Output/Nodes."));
  std::map<std::string, std::int64_t> numbers;
  for (const auto& [number, names] : scene.nodes)
    for (const auto& name : names)
      numbers.emplace(
          scene.parts[static_cast<std::size_t>(name.part)].name + ":" + std::to_string(name.node),
          number);
  std::set<std::int64_t> chosen;
  if (!wanted.isParameter("Nodes")) return {};
  for (const auto& name : wanted.get<Teuchos::Array<std::string>>("Nodes")) {
    const auto found = numbers.find(name);
    if (found == numbers.end()) throw DeckError(deck().error("Output/Nodes", unknownNode(name)));
    const auto& shown =
        scene.parts[static_cast<std::size_t>(scene.nodes.at(found->second).front().part)].name;
    if (scene.coupling.connections.releases(found->second) &&
        name.substr(0, name.rfind(':')) != shown)
      throw DeckError(deck().error(
          "Output/Nodes",
          "names " + inQuotes(name) +
              ", of which a component is released: results have this node "
              "as part " +
              inQuotes(shown) +
              " moves it. Name it in that part, or leave the nodes "
              "apart (without the joint and its Releases) and join the other components by "
              "Coupling/Constraints."));
    chosen.insert(found->second);
  }
  return {chosen.begin(), chosen.end()};
}

std::string ImportedCase::unknownNode(const std::string& name) const {
  std::vector<std::string> parts;
  for (const auto& part : joined_->scene.parts) parts.push_back(part.name);
  const auto part = name.substr(0, name.rfind(':'));
  const auto near = closest(part, parts);
  const bool known = std::find(parts.begin(), parts.end(), part) != parts.end();
  return "names " + inQuotes(name) +
         (known ? ", a node its part does not have."
                : ", but nodes are given as part:node, and there is no such part.") +
         (known || near.empty() ? "" : " Did you mean the part " + inQuotes(near) + "?") +
         (known ? "" : " The parts are " + quotedList(parts) + ".");
}

std::string ImportedCase::files() const {
  std::string text;
  for (const auto& content : joined_->scene.contents) {
    const auto& model = content.part.model;
    append(text, model.mass);
    for (const auto& term : model.damping) append(text, term.matrix);
    for (const auto& term : model.stiffness) append(text, term.matrix);
    for (const auto& load : model.loads) append(text, load.vector.data(), load.vector.size());
    append(text, model.recovery);
  }
  return text;
}

int ImportedCase::components() const {
  return static_cast<int>(joined_->whole.model.componentNames.size());
}

std::string ImportedCase::describe() const {
  const auto& scene = joined_->scene;
  std::set<std::string> files;
  for (const auto& content : scene.contents) files.insert(content.file);
  char text[256];
  std::snprintf(text, sizeof text,
                "parts       %zu from %zu file%s, %zu nodes, %d dofs, %d when joined",
                scene.parts.size(), files.size(), files.size() == 1 ? "" : "s", scene.nodes.size(),
                scene.dofs(), freeDofs());
  return text;
}

std::vector<std::string> ImportedCase::remarks() const {
  auto out = joined_->whole.remarks;
  for (const auto& content : joined_->scene.contents) {
    const auto& m = content.part.model;
    const std::string who = "Part \"" + content.part.name + "\" (" + content.file + ")";
    if (linalg::isZero(m.mass)) out.push_back(who + " has no mass: its mass matrix is zero.");
    if (std::all_of(m.stiffness.begin(), m.stiffness.end(),
                    [](const auto& term) { return linalg::isZero(term.matrix); }))
      out.push_back(who + " has no stiffness: its stiffness matrix is zero.");
    for (const auto& law : content.omitted)
      out.push_back(who + " had the point law \"" + law +
                    "\" where it came from; it is not in the file.");
  }
  return out;
}

void ImportedCase::summarise(io::Summary& summary) const {
  summary.set("deck.file", deck().file());
  summary.set("deck.sha256", deck().sha256());
  summary.set("model.nodes", nodes());
  summary.set("model.free_dofs", freeDofs());
}

CaseOutline ImportedCase::outline() const {
  const auto& settings = lists_->settings;
  CaseOutline out;
  for (std::size_t p = 0; p < joined_->scene.parts.size(); ++p) {
    const auto& content = joined_->scene.contents[p];
    const auto& part = joined_->scene.parts[p];
    std::vector<std::string> sets;
    for (const auto& set : content.interfaces) sets.push_back(set.name);
    out.modelled.push_back({true, part.name,
                            content.file + ": " + std::to_string(part.model.size()) + " dofs, " +
                                std::to_string(part.interface.size()) + " joined, " +
                                std::to_string(part.retained.size()) + " retained" +
                                (sets.empty() ? "" : "; sets " + quotedList(sets))});
  }
  out.modelled.push_back(
      {!settings.joints.empty(), "joints",
       settings.joints.empty() ? "no Joints in Parts" : join(settings.joints, ", ")});
  out.modelled.push_back({!settings.loads.empty(), "loads",
                          std::to_string(settings.loads.size()) + " beside those of the files"});
  out.rest = {
      settings.atRest, "equilibrium",
      settings.atRest ? "of the loads of the start time" : "Initial State is \"From files\""};
  if (reduces()) out.reduction = reduction().get<std::string>("Basis");
  const auto& coupling = lists_->common.coupling;
  out.coupling = {coupling.has_value(), "coupling",
                  coupling ? coupling::describe(*coupling) : "no Coupling list"};
  return out;
}

void ImportedCase::verify() const {
  const auto rest = solveStatic();
  if (!reduces() || !moves()) return;
  const auto basis = reduction::makeBasis(reduction().get<std::string>("Basis"), reduction());
  const auto& parts = joined_->scene.parts;
  if (basis->traits().interfaceForces && std::any_of(parts.begin(), parts.end(), startsElsewhere))
    estimate::synthesise(parts, reduction(), estimate::MotionProbe(), joined_->scene.coupling);
}

std::shared_ptr<const RestingCase> ImportedCase::solveStatic() const {
  lists_->requireMass(joined_->scene, joined_->whole.model);
  if (!joined_->started) {
    Vector rest = lists_->start(joined_->scene);
    joined_->whole = joinUnreduced(joined_->scene, true);
    joined_->started = true;
    if (rest.size() == 0 && list().isSublist("Response"))
      rest = joined_->whole.model.initialDisplacement;
    if (rest.size() > 0 && !linalg::isZero(joined_->whole.model.mass)) {
      auto resting = joined_->whole.model;
      resting.initialDisplacement = rest;
      joined_->stability = stability::assess(resting, lists_->startTime());
    }
  }
  return std::make_shared<RestingParts>(lists_, joined_);
}

}  // namespace tooljoint::cases
