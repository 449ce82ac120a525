// SPDX-License-Identifier: BSD-3-Clause
#include "app/PartsDeck.hpp"

#include <algorithm>
#include <cstdio>
#include <set>

#include "app/NoxSolver.hpp"
#include "app/PartsExport.hpp"
#include "app/ReductionRules.hpp"
#include "common/Error.hpp"
#include "common/Text.hpp"
#include "estimate/AdaptiveReduction.hpp"
#include "reduction/Reduce.hpp"
#include "reduction/ReductionParameters.hpp"
#include "reduction/vectors/LoadVectors.hpp"
#include "study/StudyParameters.hpp"
#include "transient/Integrator.hpp"
#include "transient/TransientParameters.hpp"

namespace tooljoint::app {

deck::ListSpec partsSceneSpec() {
  deck::ListSpec scene(
      "Scene",
      "A scene of parts from files: what they are, how they are joined, and what to compute.");
  auto parts = parts::parameters();
  scene.requiredList(parts);
  scene.list(coupling::parameters());
  scene.list(reduction::parameters());
  scene.list(transient::parameters());
  scene.list(io::parameters());
  scene.list(study::parameters());
  return scene;
}

bool isPartsDeck(const RunOptions& options) {
  const auto lists = deck::Deck::lists(options.deck, options.overrides);
  const auto has = [&](const char* name) {
    return std::find(lists.begin(), lists.end(), name) != lists.end();
  };
  return has("Parts") && !has("Drillstring") && !has("Well");
}

double PartsDeck::startTime() const {
  return moves() ? list().sublist("Transient").get<double>("Start Time") : 0.0;
}

coupling::Coupling PartsDeck::whole() const {
  auto options = scene.coupling;
  options.assembly = coupling::Assembly::Primal;
  return coupling::coupleWithPositions(scene.parts, options);
}

namespace {

/// The message of a room, with file and line in front.
std::string located(const deck::Deck& deck, const Error& fault) {
  std::vector<std::string> lines;
  for (const auto& line : split(fault.what(), '\n')) {
    const auto spec = partsSceneSpec();
    std::string rooted = line;
    for (const auto& list : spec.lists())
      if (line.rfind(list.name() + "/", 0) == 0 || line.rfind(list.name() + " ", 0) == 0)
        rooted = "/" + deck.name() + "/" + line;
    lines.push_back(deck.located(rooted));
  }
  return join(lines, "\n");
}

Teuchos::ParameterList listOrDefaults(const Teuchos::ParameterList& deck,
                                      const deck::ListSpec& spec) {
  return deck.isSublist(spec.name()) ? deck.sublist(spec.name()) : deck::defaults(spec);
}

void requireNoFaults(const std::vector<std::string>& faults) {
  if (!faults.empty()) throw DeckError(join(faults, "\n"));
}

/// What only several lists together can tell.
void crossCheck(const PartsDeck& deck) {
  std::vector<std::string> faults;
  const auto add = [&](const std::string& path, const std::string& sentence) {
    faults.push_back(deck.deck.error(path, sentence));
  };
  const auto& list = deck.list();
  if (deck.deck.gives("Output/XDMF") && deck.output.xdmf)
    add("Output/XDMF",
        "has no effect in a scene of parts: files of parts say nothing of what they look like. "
        "Leave it out.");
  if (deck.deck.gives("Output/XDMF Interval"))
    add("Output/XDMF Interval", "has no effect in a scene of parts. Leave it out.");
  if (deck.output.exportFormat != io::ExportFormat::None && !deck.reduces())
    add("Output/Export Parts", "has no effect without a Reduction list. Add one, or leave it out.");
  std::vector<std::string> names;
  for (const auto& part : deck.settings.imported) names.push_back(part.name);
  if (deck.output.exportFormat != io::ExportFormat::None)
    exportedFiles(names, deck.output.exportFormat);
  for (const auto& fault :
       reductionFaults(list, deck.input.assembly, static_cast<int>(deck.settings.imported.size())))
    add(fault.path, fault.sentence);
  requireNoFaults(faults);
}

/// Messages of `work` with file and line in front.
template <class Work>
void locating(const deck::Deck& deck, const Work& work) {
  try {
    work();
  } catch (const DeckError& fault) {
    throw DeckError(located(deck, fault));
  } catch (const ModelError& fault) {
    throw ModelError(located(deck, fault));
  }
}

/// Points that get load vectors are those of point laws.
void requireLoadVectorNodes(const PartsDeck& deck) {
  const auto options = reduction::readLoadVectors(deck.list().sublist("Reduction"));
  reduction::requirePointNodes(deck.scene.parts, options);
}

/// What the basis will read.
void requireInput(const PartsDeck& deck) {
  const auto& list = deck.list().sublist("Reduction");
  std::vector<reduction::PartOutline> parts;
  for (const auto& part : deck.scene.parts)
    parts.push_back({part.name, part.model.size(), !part.interior().empty()});
  reduction::makeBasis(list.get<std::string>("Basis"), list)->checkInput(parts);
}

}  // namespace

PartsDeck readPartsLists(const RunOptions& options) {
  PartsDeck out{
      deck::Deck::read(options.deck, partsSceneSpec(), options.overrides), {}, {}, {}, {}};
  const auto& list = out.list();
  locating(out.deck, [&] {
    out.settings = parts::readSettings(list.sublist("Parts"));
    if (list.isSublist("Coupling")) out.input = coupling::readCoupling(list.sublist("Coupling"));
    out.output = io::readOutput(listOrDefaults(list, io::parameters()));
    if (out.moves()) transient::readOptions(list.sublist("Transient"));
    if (out.reduces()) {
      reduction::readOptions(list.sublist("Reduction"),
                             static_cast<int>(out.settings.imported.size()));
      estimate::readEstimateOptions(list.sublist("Reduction"));
    }
    if (list.isSublist("Study")) study::readStudy(list.sublist("Study"));
    crossCheck(out);
  });
  return out;
}

void PartsDeck::build() {
  locating(deck, [&] {
    scene = parts::buildScene(settings, input,
                              [&](const std::string& name) { return deck.resolve(name); });
    if (!reduces()) return;
    requireInput(*this);
    requireLoadVectorNodes(*this);
  });
}

void PartsDeck::start() {
  locating(deck, [&] {
    parts::findStart(settings, startTime(), noxSolver(Teuchos::ParameterList("Static")), scene);
  });
}

void requireMass(const deck::Deck& deck, const parts::PartsScene& scene,
                 const model::SecondOrderModel& full) {
  if (!deck.list().isSublist("Transient") ||
      !transient::isExplicit(deck.list().sublist("Transient")))
    return;
  const Vector diagonal = full.mass.diagonal();
  for (Eigen::Index i = 0; i < diagonal.size(); ++i) {
    if (diagonal[i] > 0.0) continue;
    const auto& label = full.dofs[static_cast<std::size_t>(i)];
    std::string who = "A mode";
    if (label.kind == model::DofLabel::Kind::Physical) {
      const auto& name = scene.nodes.at(label.entity).front();
      const auto& part = scene.contents[static_cast<std::size_t>(name.part)];
      who = full.componentNames[static_cast<std::size_t>(label.component)] + " of node " +
            std::to_string(name.node) + " of part \"" + part.part.name + "\" (" + part.file + ")";
    }
    throw ModelError(
        deck.error("Transient/Integrator",
                   "is \"" + deck.list().sublist("Transient").get<std::string>("Integrator") +
                       "\", which needs a mass at every dof, but " + who +
                       " has none. Take Generalized-alpha, or give that dof a mass."));
  }
}

PartsDeck readPartsDeck(const RunOptions& options) {
  auto out = readPartsLists(options);
  out.build();
  requireMass(out.deck, out.scene, out.whole().model);
  out.start();
  return out;
}

void checkStart(const PartsDeck& deck) {
  if (!deck.reduces() || !deck.moves()) return;
  const auto& list = deck.list().sublist("Reduction");
  if (!reduction::makeBasis(list.get<std::string>("Basis"), list)->traits().interfaceForces) return;
  const bool starts = std::any_of(
      deck.scene.parts.begin(), deck.scene.parts.end(), [](const model::Substructure& part) {
        const auto& m = part.model;
        const Vector rest =
            part.reference.size() > 0 ? part.reference : Vector(Vector::Zero(m.size()));
        return !m.initialVelocity.isZero(0.0) || m.initialDisplacement != rest;
      });
  if (starts)
    estimate::synthesise(deck.scene.parts, list, estimate::MotionProbe(), deck.scene.coupling);
}

std::string describeParts(const PartsDeck& deck, const coupling::Coupling& whole) {
  std::set<std::string> files;
  for (const auto& content : deck.scene.contents) files.insert(content.file);
  char text[256];
  std::snprintf(text, sizeof text,
                "parts       %zu from %zu file%s, %zu nodes, %d dofs, %d when joined",
                deck.scene.parts.size(), files.size(), files.size() == 1 ? "" : "s",
                deck.scene.nodes.size(), deck.scene.dofs(), whole.model.size());
  return text;
}

}  // namespace tooljoint::app
